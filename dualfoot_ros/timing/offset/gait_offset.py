"""Offset of two clocks from the gait: one foot swings while the other one stands.

A foot does what the other did half a gait cycle before, so the correlation of the feet has two
equal peaks half a cycle before and after the true offset, and the offset is their middle.  This
asks nothing of the sensor's attitude, bias or place on the shoe.  What is assumed is that a step
of the left foot lasts as long as one of the right one (the error is half the difference, some
milliseconds).  Which cycle is told by two things: how well the starts, stops and changes of pace
of the whole recordings fit, and how evenly the feet then walk in turn (``evenness``).  By how much
both together prefer one cycle is the confidence, and how alike and even the feet are limits it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...core import FloatArray, ImuSeries, TimingError
from .correlation import STEP_S, Signal, correlate, signal_of
from .gait_cycle import (
    CYCLE_S,
    LARGEST_SKEW,
    LEAST_SPAN_S,
    CandidateOffset,
    candidate_offsets,
    check_gait,
    choose_cycle,
    explain_doubt,
    offsets_of_windows,
    walking,
)
from .result import Offset

ASYMMETRY_S = 0.008  # what left and right steps differ by, measured on walks with one clock
WINDOW_S = 20.0
SMEAR_S = 0.08  # that a skew may cause over the recording before it is looked for
MOST_SLOPES = 50  # each way; from an hour on the largest skew shrinks
COARSE = 4  # steps of the grid in one when looking for the skew


def offset_by_gait(left: ImuSeries, right: ImuSeries) -> Offset:
    """Return what to add to the right foot's stamps so that the feet walk in turn.

    Raises
    ------
    TimingError
        When a foot does not walk, or the feet do not fit together at any offset.
    """
    middle_ns = (int(right.stamp_ns[0]) + int(right.stamp_ns[-1])) // 2
    one, two = recorded = _strides("left", left), _strides("right", right)
    slope = _coarse_slope(one, two)
    if slope:  # sharpen it, so that the correlation of the whole is sharp
        two = _strides("right", _scaled(right, slope, middle_ns))
        first = candidate_offsets(correlate(one, two), 1)[0]
        slope = (1.0 + slope) * (1.0 + _line(_windows(one, two, first), first.lag_s, 0)[1]) - 1.0
        two = _strides("right", _scaled(right, slope, middle_ns))
    walked_s = min(STEP_S * float(np.count_nonzero(walking(foot))) for foot in (one, two))
    choice = choose_cycle(one, two, correlate(one, two), walked_s)
    best, cycles = choice.offset, walked_s / choice.offset.cycle_s
    check_gait(choice, cycles, *recorded)
    windows = _windows(one, two, best)
    offset_s, rest, slope_std, std_s = _line(windows, best.lag_s, middle_ns)
    slope = (1.0 + slope) * (1.0 + rest) - 1.0
    return Offset(
        method="motion",
        offset_ns=round(offset_s * 1e9),
        center_ns=middle_ns,
        skew_ppm=1e6 * (1.0 / (1.0 + slope) - 1.0) if slope else 0.0,
        skew_known=slope_std is not None,
        std_s=float(np.hypot(std_s, ASYMMETRY_S)),
        confidence=choice.confidence,
        detail={
            "agreement": best.height,
            "second": choice.second,
            "cycle_s": best.cycle_s,
            "cycles": cycles,
            "unevenness": choice.phase_scatter,
            "margin": choice.margin,
            "skew_std_ppm": float("nan") if slope_std is None else float(1e6 * slope_std),
        },
        notes=explain_doubt(choice, *recorded),
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


def _scaled(series: ImuSeries, slope: float, middle_ns: int) -> ImuSeries:
    """Return the series on a clock that runs ``slope`` faster, and agrees at ``middle_ns``."""
    extra = np.rint(slope * (series.stamp_ns - middle_ns)).astype(np.int64)
    return replace(series, stamp_ns=series.stamp_ns + extra)


def _coarse_slope(left: Signal, right: Signal) -> float:
    """Return the slope of the right clock with which the whole recordings agree best.

    Zero for recordings too short for a skew to matter.
    """
    span_s = STEP_S * min(len(left.values), len(right.values))
    count = int(np.ceil(LARGEST_SKEW * span_s / SMEAR_S)) if span_s >= LEAST_SPAN_S else 0
    count = min(count, MOST_SLOPES)
    slopes = np.arange(-count, count + 1) * SMEAR_S / span_s
    if count == 0:
        return 0.0
    one = Signal(0, left.values[::COARSE])
    at = np.arange(len(right.values))[::COARSE]

    def height(slope: float) -> float:
        scaled = np.interp(at, np.arange(len(right.values)) * (1.0 + slope), right.values)
        return float(correlate(one, Signal(0, scaled)).value.max())

    return float(max(slopes.tolist(), key=lambda s: (height(s), -abs(s))))


def _windows(left: Signal, right: Signal, whole: CandidateOffset) -> FloatArray:
    return offsets_of_windows(left, right, whole, WINDOW_S, WINDOW_S, 2.0)[0]


def _line(
    windows: FloatArray, lag_s: float, middle_ns: int
) -> tuple[float, float, float | None, float]:
    """Return offset at the middle (s), slope, its std (None: not known), std of the offset (s)."""
    span_s = float(np.ptp(windows[:, 0])) if len(windows) else 0.0
    if len(windows) < 4 or span_s < LEAST_SPAN_S:
        return lag_s, 0.0, None, 0.0
    from scipy.stats import siegelslopes

    time_s, lag = windows[:, 0] - middle_ns * 1e-9, windows[:, 1] - lag_s
    slope, height = (float(v) for v in siegelslopes(lag, time_s))
    scatter = 1.4826 * float(np.median(np.abs(lag - height - slope * time_s)))
    slope_std = scatter / (float(np.std(time_s)) * np.sqrt(len(time_s)))
    if abs(slope) < 3.0 * slope_std:  # not told from zero
        return lag_s, 0.0, slope_std, scatter / np.sqrt(len(time_s))
    return lag_s + height, slope, slope_std, scatter / np.sqrt(len(time_s))
