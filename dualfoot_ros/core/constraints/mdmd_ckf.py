"""``mdmd_ckf``: the minimum distance as a pseudo-observation in a cubature update.

Liu et al. 2023, section V ("Our_03"); the third-degree spherical-radial cubature rule of
Arasaratnam and Haykin 2009: 2 n points at sqrt(n), equal weights, no centre.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..joint_estimate import JointEstimate
from .distance_solvers import Matrix, Vector
from .minimum_moment import AtMinimumDistance, MomentParameters
from .sigma_points import observe_distance

STATES = 30


@dataclass(frozen=True)
class Config(MomentParameters):
    """Parameters of the cubature pseudo-observation."""


class Method(AtMinimumDistance):
    """Observes the minimum distance by a cubature update."""

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Update with 60 cubature points."""
        c = self.config
        spread = math.sqrt(STATES)
        observe_distance(estimate, r, target, c.distance_std, spread, (0.0, 0.0))
