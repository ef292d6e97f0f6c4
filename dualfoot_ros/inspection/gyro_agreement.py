"""Agreement of the gyro with the accelerometer over the steps of a walk.

At a quiet instant a foot has no velocity, and its specific force is gravity.  Over a gait cycle
from one to the next, of duration T, the gyro's rotation C(t) (body at t to body at the start) says

    integral C(t) f(t) dt = T g_first        the velocity comes back to zero
    C(T)' g_first         = g_last           gravity is where the accelerometer sees it

Both left minus right sides, over g T and g, are the six residuals of a cycle.  They are about 0.02
with a sensor whose parts belong together, and beyond 0.1 where the rate has another unit, another
sign or other axes than the force: the swing then ends with a velocity of metres per second.

Candidates for what is wrong are the 48 ways to name and sign three axes, and the two ways to
mistake degrees.  For those that fit best, scale and bias of the gyro are fitted by least squares,
which gives the scale with its uncertainty.  An accelerometer with all its axes negated is the
mirror image of a walk and cannot be told from one foot alone.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..core import DEGREE, STANDARD_GRAVITY, FloatArray, ImuSeries, median
from .quiet_spans import Spans, quiet_spans
from .turns_in_a_row import one_after_another, products, quaternions_of, turned

LEAST_SPANS = 4
RESIDUAL_STD = 0.03  # of a cycle, for weights and uncertainties
BIAS_STD = 0.05  # rad/s, of a gyro at turn-on
SCALE_STD = 0.3
LEAST_SCALE = 0.5  # below it a fit has turned the sign of the rate
ROUNDS = 6
LARGEST_STEP = 0.3
SMALLEST_STEP = 1e-3
DELTA = 1e-4  # of a difference quotient
AGREES = 0.05  # median residual that needs no other explanation
EXPLAINS = 0.09  # median residual that a candidate may leave
BETTER = 0.6  # times the residual as it is, for another candidate to explain it
TRIED = 4  # candidates that are fitted
AXES = "xyz"


class RateError(StrEnum):
    """What is wrong with the angular rate; the values are its names in JSON."""

    NONE = "none"
    TOO_SMALL = "too_small"
    """By a factor of 180 / pi: taken for degrees, and converted once too often."""
    TOO_LARGE = "too_large"
    """By a factor of 180 / pi: degrees taken for radians."""
    NEGATED = "negated"
    MIRRORED = "mirrored"
    """Left-handed: an odd number of axes is negated or exchanged."""
    TURNED = "turned"
    """Right-handed, but by other axes than the force."""
    UNEXPLAINED = "unexplained"


@dataclass(frozen=True)
class GyroAgreement:
    """Agreement of gyro and accelerometer of one foot.

    Attributes
    ----------
    cycles : number of gait cycles behind it
    residual : median over the cycles, as the samples are
    error : what explains a residual that is too large
    axes : the axes of the force by those of the rate, such as "-x, +y, +z"
    explained : median residual with that
    scale, scale_std : factor that the rate needs beside that
    """

    cycles: int
    residual: float
    error: RateError
    axes: str
    explained: float
    scale: float
    scale_std: float


def gyro_agreement(series: ImuSeries) -> GyroAgreement | None:
    """Return how gyro and accelerometer of one foot agree; None without LEAST_SPANS steps."""
    spans = quiet_spans(series)
    if len(spans) < LEAST_SPANS:
        return None
    as_is = _as_it_is(spans)
    best = as_is
    if as_is.residual > AGREES:
        others = [_fit(spans, candidate) for candidate in _nearest(spans)]
        best = min(
            (fit for fit in others if fit.scale > LEAST_SCALE), key=_residual, default=as_is
        )
        if best.residual > BETTER * as_is.residual:
            best = as_is
    return GyroAgreement(
        cycles=len(spans),
        residual=as_is.residual,
        error=_name(best),
        axes=_axes(best.candidate),
        explained=best.residual,
        scale=best.scale,
        scale_std=best.scale_std,
    )


def _as_it_is(spans: Spans) -> _Fit:
    """Fit the rate as it is; not fitted where that turned its sign."""
    fit = _fit(spans, np.eye(3))
    if fit.scale > LEAST_SCALE:
        return fit
    found = _median(_residuals(spans, fit.candidate[np.newaxis], np.zeros((1, 3))))
    return _Fit(fit.candidate, float(found[0]), 1.0, SCALE_STD)


class _Fit(NamedTuple):
    """Scale of the rate after ``candidate`` (3, 3) was applied to it, and what is left."""

    candidate: FloatArray
    residual: float
    scale: float
    scale_std: float


def _residual(fit: _Fit) -> float:
    return fit.residual


def _name(fit: _Fit) -> RateError:
    if fit.residual > EXPLAINS:
        return RateError.UNEXPLAINED
    size = float(np.abs(fit.candidate).max())
    if size != 1.0:
        return RateError.TOO_SMALL if size > 1.0 else RateError.TOO_LARGE
    if np.array_equal(fit.candidate, np.eye(3)):
        return RateError.NONE
    if np.array_equal(fit.candidate, -np.eye(3)):
        return RateError.NEGATED
    mirrored = np.linalg.det(fit.candidate) < 0.0
    return RateError.MIRRORED if mirrored else RateError.TURNED


def _axes(candidate: FloatArray) -> str:
    """Return the rows of a signed permutation as axes of the rate."""
    columns = np.abs(candidate).argmax(axis=1).tolist()
    signs = np.sign(candidate[range(3), columns])
    return ", ".join(
        f"{'+' if s > 0 else '-'}{AXES[c]}" for s, c in zip(signs, columns, strict=True)
    )


def _candidates() -> FloatArray:
    """Return (50, 3, 3): signed permutations, and the two factors of degrees."""
    found = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            found.append(matrix)
    return np.array([*found, np.eye(3) / DEGREE, np.eye(3) * DEGREE])


def _nearest(spans: Spans) -> FloatArray:
    """Return the TRIED candidates with the smallest residuals, bias and scale aside."""
    candidates = _candidates()
    found = _median(_residuals(spans, candidates, np.zeros((len(candidates), 3))))
    return candidates[np.argsort(found)[:TRIED]]


def _fit(spans: Spans, candidate: FloatArray) -> _Fit:
    """Fit scale and bias by Gauss-Newton with Huber's weights."""
    x = np.zeros(4)  # relative error of the scale; bias after the candidate, rad/s
    prior = 1.0 / np.array([SCALE_STD, BIAS_STD, BIAS_STD, BIAS_STD]) ** 2
    delta = DELTA * np.vstack([np.zeros(4), np.eye(4)])
    information = np.diag(prior)
    for _ in range(ROUNDS):
        found = _at(spans, candidate, x + delta)
        now, slopes = found[0], (found[1:] - found[0]) / DELTA
        size = np.linalg.norm(now, axis=1) / (2.0 * RESIDUAL_STD)
        weights = 1.0 / (np.maximum(1.0, size) * RESIDUAL_STD**2)
        information = np.einsum("ika,k,jka->ij", slopes, weights, slopes) + np.diag(prior)
        slope = np.einsum("ika,k,ka->i", slopes, weights, now) + prior * x
        step = -np.linalg.solve(information, slope)
        largest = float(np.abs(step).max())
        x = x + step * min(1.0, LARGEST_STEP / largest) if largest > 0.0 else x
        if largest < SMALLEST_STEP:
            break
    left = float(_median(_at(spans, candidate, x[np.newaxis]))[0])
    std = float(np.sqrt(np.linalg.inv(information)[0, 0])) * max(1.0, left / RESIDUAL_STD)
    return _Fit(candidate, left, 1.0 + float(x[0]), std)


def _at(spans: Spans, candidate: FloatArray, x: FloatArray) -> FloatArray:
    """Return the residuals (P, K, 6) at the parameters ``x`` (P, 4)."""
    matrices = (1.0 + x[:, 0])[:, np.newaxis, np.newaxis] * candidate
    return _residuals(spans, matrices, x[:, 1:])


def _residuals(spans: Spans, matrices: FloatArray, biases: FloatArray) -> FloatArray:
    """Return the residuals (P, K, 6) with rates M w - b, for (P, 3, 3) M and (P, 3) b."""
    x, y, z = np.moveaxis(spans.rate, -1, 0)[:, :, np.newaxis]
    within = spans.within[:, np.newaxis, :, 0]
    rows, offsets = matrices.transpose(1, 2, 0)[..., np.newaxis], biases.T[..., np.newaxis]
    pairs = zip(rows, offsets, strict=True)
    rates = np.stack([a * x + b * y + c * z - off * within for (a, b, c), off in pairs])
    halves = quaternions_of(0.5 * spans.step_s * rates)
    forces = np.stack([*np.moveaxis(spans.force * spans.step_s, -1, 0)])[:, :, np.newaxis]
    attitude, velocity = one_after_another(products(halves, halves), turned(halves, forces))
    duration = spans.duration_s
    first, last = (np.moveaxis(g, -1, 0)[:, np.newaxis] for g in (spans.first, spans.last))
    there = turned(attitude * [[[-1.0]], [[-1.0]], [[-1.0]], [[1.0]]], first)
    found = np.concatenate(
        [
            (velocity - first * duration) / (STANDARD_GRAVITY * duration),
            (there - last) / STANDARD_GRAVITY,
        ]
    )
    return np.moveaxis(found, 0, -1)


def _median(residuals: FloatArray) -> FloatArray:
    """Return the median over the cycles of the residuals' size, (P,)."""
    return np.array([median(sizes) for sizes in np.linalg.norm(residuals, axis=-1)])
