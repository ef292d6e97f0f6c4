"""Which pairs the tracker takes: finite, in range, in order; one at a time and many at once."""

from __future__ import annotations

import math

import numpy as np

from ..refusals import Refusal
from .series import FloatArray, IntArray

LIMIT = 500.0  # m/s^2 and rad/s; no foot-mounted sensor reads more
MAX_GAP_NS = 200_000_000  # a longer gap is bridged, not integrated
TIME_JUMP_NS = 1_000_000_000  # further back than this is a new recording, not disorder
FAR_AHEAD_NS = 10_000_000_000  # further ahead is believed only when the next stamp agrees
TIME_JUMPED = "time_jumped"


class PairGate:
    """Decides about each pair from its values and from the stamps before it."""

    def __init__(self) -> None:
        """Take any first stamp."""
        self.last_ns: int | None = None
        self._ahead_ns: int | None = None

    def refusal(self, stamp: int, values: FloatArray) -> str | None:
        """Return why a pair is refused, or None.

        TIME_JUMPED is no refusal but says that a new recording begins with this pair.
        """
        if not math.hypot(*values.tolist()) < LIMIT:  # seldom: so look at each
            for value in values.tolist():
                if not -LIMIT < value < LIMIT:
                    return _bad_value(value)
        if self.last_ns is None:
            return None
        if stamp > self.last_ns:
            return self._too_far_ahead(stamp, self.last_ns)
        if stamp == self.last_ns:
            return Refusal.DUPLICATE
        return Refusal.OUT_OF_ORDER if self.last_ns - stamp < TIME_JUMP_NS else TIME_JUMPED

    def _too_far_ahead(self, stamp: int, last: int) -> Refusal | None:
        """Refuse one stamp far in the future; a second one after it shows that time did go on."""
        ahead, self._ahead_ns = self._ahead_ns, None
        if stamp - last <= FAR_AHEAD_NS or (ahead and 0 < stamp - ahead <= MAX_GAP_NS):
            return None
        self._ahead_ns = stamp
        return Refusal.FAR_AHEAD

    def step(self, stamp: int) -> int:
        """Take a stamp; return the ns since the one before (0 for the first)."""
        dt_ns = 0 if self.last_ns is None else stamp - self.last_ns
        self.last_ns = stamp
        return dt_ns


def _bad_value(value: float) -> Refusal:
    return Refusal.OUT_OF_RANGE if math.isfinite(value) else Refusal.NOT_FINITE


def regular_samples(stamps: IntArray, values: FloatArray) -> np.ndarray:
    """Return (N,) bool: samples that the gate would take, as it did the one before, with no gap.

    A sample counts as taken when it is later than every good sample before it.  (After time has
    jumped back that is never so, and the samples go one by one.)
    """
    count = len(stamps)
    good: np.ndarray = np.all(np.abs(values) < LIMIT, axis=1)
    latest = np.maximum.accumulate(np.where(good, stamps, np.iinfo(np.int64).min))
    taken = good.copy()
    taken[1:] &= stamps[1:] > latest[:-1]
    regular = np.zeros(count, dtype=bool)
    steps = np.diff(stamps)
    regular[1:] = taken[1:] & taken[:-1] & (steps <= MAX_GAP_NS)
    regular[2:] &= steps[:-1] <= FAR_AHEAD_NS
    return regular


def next_irregular(regular: np.ndarray) -> IntArray:
    """Return (N,) the index of the first irregular sample at or after each (N if none)."""
    count = len(regular)
    index = np.where(regular, count, np.arange(count))
    stops: IntArray = np.minimum.accumulate(index[::-1])[::-1]
    return stops
