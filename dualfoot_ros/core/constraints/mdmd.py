"""``mdmd_ekf``, ``mdmd_ukf``, ``mdmd_ckf``: the minimum distance as a pseudo-observation.

Liu et al. 2023, section V ("Our_01" to "Our_03"): at the minimum-distance moment h(x) = |r| is
observed by

``mdmd_ekf``  an EKF update, linearised once at the estimate, with the direction of r as its row
    (after Niu et al. 2019);
``mdmd_ukf``  Julier and Uhlmann's unscented transform with n = 30 and
    lambda = alpha^2 (n + kappa) - n;
``mdmd_ckf``  the third-degree spherical-radial cubature rule of Arasaratnam and Haykin 2009: 2 n
    points at sqrt(n), equal weights, no centre.

After a projection the covariance is singular by construction, so its square root comes from the
symmetric eigen-decomposition with negative eigenvalues clipped, never from Cholesky.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..joint_estimate import JointEstimate, relative_row
from ..kernel.layout import ERRORS
from ..parameters import parameter
from ..samples.series import FloatArray
from .distance_solvers import Matrix, Vector, norm
from .minimum_moment import AtMinimumDistance, MomentConfig

STATES = 2 * ERRORS


@dataclass(frozen=True)
class MdmdEkfConfig(MomentConfig):
    """Parameters of the EKF pseudo-observation."""


@dataclass(frozen=True)
class MdmdUkfConfig(MomentConfig):
    """Parameters of the unscented pseudo-observation."""

    alpha: float = parameter(1.0, "spread of the sigma points", minimum=1e-3, maximum=2.0)
    beta: float = parameter(2.0, "prior knowledge (2: Gaussian)", minimum=0.0, maximum=10.0)
    scaling: float = parameter(
        0.0, "secondary scaling of the unscented transform", minimum=0.0, maximum=10.0
    )


@dataclass(frozen=True)
class MdmdCkfConfig(MomentConfig):
    """Parameters of the cubature pseudo-observation."""


class MdmdEkf(AtMinimumDistance):
    """Observes the minimum distance by an EKF update."""

    name = "mdmd_ekf"
    config_class: ClassVar[type[MomentConfig]] = MdmdEkfConfig

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Update with the one row along r."""
        distance = norm(r)
        row = relative_row([x / distance for x in r])
        innovation = distance - target
        estimate.update([row], [innovation], [self.config.distance_std**2])


class MdmdUkf(AtMinimumDistance):
    """Observes the minimum distance by an unscented update."""

    name = "mdmd_ukf"
    config_class = MdmdUkfConfig
    config: MdmdUkfConfig

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Update with 61 sigma points."""
        c = self.config
        total = c.alpha**2 * (STATES + c.scaling)
        centre = (total - STATES) / total
        weights = (centre, centre + 1.0 - c.alpha**2 + c.beta)
        observe_distance(estimate, r, target, c.distance_std, math.sqrt(total), weights)


class MdmdCkf(AtMinimumDistance):
    """Observes the minimum distance by a cubature update."""

    name = "mdmd_ckf"
    config_class = MdmdCkfConfig

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Update with 60 cubature points."""
        spread = math.sqrt(STATES)
        observe_distance(estimate, r, target, self.config.distance_std, spread, (0.0, 0.0))


def square_root(covariance: FloatArray) -> FloatArray:
    """Return S (n, n) with S S' = covariance, negative eigenvalues taken as zero."""
    values, vectors = np.linalg.eigh(covariance)
    root: FloatArray = vectors * np.sqrt(np.clip(values, 0.0, None))
    return root


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
    deviations = np.hstack([np.zeros((STATES, 1)), root, -root])
    # errors are estimate minus truth, so the true separation is r - (dL - dR)
    points = np.array(separation)[:, None] - (deviations[:3] - deviations[ERRORS : ERRORS + 3])
    distances = np.sqrt((points**2).sum(axis=0))
    weight = 0.5 / spread**2
    mean = central[0] * distances[0] + weight * distances[1:].sum()
    about = distances - mean
    weights = np.full(len(distances), weight)
    weights[0] = central[1]
    s = float((weights * about**2).sum()) + std * std
    cross = -(deviations * (weights * about)).sum(axis=1)
    estimate.update_with(cross, mean - target, s)
