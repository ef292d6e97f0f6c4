"""The gyro matrix of one sensor, and the pivot of its foot, from ordinary walks.

Gauss-Newton over the walks: each pass filters every walk at the present estimate and adds what the
walks tell to the prior (see :mod:`.matrix_filter`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .filter_terms import FilterNoise, symmetric
from .foot_walk import FootWalk
from .matrix_filter import Information, filter_walk

PASSES = 3


@dataclass(frozen=True)
class GyroMatrixFit:
    """The fit of one foot.

    Attributes
    ----------
    point : (8,) the elements xx, yy, zz, xy, xz, yz, then height and set-back of the pivot, m
    covariance : (8, 8)
    walks : what each walk tells, linearised at ``point``
    noise : of the fit
    start : (8,) mean of the prior
    """

    point: FloatArray
    covariance: FloatArray
    walks: tuple[Information, ...]
    noise: FilterNoise
    start: FloatArray

    @property
    def elements(self) -> FloatArray:
        """The six elements of S: xx, yy, zz, xy, xz, yz."""
        return self.point[:6]

    @property
    def elements_std(self) -> FloatArray:
        """Their standard deviations (6,)."""
        return np.sqrt(np.diag(self.covariance)[:6])

    @property
    def matrix(self) -> FloatArray:
        """I + S (3, 3): true rate = matrix (measured - bias)."""
        return np.eye(3) + symmetric(self.elements)

    @property
    def pivot(self) -> tuple[float, float]:
        """Height of the sensor above the pivot and how far the pivot is behind it, m."""
        return float(self.point[6]), float(self.point[7])

    @property
    def pivot_std(self) -> tuple[float, float]:
        """Their standard deviations, m."""
        return float(self.covariance[6, 6] ** 0.5), float(self.covariance[7, 7] ** 0.5)


def fit_matrix(
    walks: Sequence[FootWalk],
    pivot: tuple[float, float],
    noise: FilterNoise | None = None,
) -> GyroMatrixFit:
    """Fit the matrix of the sensor that was worn on all ``walks``.

    ``pivot`` is the mean of its prior: height of the sensor above the pivot, set-back, m.
    """
    noise = noise or FilterNoise()
    start = np.array([0.0] * 6 + list(pivot))
    point = start.copy()
    for _ in range(PASSES):
        found = tuple(filter_walk(walk, point, noise) for walk in walks)
        mean, covariance = combine(found, noise, start - point)
        point = point + mean
    told = tuple(_moved(each, mean) for each in found)
    return GyroMatrixFit(point, covariance, told, noise, start)


def combine(
    walks: Sequence[Information], noise: FilterNoise, prior_mean: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return mean (8,) and covariance (8, 8) from walks and the prior, ``prior_mean`` (8,)."""
    known = np.diag(1.0 / noise.prior())
    information = known + sum(each.matrix for each in walks)
    covariance = np.asarray(np.linalg.inv(information), dtype=np.float64)
    mean = covariance @ (known @ prior_mean + sum(each.vector for each in walks))
    return mean, covariance


def _moved(information: Information, by: FloatArray) -> Information:
    """Return what a walk tells, relative to a point that is ``by`` (8,) farther."""
    return Information(
        information.matrix, information.vector - information.matrix @ by, information.misfit
    )
