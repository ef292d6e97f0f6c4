"""Check of a gyro matrix on walks left out of the fit, without any known point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .gyro_matrix import GyroMatrixFit, combine
from .matrix_filter import Information

FEWEST_WALKS = 2


@dataclass(frozen=True)
class LeftOut:
    """One walk against the matrix from the other walks.

    Attributes
    ----------
    elements : (6,) the matrix of the others: xx, yy, zz, xy, xz, yz
    explained : share of the walk's misfit of zero velocity that this matrix takes away, of what a
        matrix of the walk's own would (1: all, 0: no use, negative: harm)
    agreement : squared difference of the two by its variance, per degree of freedom; about 1 when
        the stated uncertainties hold
    """

    elements: FloatArray
    explained: float
    agreement: float


def leave_each_out(fit: GyroMatrixFit) -> tuple[LeftOut, ...]:
    """Return the check of every walk, none when there are fewer than two."""
    if len(fit.walks) < FEWEST_WALKS:
        return ()
    return tuple(_left_out(fit, k) for k in range(len(fit.walks)))


def _left_out(fit: GyroMatrixFit, k: int) -> LeftOut:
    walk = fit.walks[k]
    others = [each for j, each in enumerate(fit.walks) if j != k]
    mean, covariance = combine(others, fit.noise, fit.start - fit.point)
    without = np.concatenate([fit.start[:6] - fit.point[:6], mean[6:]])
    own = np.linalg.pinv(walk.matrix, hermitian=True) @ walk.vector
    gained = _misfit(walk, without) - _misfit(walk, mean)
    possible = _misfit(walk, without) - _misfit(walk, own)
    return LeftOut(
        elements=(fit.point + mean)[:6],
        explained=gained / possible if possible > 0.0 else 0.0,
        agreement=_agreement(walk, mean, covariance),
    )


def _misfit(walk: Information, x: FloatArray) -> float:
    """Return the sum of squares of the walk at ``x`` (8,), less a constant."""
    return float(x @ walk.matrix @ x - 2.0 * x @ walk.vector)


def _agreement(walk: Information, mean: FloatArray, covariance: FloatArray) -> float:
    """Return the NIS per degree of freedom of the walk's vector, predicted by the others."""
    off = walk.vector - walk.matrix @ mean
    spread = walk.matrix + walk.matrix @ covariance @ walk.matrix
    return float(off @ np.linalg.pinv(spread, hermitian=True) @ off) / len(off)


def median_explained(checks: Sequence[LeftOut]) -> float:
    """Return the median share that matrices of other walks explain, nan without any."""
    return float(np.median([each.explained for each in checks])) if checks else float("nan")
