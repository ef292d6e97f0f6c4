"""A distance observed through sigma points of the 30-state error covariance.

After a projection the covariance is singular by construction, so its square root comes from the
symmetric eigen-decomposition with negative eigenvalues clipped, never from Cholesky.
"""

from __future__ import annotations

import numpy as np

from ..joint_estimate import JointEstimate
from ..samples.series import FloatArray
from .distance_solvers import Vector


def square_root(covariance: FloatArray) -> FloatArray:
    """Return S (n, n) with S S' = covariance, negative eigenvalues taken as zero."""
    values, vectors = np.linalg.eigh(covariance)
    return vectors * np.sqrt(np.clip(values, 0.0, None))


def observe_distance(
    estimate: JointEstimate,
    separation: Vector,
    target: float,
    std: float,
    spread: float,
    central: tuple[float, float],
) -> None:
    """Update with |r| = ``target`` m of noise ``std`` m by symmetric sigma points.

    The points are 0 and plus or minus ``spread`` times the columns of the square root; ``central``
    are the weights of the centre for mean and covariance, the rest is shared equally by the others
    (1 / (2 spread^2) each).  ``separation`` (3,) m is the estimate of r.
    """
    root = spread * square_root(estimate.covariance())
    deviations = np.hstack([np.zeros((30, 1)), root, -root])
    # errors are estimate minus truth, so the true separation is r - (dL - dR)
    points = np.array(separation)[:, None] - (deviations[:3] - deviations[15:18])
    distances = np.sqrt((points**2).sum(axis=0))
    weight = 0.5 / spread**2
    mean = central[0] * distances[0] + weight * distances[1:].sum()
    about = distances - mean
    weights = np.full(len(distances), weight)
    weights[0] = central[1]
    s = float((weights * about**2).sum()) + std * std
    cross = -(deviations * (weights * about)).sum(axis=1)
    estimate.update_with(cross, mean - target, s)
