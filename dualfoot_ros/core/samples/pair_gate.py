"""Which pairs the tracker takes: finite, in range, in order; one at a time and many at once."""

from __future__ import annotations

import math
from enum import StrEnum

import numpy as np

from ..refusals import Refusal
from .series import BoolArray, FloatArray, IntArray

LIMIT = 500.0  # m/s^2 and rad/s; no foot-mounted sensor reads more
MAX_GAP_NS = 200_000_000  # a longer gap is bridged, not filled
BACK_NS = 1_000_000_000  # further back than this is no disorder: time has jumped
FAR_AHEAD_NS = 10_000_000_000  # further ahead is believed only when the next stamp agrees
CLOCK_NS = 3_600_000_000_000  # further ahead no person has walked meanwhile: a clock was set
LOOP_NS = 2_000_000_000  # so near to the first stamp a jump back is a recording that begins anew


class Jump(StrEnum):
    """What a stamp that does not follow the one before says, once a second one agrees."""

    BEGINS_ANEW = "begins_anew"
    CLOCK_SET = "clock_set"


class PairGate:
    """Decides about each pair from its values and from the stamps before it."""

    def __init__(self) -> None:
        """Take any first stamp."""
        self.first_ns: int | None = None
        self.last_ns: int | None = None
        self._far_ns: int | None = None

    def refusal(self, stamp: int, values: FloatArray) -> Refusal | Jump | None:
        """Return why a pair is refused, or None; a `Jump` is no refusal.

        A foot whose six values are all nan has no sample, which is none either as long as the
        other one has.
        """
        if not math.hypot(*values.tolist()) < LIMIT:  # seldom: so look at each
            bad = _bad_values(values)
            if bad is not None:
                return bad
        if self.last_ns is None:
            return None
        step = stamp - self.last_ns
        if step > FAR_AHEAD_NS or step <= -BACK_NS:
            return self._far(stamp, step)
        self._far_ns = None
        if step > 0:
            return None
        return Refusal.DUPLICATE if step == 0 else Refusal.OUT_OF_ORDER

    def went_on(self, stamp: int) -> None:
        """Take note that good pairs have followed each other, up to that of ``stamp``."""
        self._far_ns, self.last_ns = None, stamp

    def plain(self, stamps: IntArray, values: FloatArray) -> int:
        """Return how many of the next pairs (N, 12) are in order, without a gap, of both feet."""
        if self.last_ns is None:
            return 0
        before = np.concatenate([[self.last_ns], stamps[:-1]])
        steps = stamps - before  # which may be too many for 64 bits
        good = (stamps > before) & (steps > 0) & (steps <= MAX_GAP_NS)
        good &= np.all(np.abs(values) < LIMIT, axis=1)
        return int(np.append(good, False).argmin())

    def _far(self, stamp: int, step: int) -> Refusal | Jump | None:
        """Refuse one stamp that is far off; a second one after it shows that time did jump."""
        far, self._far_ns = self._far_ns, stamp
        if far is None or not 0 < stamp - far <= MAX_GAP_NS:
            return Refusal.FAR_AHEAD if step > 0 else Refusal.OUT_OF_ORDER
        self._far_ns = None
        if step <= CLOCK_NS and step > 0:
            return None
        begins = self.first_ns is not None and abs(stamp - self.first_ns) < LOOP_NS
        return Jump.BEGINS_ANEW if begins else Jump.CLOCK_SET

    def step(self, stamp: int) -> int:
        """Take a stamp; return the ns since the one before (0 for the first)."""
        dt_ns = 0 if self.last_ns is None else stamp - self.last_ns
        if self.first_ns is None:
            self.first_ns = stamp
        self.last_ns = stamp
        return dt_ns


def _bad_values(values: FloatArray) -> Refusal | None:
    """Return why values (12,) are refused, or None when one foot is just not there."""
    feet = values[:6], values[6:]
    there = [not np.isnan(foot).all() for foot in feet]
    if not any(there):
        return Refusal.NOT_FINITE
    for foot, is_there in zip(feet, there, strict=True):
        for value in foot.tolist() if is_there else ():
            if not -LIMIT < value < LIMIT:
                return _bad_value(value)
    return None


def _bad_value(value: float) -> Refusal:
    return Refusal.OUT_OF_RANGE if math.isfinite(value) else Refusal.NOT_FINITE


def regular_samples(stamps: IntArray, good: BoolArray, longest_ns: int = MAX_GAP_NS) -> BoolArray:
    """Return (N,) bool: samples that the gate would take, as it did the one before, with no gap.

    ``good`` (N,) are those whose values it takes (:func:`good_values`).  A sample counts as taken
    when it is later than every good sample before it.  (After time has jumped back that is never
    so, and the samples go one by one.)  ``longest_ns`` is the longest interval without a hole.
    """
    count = len(stamps)
    latest = np.maximum.accumulate(np.where(good, stamps, np.iinfo(np.int64).min))
    taken = good.copy()
    taken[1:] &= stamps[1:] > latest[:-1]
    regular = np.zeros(count, dtype=bool)
    steps = np.diff(stamps)
    regular[1:] = taken[1:] & taken[:-1] & (steps <= longest_ns)
    regular[2:] &= steps[:-1] <= FAR_AHEAD_NS
    return regular


def in_range(values: FloatArray) -> bool:
    """Return whether all of the values, of whatever shape, are in range and none is nan."""
    return bool(np.all(np.abs(values) < LIMIT))


def good_values(values: FloatArray) -> BoolArray:
    """Return (N,) bool: values (N, 12) in range, but for a foot that is not there."""
    feet = values[:, :6], values[:, 6:]
    there = [np.all(np.abs(foot) < LIMIT, axis=1) for foot in feet]
    away = [np.isnan(foot).all(axis=1) for foot in feet]
    good: BoolArray = (there[0] & (there[1] | away[1])) | (there[1] & away[0])
    return good


def next_irregular(regular: BoolArray) -> IntArray:
    """Return (N,) the index of the first irregular sample at or after each (N if none)."""
    count = len(regular)
    index = np.where(regular, count, np.arange(count))
    stops: IntArray = np.minimum.accumulate(index[::-1])[::-1]
    return stops
