"""``mdmd_ekf``: the minimum distance as a pseudo-observation in an EKF update.

Liu et al. 2023, section V ("Our_01"), after Niu et al. 2019: h(x) = |r|, linearised once at the
estimate, with the direction of r as its row.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..joint_estimate import JointEstimate, relative_row
from .distance_solvers import Matrix, Vector, norm
from .minimum_moment import AtMinimumDistance, MomentParameters


@dataclass(frozen=True)
class Config(MomentParameters):
    """Parameters of the EKF pseudo-observation."""


class Method(AtMinimumDistance):
    """Observes the minimum distance by an EKF update."""

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Update with the one row along r."""
        distance = norm(r)
        row = relative_row([x / distance for x in r])
        innovation = distance - target
        estimate.update([row], [innovation], [self.config.distance_std**2])
