"""``idc``: minimum-distance moment detection and iterative distance constraint.

Liu et al. 2023, sections III-D and IV-C, Algorithm 1 ("Our_04").  At the minimum-distance moment
the state is projected onto |r| = c0, r = left minus right, if the estimated distance exceeds c0.

Two solvers:

``iterative``  eq. (22), at most five linearisations, the iterate with the least cost eq. (14)
    wins.  With r as the only part of the state the constraint sees, A_l = 2 r_l', b_l =
    |r_l|^2 + c0^2, and eq. (14) is (A_l x - b_l)^2 / (A_l P A_l').  It is a fixed-point
    iteration that need not converge.
``exact``  the minimiser itself.  Stationarity of eqs (14), (15) gives r = (I + mu P_r)^-1 r_0
    with |r| = c0, one monotone equation in mu; the state moves by -mu P_xr r.

With ``distance_std`` s > 0 the distance is a measurement, not a truth: the exact solver then
minimises eq. (14) plus (|r| - c0)^2 / s^2, which changes the equation to |r| (1 - mu s^2) = c0.
The covariance is eq. (23), a rank-1 downdate along the final r.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..joint_estimate import JointEstimate, relative_row
from ..kernel import layout as lay
from ..parameters import Parameters, parameter
from .at_passing import rule_of
from .distance_solvers import Matrix, Vector, iterate
from .minimum_moment import AtMinimumDistance, MomentConfig


@dataclass(frozen=True)
class IdcConfig(MomentConfig):
    """Parameters of the iterative distance constraint."""

    solver: str = parameter(
        "exact", "the minimiser or the paper's iteration", choices=("exact", "iterative")
    )
    iterations: int = parameter(5, "iterations of the iterative solver", minimum=1, maximum=50)


class Idc(AtMinimumDistance):
    """Projects the joint state onto the minimum distance."""

    name = "idc"
    config_class = IdcConfig
    config: IdcConfig

    def __init__(self, config: IdcConfig) -> None:
        """Use ``config``."""
        super().__init__(config)
        self._make_rule()

    def retune(self, config: Parameters) -> None:
        """Go on with other weights of ``config``."""
        super().retune(config)
        self._make_rule()

    def _make_rule(self) -> None:
        own = type(self) is Idc  # another one may say something else at a stance
        config = self.config
        numbers = {
            lay.R_KIND: lay.R_DISTANCE,
            lay.R_SHARE: config.kappa,
            lay.R_LONGEST_S: config.max_stance,
            lay.R_STD: config.distance_std,
            lay.R_ROWS: self.dimensions,
            lay.R_LEARNS: self.spacing.learner is not None,
        }
        at_moment = own and self.is_exact and config.apply_at == "moment"
        self.rule = rule_of(numbers) if at_moment else None

    @property
    def is_exact(self) -> bool:
        """Whether the minimiser itself is wanted."""
        return self.config.solver == "exact"

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Project by the iteration of the paper."""
        std, iterations = self.config.distance_std, self.config.iterations
        direction, push, noise = iterate(r, p, target, std, iterations)
        estimate.update([relative_row(direction)], [push], [noise])
