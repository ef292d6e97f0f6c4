"""How evenly two feet walk in turn, window by window: which cycle fits, and whether any does.

No two cycles last equally long.  Where a step is paired with its neighbours of the same walk, the
middle between them hardly moves; a cycle off it moves by what the cycles differ by, and with the
feet of two walks it wanders.
"""

from __future__ import annotations

import numpy as np

from ...core.samples.series import FloatArray
from .correlation import STEP_S, Correlation, Signal, correlate
from .middles import Middle

WINDOW_S, HOP_S = 4.0, 2.0
LEAST_WINDOWS = 4
LEAST_SPAN_S = 60.0  # of the windows, to tell a skew
MOST_POINTS = 500  # that the line is fitted to; the fit takes their square in memory
KEPT = 0.9  # share of the windows that counts: at a stop one may find nothing
FLOOR = 0.001  # of a cycle; more even than that is not told apart


def unevenness(left: Signal, right: Signal, whole: Middle) -> tuple[float, int]:
    """Return by what share of a cycle the windows differ, rms, and how many there are.

    A straight line, a skew, is taken off where they span a minute.  Infinite when there are too
    few windows, or fewer than half of those that walk have a middle.
    """
    points, walking = middles_of_windows(left, right, whole, WINDOW_S, HOP_S, 1.0)
    if len(points) < max(LEAST_WINDOWS, walking / 2):
        return float("inf"), len(points)
    from scipy.stats import siegelslopes

    time_s, lag = points[:, 0] - points[0, 0], points[:, 1] - whole.lag_s
    if time_s[-1] >= LEAST_SPAN_S:
        few = slice(None, None, 1 + len(lag) // MOST_POINTS)
        lag = lag - siegelslopes(lag[few], time_s[few]).slope * time_s
    squares = np.sort((lag - np.median(lag)) ** 2)[: max(round(KEPT * len(lag)), 1)]
    return max(float(np.sqrt(squares.mean())) / whole.cycle_s, FLOOR), len(points)


def middles_of_windows(
    left: Signal, right: Signal, whole: Middle, window_s: float, hop_s: float, reach_cycles: float
) -> tuple[FloatArray, int]:
    """Return (right stamp in s, lag in s) (N, 2) of the windows that walk; how many there are."""
    size, hop = round(window_s / STEP_S), round(hop_s / STEP_S)
    reach = round(reach_cycles * whole.cycle_s / STEP_S)
    brisk = 0.5 * float(left.values.mean())
    out, walking = [], 0
    for begin in range(0, len(left.values) - size // 2, hop):
        part = left.part(begin, begin + size)
        at = (part.start_ns - right.start_ns) * 1e-9 - whole.lag_s
        start = round(at / STEP_S)
        if start + size < 0 or start > len(right.values):
            continue
        other = right.part(start - reach, max(start + size + reach, 0))
        if min(len(part.values), len(other.values)) < size // 2 or part.values.mean() <= brisk:
            continue
        walking += 1
        lag = _middle_near(correlate(part, other), whole)
        if lag is not None:
            out.append((at + 0.5 * window_s + right.start_ns * 1e-9, lag))
    return np.array(out).reshape(-1, 2), walking


def _middle_near(correlation: Correlation, whole: Middle) -> float | None:
    half = 0.5 * whole.cycle_s
    one = correlation.maximum_near(whole.lag_s - half, 0.5 * half)
    two = correlation.maximum_near(whole.lag_s + half, 0.5 * half)
    return None if one is None or two is None else 0.5 * (one[0] + two[0])
