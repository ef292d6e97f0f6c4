"""The sampling rate of a stream, from the stamps of some seconds, bunched or not."""

from __future__ import annotations

from collections import deque

import numpy as np

from ..samples.quantiles import median
from ..samples.series import FloatArray

LONGEST_S = 10.0  # stretch that is looked at
LARGEST_GAP_S = 0.2  # longer ones are holes and not intervals
RATES_HZ = (5.0, 5000.0)  # beyond these the stamps are wrong, and memory must stay bounded
UNEVEN = 0.2  # by which median and mean rate may differ where stamps are even


class SamplingRate:
    """Estimates the rate of samples over the last seconds.

    The median interval is robust against lost samples, but stamps that come in bunches (a burst
    with equal or nearly equal stamps) make it far too short; then the mean interval is taken.
    """

    def __init__(self) -> None:
        """Start with no sample."""
        self._stamps: deque[int] = deque()

    def add(self, stamp_ns: int) -> None:
        """Take the stamp of a sample, in ns."""
        self._stamps.append(stamp_ns)
        while stamp_ns - self._stamps[0] > LONGEST_S * 1e9:
            self._stamps.popleft()

    @property
    def seconds(self) -> float:
        """Length of the stretch that is known, s."""
        return (self._stamps[-1] - self._stamps[0]) * 1e-9 if self._stamps else 0.0

    @property
    def hz(self) -> float | None:
        """The rate; None before there are two samples."""
        if len(self._stamps) < 2:
            return None
        stamps = np.fromiter(self._stamps, dtype=np.int64, count=len(self._stamps))
        steps: FloatArray = np.diff(stamps) * 1e-9
        steps = steps[steps < LARGEST_GAP_S]
        if not len(steps) or steps.sum() <= 0.0:
            return None
        mean, usual = float(steps.mean()), median(steps)
        interval = usual if abs(usual - mean) <= UNEVEN * mean else mean
        return min(max(1.0 / interval, RATES_HZ[0]), RATES_HZ[1])
