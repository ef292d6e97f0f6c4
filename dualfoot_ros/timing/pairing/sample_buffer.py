"""One foot in the aligner: its recent samples, and its value at a time in between."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

import numpy as np

from ...core import FloatArray
from .interpolation import between
from .lost_samples import can_guide, cubic, is_curved
from .pairing_config import AlignerConfig
from .sample_spacing import Spacing

CAPACITY = 20_000  # samples a foot; never reached at sane rates


class BufferedSample(NamedTuple):
    """The value of a stream at a time, or why there is none."""

    values: FloatArray | None
    why: str = ""
    next_ns: int = 0  # with "in_gap" and "outside": the stream goes on here


WAIT = BufferedSample(None, "wait")


class Sample(NamedTuple):
    """A sample, or what a lost one would have been."""

    stamp_ns: int
    values: FloatArray
    lost: bool = False


class SampleBuffer:
    """The recent samples of one foot, and its value at a time in between."""

    def __init__(self, config: AlignerConfig) -> None:
        self._config = config
        self._gap_ns, self._holds = config.max_gap_ns, config.holds
        self._tolerance_ns = config.tolerance_ns
        self._keep_ns = config.max_delay_ns + config.max_gap_ns
        self._spacing = Spacing(self._gap_ns)
        self._measured: deque[Sample] = deque(maxlen=3)
        self._lost_ns: list[int] = []  # before the newest sample, and not restored yet
        self.samples: deque[Sample] = deque()
        self.first_ns: int | None = None
        self.newest_ns = 0
        self._trimmed = False

    def append(self, stamp_ns: int, values: FloatArray) -> list[int]:
        """Add a sample, newer than all before; return the stamps of those lost before it."""
        # What was too old already goes; a hole makes nothing old before it has been asked for.
        while len(self.samples) > 2 and self._too_old(self.samples[1].stamp_ns):
            self.samples.popleft()
            self._trimmed = True
        sample = Sample(stamp_ns, values)
        if self._lost_ns and self._can_guide(stamp_ns - self.newest_ns):
            self._restore([*self._measured, sample])
        self._measured.append(sample)
        self.samples.append(sample)
        self.newest_ns = stamp_ns
        if self.first_ns is None:
            self.first_ns = stamp_ns
        lost_ns = self._spacing.fill(stamp_ns)
        self._lost_ns = lost_ns if self._is_curved(len(lost_ns)) else []
        return lost_ns

    def _is_curved(self, lost: int) -> bool:
        """Return whether the interval before the newest sample is curved where it is a hole."""
        if self._holds or len(self._measured) < 3:
            return False
        first, before, after = (sample.stamp_ns for sample in self._measured)
        return bool(is_curved(first, before, after, lost, self._config))

    def _can_guide(self, interval_ns: int) -> bool:
        """Return whether the sample after the newest one is where it guides the cubic."""
        hole_ns = self._measured[-1].stamp_ns - self._measured[-2].stamp_ns
        return bool(can_guide(interval_ns, hole_ns, len(self._lost_ns), self._config))

    def _restore(self, around: list[Sample]) -> None:
        """Put the samples that were lost before the newest one into their places."""
        after = self.samples.pop()
        for lost_ns in self._lost_ns:
            since = [float(s.stamp_ns - lost_ns) for s in around]
            values = cubic(since, [s.values.tolist() for s in around])
            self.samples.append(Sample(lost_ns, np.array(values), lost=True))
        self.samples.append(after)

    def _too_old(self, stamp_ns: int) -> bool:
        return self.newest_ns - stamp_ns > self._keep_ns or len(self.samples) > CAPACITY

    def at(self, stamp_ns: int, *, patient: bool = True) -> BufferedSample:
        """Return the value at ``stamp_ns``, later than what was forgotten.

        In a hole that is curved, ``patient`` waits for the second sample after it.
        """
        samples, k = self.samples, 0
        while k + 1 < len(samples) and samples[k + 1].stamp_ns <= stamp_ns:
            k += 1
        if not samples:
            return WAIT
        before_ns, before, lost = samples[k]
        if abs(before_ns - stamp_ns) <= self._tolerance_ns:
            return BufferedSample(before, "interpolated" if lost else "")
        if patient and self._is_waiting(stamp_ns):
            return WAIT
        if before_ns > stamp_ns:
            why = "in_gap" if self._trimmed else "outside"
            return BufferedSample(None, why, before_ns - self._tolerance_ns)
        return self._between(stamp_ns, k) if k + 1 < len(samples) else WAIT

    def _is_waiting(self, stamp_ns: int) -> bool:
        """Return whether a time is in a hole that is curved when the next sample has come."""
        if not self._lost_ns or self.newest_ns - stamp_ns <= self._tolerance_ns:
            return False
        return stamp_ns > self._measured[-2].stamp_ns

    def _between(self, stamp_ns: int, k: int) -> BufferedSample:
        (before_ns, before, _), (after_ns, after, lost) = self.samples[k], self.samples[k + 1]
        if after_ns - stamp_ns <= self._tolerance_ns:
            return BufferedSample(after, "interpolated" if lost else "")
        if after_ns - before_ns > self._gap_ns:
            return BufferedSample(None, "in_gap", after_ns - self._tolerance_ns)
        weight = 0.0 if self._holds else (stamp_ns - before_ns) / (after_ns - before_ns)
        width_s = (after_ns - before_ns) * 1e-9
        values = between(before.tolist(), after.tolist(), weight, width_s)
        return BufferedSample(np.array(values), "interpolated")

    def forget(self, until_ns: int) -> None:
        """Forget the samples that no time after ``until_ns`` needs."""
        samples = self.samples
        while len(samples) > 1 and samples[1].stamp_ns <= until_ns:
            samples.popleft()
