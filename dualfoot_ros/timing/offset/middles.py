"""Middles between neighbouring peaks of the correlation of two feet: offsets that may be true."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from ..errors import TimingError
from .correlation import STEP_S, Correlation

CYCLE_S = (0.6, 2.5)  # gait cycles that are looked for


@dataclass(frozen=True)
class Middle:
    """Two neighbouring peaks: the lag between them, their distance (the cycle), mean height."""

    lag_s: float
    cycle_s: float
    height: float


def highest_middles(correlation: Correlation, count: int) -> list[Middle]:
    """Return the middles of two peaks, the highest first."""
    from scipy.signal import find_peaks

    value = correlation.value
    found, _ = find_peaks(
        value, height=0.5 * float(value.max()), distance=round(CYCLE_S[0] / STEP_S)
    )
    peaks = [correlation.peak(int(i)) for i in found]
    middles = [
        Middle(0.5 * (one[0] + two[0]), two[0] - one[0], 0.5 * (one[1] + two[1]))
        for one, two in pairwise(peaks)
        if CYCLE_S[0] <= two[0] - one[0] <= CYCLE_S[1]
    ]
    if not middles:
        raise TimingError("no gait is seen in the recordings: no two peaks of agreement")
    return sorted(middles, key=lambda m: -m.height)[:count]
