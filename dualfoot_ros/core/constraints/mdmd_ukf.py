"""``mdmd_ukf``: the minimum distance as a pseudo-observation in an unscented update.

Liu et al. 2023, section V ("Our_02"); Julier and Uhlmann's unscented transform with n = 30,
lambda = alpha^2 (n + kappa) - n.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..joint_estimate import JointEstimate
from ..parameters import parameter
from .distance_solvers import Matrix, Vector
from .minimum_moment import AtMinimumDistance, MomentParameters
from .sigma_points import observe_distance

STATES = 30


@dataclass(frozen=True)
class Config(MomentParameters):
    """Parameters of the unscented pseudo-observation."""

    alpha: float = parameter(1.0, "spread of the sigma points", minimum=1e-3, maximum=2.0)
    beta: float = parameter(2.0, "prior knowledge (2: Gaussian)", minimum=0.0, maximum=10.0)
    scaling: float = parameter(
        0.0, "secondary scaling of the unscented transform", minimum=0.0, maximum=10.0
    )


class Method(AtMinimumDistance):
    """Observes the minimum distance by an unscented update."""

    config: Config

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Update with 61 sigma points."""
        c = self.config
        total = c.alpha**2 * (STATES + c.scaling)
        centre = (total - STATES) / total
        weights = (centre, centre + 1.0 - c.alpha**2 + c.beta)
        observe_distance(estimate, r, target, c.distance_std, math.sqrt(total), weights)
