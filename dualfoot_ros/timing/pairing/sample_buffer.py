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
    """The value of a stream at a time, or the name of the counter that says why there is none."""

    values: FloatArray | None
    why: str = ""
    next_ns: int = 0  # with "in_gap": the stream goes on here


WAIT = BufferedSample(None, "wait")


class SampleBuffer:
    """The recent samples of one foot, and its value at a time in between."""

    def __init__(self, config: AlignerConfig) -> None:
        self._gap_ns, self._holds = config.max_gap_ns, config.holds
        self._tolerance_ns = config.tolerance_ns
        self._keep_ns = config.max_delay_ns
        self.samples: deque[tuple[int, FloatArray]] = deque()
        self.first_ns: int | None = None
        self.newest_ns = 0
        self._trimmed = False

    def append(self, stamp_ns: int, values: FloatArray) -> None:
        """Add a sample, newer than all before."""
        self.samples.append((stamp_ns, values))
        self.newest_ns = stamp_ns
        if self.first_ns is None:
            self.first_ns = stamp_ns
        while len(self.samples) > 2 and self._too_old(self.samples[1][0]):
            self.samples.popleft()
            self._trimmed = True

    def _too_old(self, stamp_ns: int) -> bool:
        return self.newest_ns - stamp_ns > self._keep_ns or len(self.samples) > CAPACITY

    def at(self, stamp_ns: int) -> BufferedSample:
        """Return the value at ``stamp_ns``; the times asked for must not decrease."""
        samples = self.samples
        while len(samples) > 1 and samples[1][0] <= stamp_ns:
            samples.popleft()
        if not samples:
            return WAIT
        before_ns, before = samples[0]
        if abs(before_ns - stamp_ns) <= self._tolerance_ns:
            return BufferedSample(before)
        if before_ns > stamp_ns:
            return BufferedSample(
                None, "late" if self._trimmed else "outside", before_ns - self._tolerance_ns
            )
        if len(samples) == 1:
            return WAIT
        after_ns, after = samples[1]
        if after_ns - stamp_ns <= self._tolerance_ns:
            return BufferedSample(after)
        if after_ns - before_ns > self._gap_ns:
            return BufferedSample(None, "in_gap", after_ns - self._tolerance_ns)
        weight = 0.0 if self._holds else (stamp_ns - before_ns) / (after_ns - before_ns)
        width_s = (after_ns - before_ns) * 1e-9
        values = between(before.tolist(), after.tolist(), weight, width_s)
        return BufferedSample(np.array(values), "interpolated")
