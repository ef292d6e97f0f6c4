"""Random processes: smooth motion of a walker, slow drift of a sensor."""

from __future__ import annotations

from itertools import accumulate

import numpy as np

from ..core import FloatArray


def smooth_noise(time_s: FloatArray, spacing_s: float, rng: np.random.Generator) -> FloatArray:
    """Return (N, 3) smooth noise of unit variance whose values decorrelate over ``spacing_s``."""
    from scipy.interpolate import BSpline

    start = time_s[0] - 4.0 * spacing_s
    count = int(np.ceil((time_s[-1] - start) / spacing_s)) + 8
    knots = start + spacing_s * np.arange(count + 4)
    spline = BSpline(knots, rng.standard_normal((count, 3)), 3)
    noise: FloatArray = spline(time_s) / np.sqrt(_BSPLINE_VARIANCE)
    return noise


def smooth_rate_noise(
    time_s: FloatArray, spacing_s: float, rng: np.random.Generator
) -> FloatArray:
    """Return (N, 3) smooth noise whose derivative has unit variance."""
    noise: FloatArray = (
        smooth_noise(time_s, spacing_s, rng)
        * spacing_s
        * np.sqrt(_BSPLINE_VARIANCE / _BSPLINE_RATE_VARIANCE)
    )
    return noise


def gauss_markov(keep: float, normal: FloatArray) -> FloatArray:
    """Return a first-order Gauss-Markov process (N,) or (N, 3) of unit variance.

    ``keep`` is the correlation from one sample to the next, ``normal`` what drives the process:
    white, of unit variance, of the same shape.
    """
    drive = np.sqrt(1.0 - keep * keep) * normal
    drive[:1] /= np.sqrt(1.0 - keep * keep)
    # What scipy.signal.lfilter does, whose package takes longer to load than this for an hour.
    process = np.empty(drive.shape)
    for to, column in zip(np.atleast_2d(process.T), np.atleast_2d(drive.T), strict=True):
        sums = accumulate(column.tolist(), lambda before, now: now + keep * before)
        to[:] = np.fromiter(sums, np.float64, len(column))
    return process


# Mean variance of a cubic B-spline with white unit coefficients, and of its derivative per knot
# spacing: the integrals of B^2 and B'^2 over the cardinal spline (151/315 and 2/3).
_BSPLINE_VARIANCE = 151.0 / 315.0
_BSPLINE_RATE_VARIANCE = 2.0 / 3.0
