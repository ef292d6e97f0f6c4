"""Offset of two clocks from a shake: both devices held together and turned to and fro.

Held together they turn alike, so their angular rates differ by a constant rotation only.  The
correlation of the norms finds the lag.  Two things tell a shake from feet that merely walk
alike: a rotation maps the one vector on the other (Kabsch 1976), and nothing else in the recording
matches nearly as well, while a step is like any other step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, ImuSeries, TimingError
from .correlation import STEP_S, Signal, signal_of
from .result import Offset

SMOOTH_S = 0.01
WINDOW_S, HOP_S = 3.0, 1.0
LEAST_RATE = 1.5  # rad/s rms in a window worth a look
LEAST_CORRELATION = 0.9  # of the norms, before the vectors are compared
LARGEST_RESIDUAL = 0.10  # of the rotated rates; real feet that walk differ by 0.19 and more
LEAST_LEAD = 4.0  # of what the best correlation elsewhere leaves over what this one leaves
AGREE_S = 0.5  # within which the offsets of all shakes lie
LEAST_SPAN_S = 30.0  # between shakes, to tell a skew
STD_S = 0.001


@dataclass(frozen=True)
class Shake:
    """One window in which both turned alike.

    Attributes
    ----------
    stamp_s : middle of the window on the right foot's clock, s
    lag_s : to be added to the right foot's stamps, s
    residual : rms of left minus rotated right angular rate over the rms of the left one
    correlation, second : of the norms, at this lag and at the best one elsewhere
    """

    stamp_s: float
    lag_s: float
    residual: float
    correlation: float
    second: float


def offset_by_shake(
    left: ImuSeries, right: ImuSeries, shakes: list[Shake] | None = None
) -> Offset:
    """Return what to add to the right foot's stamps so that the shakes coincide.

    Raises
    ------
    TimingError
        When there is no shake.
    """
    found = find_shakes(left, right) if shakes is None else shakes
    if not found:
        raise TimingError(
            "no shake is found: at no time did both devices turn alike by more than "
            f"{LEAST_RATE} rad/s for {WINDOW_S:g} s, and as at no other time; hold them together "
            "and turn them to and fro"
        )
    best = min(found, key=lambda s: s.residual)
    time_s = np.array([s.stamp_s for s in found])
    lag = np.array([s.lag_s for s in found])
    slope = 0.0
    known = float(np.ptp(time_s)) >= LEAST_SPAN_S
    if known:
        slope, at_best = (float(v) for v in np.polyfit(time_s - best.stamp_s, lag, 1))
    else:
        at_best = float(np.median(lag))
    return Offset(
        method="shake",
        offset_ns=round(at_best * 1e9),
        center_ns=round(best.stamp_s * 1e9),
        skew_ppm=0.0 - 1e6 * slope,
        skew_known=known,
        std_s=float(np.hypot(STD_S, np.std(lag - at_best - slope * (time_s - best.stamp_s)))),
        confidence=float(np.clip(1.0 - best.residual / LARGEST_RESIDUAL * 0.5, 0.0, 1.0)),
        detail={
            "residual": best.residual,
            "agreement": best.correlation,
            "second": best.second,
            "shakes": float(len(found)),
        },
    )


def find_shakes(left: ImuSeries, right: ImuSeries) -> list[Shake]:
    """Return the windows in which both devices turned alike, and as nowhere else.

    All are at lags that belong together.
    """
    if min(left.duration_s, right.duration_s) < WINDOW_S:
        return []
    norms = [signal_of(s, np.linalg.norm(s.angular_rate, axis=1), SMOOTH_S) for s in (left, right)]
    size, hop = round(WINDOW_S / STEP_S), round(HOP_S / STEP_S)
    found, stretches = [], Stretches(norms[1].values, size)
    for begin in range(0, len(norms[0].values) - size + 1, hop):
        part = norms[0].part(begin, begin + size)
        if np.sqrt(np.mean(part.values**2)) >= LEAST_RATE:
            shake = _match(part, norms[1], stretches, left, right)
            if shake is not None:
                found.append(shake)
    if not found:
        return []
    best = min(found, key=lambda s: s.residual)
    return [s for s in found if abs(s.lag_s - best.lag_s) < AGREE_S]


def _match(
    part: Signal, other: Signal, stretches: Stretches, left: ImuSeries, right: ImuSeries
) -> Shake | None:
    value = stretches.coefficient(part.values)
    if not len(value):
        return None
    top = int(np.argmax(value))
    if value[top] < LEAST_CORRELATION or not 0 < top < len(value) - 1:
        return None
    before, peak, after = value[top - 1 : top + 2]
    start_s = STEP_S * (top + 0.5 * (before - after) / (before - 2.0 * peak + after))
    lag_s = (part.start_ns - other.start_ns) * 1e-9 - start_s
    residual = _residual(part, left, right, lag_s)
    if residual > LARGEST_RESIDUAL:
        return None
    apart = np.abs(np.arange(len(value)) - top) > round(0.5 / STEP_S)
    second = float(value[apart].max()) if apart.any() else 0.0
    if 1.0 - second < LEAST_LEAD * (1.0 - value[top]):
        return None
    middle_s = other.start_ns * 1e-9 + start_s + 0.5 * WINDOW_S
    return Shake(middle_s, lag_s, residual, float(peak), second)


class Stretches:
    """All stretches of ``count`` values of a signal, which windows of that size are put beside."""

    def __init__(self, values: FloatArray, count: int) -> None:
        self._values = values
        sums = np.concatenate(([0.0], np.cumsum(values)))
        squares = np.concatenate(([0.0], np.cumsum(values**2)))
        total = sums[count:] - sums[:-count]
        self._variance = np.maximum(squares[count:] - squares[:-count] - total**2 / count, 1e-9)

    def coefficient(self, window: FloatArray) -> FloatArray:
        """Return Pearson's correlation of ``window`` (n,) with every stretch."""
        from scipy.signal import correlate

        if not len(self._variance):
            return np.empty(0)
        centred = window - window.mean()
        product = correlate(self._values, centred, mode="valid")
        energy = max(float(centred @ centred), 1e-9)
        correlation: FloatArray = product / np.sqrt(self._variance * energy)
        return correlation


def _residual(part: Signal, left: ImuSeries, right: ImuSeries, lag_s: float) -> float:
    """Return how much of the left angular rate no rotation of the right one explains."""
    time_ns = part.start_ns + np.rint(np.arange(len(part.values)) * STEP_S * 1e9).astype(np.int64)
    one = _sampled(left, time_ns)
    two = _sampled(right, time_ns - round(lag_s * 1e9))
    u, _, vt = np.linalg.svd(two.T @ one)
    turn = u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt
    return float(np.sqrt(np.mean((one - two @ turn) ** 2) / max(np.mean(one**2), 1e-12)))


def _sampled(series: ImuSeries, time_ns: np.ndarray) -> FloatArray:
    start = int(series.stamp_ns[0])
    at, known = (time_ns - start) * 1e-9, (series.stamp_ns - start) * 1e-9
    rates = [np.interp(at, known, series.angular_rate[:, k]) for k in range(3)]
    centred: FloatArray = np.array(rates).T - np.mean(rates, axis=1)
    return centred
