"""The Allan deviation of a standstill, and the noise parameters from its slopes.

Overlapping estimator, eq. (11) of Riley and Howe, Handbook of Frequency Stability Analysis (NIST
SP 1065, 2008): with theta the integral of the signal, n samples of tau_0, tau = m tau_0,

    sigma^2(tau) = 1 / (2 tau^2 (n - 2m + 1)) sum_k (theta_k+2m - 2 theta_k+m + theta_k)^2.

The slopes are those of IEEE Std 952-1997, annex C: white noise of density N gives N / sqrt(tau),
bias instability B a floor of B sqrt(2 ln 2 / pi), a random walk K of the bias K sqrt(tau / 3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core import CalibrationError, FloatArray

PER_OCTAVE = 4
SHARE = 1.0 / 9.0  # of the record, the longest averaging time; its deviation is known to 25 %
SLOPE_ERROR = 0.15  # a slope counts as that of white noise within this
FLOOR = math.sqrt(2.0 * math.log(2.0) / math.pi)
ABOVE_SIGMAS = 3.0  # the curve must be above the line of the white noise by this at its end
LEAST_SAMPLES = 90


@dataclass(frozen=True)
class AllanCurve:
    """The Allan deviation of one or more axes.

    Attributes
    ----------
    tau : (T,) s
    deviation : (T, A) in the unit of the signal
    relative_error : (T,) standard deviation of the deviation, as a share of it
    duration_s : length of the record
    """

    tau: FloatArray
    deviation: FloatArray
    relative_error: FloatArray
    duration_s: float


def overlapping(signal: FloatArray, interval_s: float, spans: Sequence[int]) -> FloatArray:
    """Return the overlapping Allan deviation (T,) of (n,) samples over ``spans`` (samples)."""
    theta = np.concatenate(([0.0], np.cumsum(signal - np.mean(signal)))) * interval_s
    deviations = []
    for m in spans:
        second = theta[2 * m :] - 2.0 * theta[m:-m] + theta[: -2 * m]
        tau = m * interval_s
        deviations.append(math.sqrt(float(np.mean(second**2)) / 2.0) / tau)
    return np.array(deviations)


def allan_curve(signals: FloatArray, interval_s: float) -> AllanCurve:
    """Return the curve of (n, A) samples that are ``interval_s`` apart.

    Raises
    ------
    CalibrationError
        When there are too few samples for any.
    """
    count = len(signals)
    if count < LEAST_SAMPLES:
        raise CalibrationError(
            f"{count} samples are too few for an Allan deviation; needed are {LEAST_SAMPLES}"
        )
    octaves = math.log2(count * SHARE)
    exponents = np.arange(math.floor(octaves * PER_OCTAVE) + 1) / PER_OCTAVE
    spans = np.unique(np.floor(2.0**exponents + 0.5).astype(int))
    spans = spans[spans <= count * SHARE]
    deviation = np.column_stack([overlapping(s, interval_s, spans.tolist()) for s in signals.T])
    error = 1.0 / np.sqrt(2.0 * (count / spans - 1.0))
    return AllanCurve(spans * interval_s, deviation, error, count * interval_s)


@dataclass(frozen=True)
class Slopes:
    """The noise parameters from the curve of one axis; None where the curve does not show them.

    Attributes
    ----------
    white : noise density N, unit sqrt(s)
    floor, floor_tau : bias instability B, unit, and the averaging time of the floor, s
    walk : random walk K of the bias, unit / sqrt(s)
    lowest : the least deviation: no floor is above lowest / 0.664
    """

    white: float | None
    floor: float | None
    floor_tau: float | None
    walk: float | None
    lowest: float


def slopes_of(curve: AllanCurve, axis: int) -> Slopes:
    """Read the slopes of one axis off its curve."""
    tau, deviation = curve.tau, curve.deviation[:, axis]
    if not (deviation > 0.0).all():
        return Slopes(None, None, None, None, float(deviation.min()))
    at = int(np.argmin(deviation))
    error = curve.relative_error
    slope = _local_slope(tau, deviation)
    falling = (np.abs(slope + 0.5) < SLOPE_ERROR) & (np.arange(len(tau)) <= at)
    white = _mean_log(deviation * np.sqrt(tau), falling, error)
    floor = white is not None and at > 0 and _leaves_white_noise(curve, deviation, white)
    return Slopes(
        white=white,
        floor=float(deviation[at]) / FLOOR if floor else None,
        floor_tau=float(tau[at]) if floor else None,
        walk=_walk(curve, deviation) if floor else None,
        lowest=float(deviation[at]),
    )


def _leaves_white_noise(curve: AllanCurve, deviation: FloatArray, white: float) -> bool:
    """Return whether the end of the curve has left the line of the white noise for certain."""
    least = deviation[-1] * (1.0 - ABOVE_SIGMAS * curve.relative_error[-1])
    return bool(least > white / math.sqrt(curve.tau[-1]))


def _local_slope(tau: FloatArray, deviation: FloatArray) -> FloatArray:
    """Return the slope (T,) of the log-log curve, fitted over an octave on each side."""
    x, y = np.log(tau), np.log(deviation)
    slope = np.empty(len(tau))
    for k in range(len(tau)):
        near = np.abs(x - x[k]) <= math.log(2.0) * 1.01
        slope[k] = np.polyfit(x[near], y[near], 1)[0] if near.sum() > 1 else np.nan
    return slope


def _walk(curve: AllanCurve, deviation: FloatArray) -> float | None:
    """Return K from the fit sigma^2 = N^2 / tau + F^2 + K^2 tau / 3, where K rules the end."""
    from scipy.optimize import nnls

    tau = curve.tau
    parts = np.column_stack([1.0 / tau, np.ones(len(tau)), tau / 3.0])
    weight = 1.0 / (2.0 * curve.relative_error * deviation**2)
    squares, _ = nnls(parts * weight[:, None], deviation**2 * weight)
    last = parts[-1] * squares
    return math.sqrt(float(squares[2])) if last[2] > 0.5 * last.sum() else None


def _mean_log(level: FloatArray, use: np.ndarray, error: FloatArray) -> float | None:
    """Return the weighted geometric mean of the levels in use, None for fewer than three."""
    if use.sum() < 3:
        return None
    return float(np.exp(np.average(np.log(level[use]), weights=error[use] ** -2)))
