"""Offset of two clocks from the gait: one foot swings while the other one stands.

A foot does what the other did half a gait cycle before, so the correlation of the feet has two
equal peaks half a cycle before and after the true offset, and the offset is their middle.  This
asks nothing of the sensor's attitude, bias or place on the shoe.  Two things are assumed: that a
step of the left foot lasts as long as one of the right one (the error is half the difference,
some milliseconds), and that the walk has a start, an end, a stop or a change of pace: a walk of
equal cycles without end fits as well one cycle later.  How much worse the next best middle fits
is the confidence.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...core.series import ImuSeries
from ..errors import TimingError
from .correlation import STEP_S, Correlation, Signal, correlate, signal_of
from .result import Offset

CYCLE_S = (0.6, 2.5)  # gait cycles that are looked for
LEAST_PEAK = 0.6  # correlation below which these are not two feet walking
LEAST_CYCLES = 3.0
ASYMMETRY_S = 0.008  # what left and right steps differ by, measured on walks with one clock
WINDOW_S = 20.0
LEAST_SPAN_S = 60.0  # of the windows, to tell a skew
EVEN_MARGIN = 0.25  # lead over the next best, in cycles, that is a confidence of one half


@dataclass(frozen=True)
class Middle:
    """Two neighbouring peaks: the lag between them, their distance (the cycle), mean height."""

    lag_s: float
    cycle_s: float
    height: float


def offset_by_gait(left: ImuSeries, right: ImuSeries) -> Offset:
    """Return what to add to the right foot's stamps so that the feet walk in turn.

    Raises
    ------
    TimingError
        When a foot does not walk, or the feet do not fit together at any offset.
    """
    feet = [_strides("left", left), _strides("right", right)]
    correlation = correlate(*feet)
    best, second = _best_middles(correlation)
    walked_s = min(_walking_s(foot) for foot in feet)
    cycles = walked_s / best.cycle_s
    if best.height < LEAST_PEAK or cycles < LEAST_CYCLES:
        raise TimingError(
            f"the feet do not walk together: best agreement {best.height:.2f} over "
            f"{cycles:.1f} gait cycles; needed are {LEAST_PEAK} and {LEAST_CYCLES:g}; "
            "is this one walk, with a sensor on each foot?"
        )
    lead = (best.height - second) * cycles
    windows = _windows(feet[0], feet[1], best)
    middle_ns = (int(right.stamp_ns[0]) + int(right.stamp_ns[-1])) // 2
    offset_s, skew, skew_std, std_s = _line(windows, best.lag_s, middle_ns)
    return Offset(
        method="motion",
        offset_ns=round(offset_s * 1e9),
        center_ns=middle_ns,
        skew_ppm=0.0 - 1e6 * skew,
        skew_known=skew_std is not None,
        std_s=float(np.hypot(std_s, ASYMMETRY_S)),
        confidence=lead / (lead + EVEN_MARGIN),
        detail={
            "agreement": best.height,
            "second": second,
            "cycle_s": best.cycle_s,
            "cycles": cycles,
            "skew_std_ppm": float("nan") if skew_std is None else float(1e6 * skew_std),
        },
    )


def _strides(foot: str, series: ImuSeries) -> Signal:
    """Return | |specific force| - its value at rest |: marks the steps, blind to attitude."""
    norm = np.linalg.norm(series.specific_force, axis=1)
    finite = norm[np.isfinite(norm)]
    signal = signal_of(series, np.abs(norm - (np.median(finite) if len(finite) else 0.0)))
    if len(signal.values) * STEP_S < 2.0 * CYCLE_S[1]:
        raise TimingError(
            f"the recording of the {foot} foot is {len(signal.values) * STEP_S:.1f} s long; "
            f"at least {2.0 * CYCLE_S[1]:g} s are needed to see a gait"
        )
    return signal


def _walking_s(foot: Signal) -> float:
    """Return how long the foot walked: where a second's mean is a fifth of a brisk one, s."""
    second = np.ones(round(1.0 / STEP_S)) * STEP_S
    mean = np.convolve(foot.values, second, mode="same")
    brisk = float(np.quantile(mean, 0.95))
    return float(np.count_nonzero(mean > max(0.2 * brisk, 0.5)) * STEP_S)


def _best_middles(correlation: Correlation) -> tuple[Middle, float]:
    """Return the best middle of two peaks, and the height of the best at another cycle."""
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
    best = max(middles, key=lambda m: m.height)
    others = [m.height for m in middles if m is not best]
    return best, max(others, default=0.0)


def _windows(left: Signal, right: Signal, whole: Middle) -> list[tuple[float, float]]:
    """Return (right stamp in s since 0 of the epoch's start, lag in s) of every window."""
    size, reach = round(WINDOW_S / STEP_S), round(2.0 * whole.cycle_s / STEP_S)
    out = []
    for begin in range(0, len(left.values) - size // 2, size):
        part = left.part(begin, begin + size)
        at = (part.start_ns - right.start_ns) * 1e-9 - whole.lag_s
        start = round(at / STEP_S)
        if start + size < 0 or start > len(right.values):
            continue
        other = right.part(start - reach, max(start + size + reach, 0))
        if min(len(part.values), len(other.values)) < size // 2 or not _walks(part, left):
            continue
        lag = _middle_near(correlate(part, other), whole)
        if lag is not None:
            out.append((at + 0.5 * WINDOW_S + right.start_ns * 1e-9, lag))
    return out


def _walks(part: Signal, whole: Signal) -> bool:
    return float(part.values.mean()) > 0.5 * float(whole.values.mean())


def _middle_near(correlation: Correlation, whole: Middle) -> float | None:
    half = 0.5 * whole.cycle_s
    one = correlation.maximum_near(whole.lag_s - half, 0.5 * half)
    two = correlation.maximum_near(whole.lag_s + half, 0.5 * half)
    return None if one is None or two is None else 0.5 * (one[0] + two[0])


def _line(
    windows: list[tuple[float, float]], lag_s: float, middle_ns: int
) -> tuple[float, float, float | None, float]:
    """Return offset at the middle (s), slope, its std (None: not known), std of the offset (s)."""
    points = np.array(windows).reshape(-1, 2)
    span_s = float(np.ptp(points[:, 0])) if len(points) else 0.0
    if len(points) < 4 or span_s < LEAST_SPAN_S:
        return lag_s, 0.0, None, 0.0
    from scipy.stats import siegelslopes

    time_s, lag = points[:, 0] - middle_ns * 1e-9, points[:, 1] - lag_s
    slope, height = (float(v) for v in siegelslopes(lag, time_s))
    scatter = 1.4826 * float(np.median(np.abs(lag - height - slope * time_s)))
    slope_std = scatter / (float(np.std(time_s)) * np.sqrt(len(time_s)))
    if abs(slope) < 3.0 * slope_std:  # not told from zero
        return lag_s, 0.0, slope_std, scatter / np.sqrt(len(time_s))
    return lag_s + height, slope, slope_std, scatter / np.sqrt(len(time_s))
