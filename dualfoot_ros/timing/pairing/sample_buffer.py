"""One foot in the aligner: its recent samples, and its value at a time in between."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

import numpy as np

from ...core import FloatArray
from .interpolation import between
from .pairing_config import AlignerConfig

CAPACITY = 20_000  # samples a foot; never reached at sane rates


class BufferedSample(NamedTuple):
    """The value of a stream at a time, or why there is none."""

    values: FloatArray | None
    why: str = ""
    next_ns: int = 0  # with "in_gap" and "outside": the stream goes on here


WAIT = BufferedSample(None, "wait")


class SampleBuffer:
    """The recent samples of one foot, and its value at a time in between."""

    def __init__(self, config: AlignerConfig) -> None:
        self._gap_ns, self._holds = config.max_gap_ns, config.holds
        self._tolerance_ns = config.tolerance_ns
        self._keep_ns = config.max_delay_ns + config.max_gap_ns
        self.samples: deque[tuple[int, FloatArray]] = deque()
        self.first_ns: int | None = None
        self.newest_ns = 0
        self._trimmed = False

    def append(self, stamp_ns: int, values: FloatArray) -> None:
        """Add a sample, newer than all before."""
        # What was too old already goes; a hole makes nothing old before it has been asked for.
        while len(self.samples) > 2 and self._too_old(self.samples[1][0]):
            self.samples.popleft()
            self._trimmed = True
        self.samples.append((stamp_ns, values))
        self.newest_ns = stamp_ns
        if self.first_ns is None:
            self.first_ns = stamp_ns

    def _too_old(self, stamp_ns: int) -> bool:
        return self.newest_ns - stamp_ns > self._keep_ns or len(self.samples) > CAPACITY

    def at(self, stamp_ns: int) -> BufferedSample:
        """Return the value at ``stamp_ns``, later than what was forgotten."""
        samples, k = self.samples, 0
        while k + 1 < len(samples) and samples[k + 1][0] <= stamp_ns:
            k += 1
        if not samples:
            return WAIT
        before_ns, before = samples[k]
        if abs(before_ns - stamp_ns) <= self._tolerance_ns:
            return BufferedSample(before)
        if before_ns > stamp_ns:
            why = "in_gap" if self._trimmed else "outside"
            return BufferedSample(None, why, before_ns - self._tolerance_ns)
        return self._between(stamp_ns, k) if k + 1 < len(samples) else WAIT

    def _between(self, stamp_ns: int, k: int) -> BufferedSample:
        (before_ns, before), (after_ns, after) = self.samples[k], self.samples[k + 1]
        if after_ns - stamp_ns <= self._tolerance_ns:
            return BufferedSample(after)
        if after_ns - before_ns > self._gap_ns:
            return BufferedSample(None, "in_gap", after_ns - self._tolerance_ns)
        weight = 0.0 if self._holds else (stamp_ns - before_ns) / (after_ns - before_ns)
        width_s = (after_ns - before_ns) * 1e-9
        values = between(before.tolist(), after.tolist(), weight, width_s)
        return BufferedSample(np.array(values), "interpolated")

    def forget(self, until_ns: int) -> None:
        """Forget the samples that no time after ``until_ns`` needs."""
        samples = self.samples
        while len(samples) > 1 and samples[1][0] <= until_ns:
            samples.popleft()
