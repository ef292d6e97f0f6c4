"""The minimum-distance moment (MDMD) of Liu et al. 2023, section IV-C, and what happens there.

When a stance of one foot has ended and the other foot was swinging past it, the feet were closest
at t_min = (1 - kappa) t_fst + kappa t_end, eq. (31).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..kernel import layout as lay
from ..parameters import Parameters, parameter
from ..results.payloads import DistanceLimit, Passing, Reason
from .at_passing import AtPassing
from .distance_solvers import Matrix, Vector, norm
from .learnt_spacing import Spacing
from .method import Gait, Request, StancePhase


@dataclass(frozen=True)
class MomentConfig(Parameters):
    """What every method at the minimum-distance moment has in common."""

    distance: float = parameter(
        0.0,
        "minimum distance c0 of the two sensors (0: learnt from the walk)",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    distance_std: float = parameter(
        0.1,
        "scatter of that distance (0: a hard constraint, as idc has it in the paper)",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    kappa: float = parameter(
        0.55, "minimum-distance moment as a share of the stance", minimum=0.0, maximum=1.0
    )
    apply_at: str = parameter(
        "moment",
        "at the moment itself (roll back, apply, re-run) or when it is detected",
        choices=("moment", "detection"),
    )
    max_stance: float = parameter(
        1.2, "a longer stance is no step", unit="s", minimum=0.2, maximum=3.0
    )


class AtMinimumDistance(AtPassing):
    """Asks for one constraint at the minimum-distance moment of every stance of a walk."""

    config: MomentConfig

    def __init__(self, config: MomentConfig) -> None:
        """Use ``config``."""
        self.config = config
        self.spacing = Spacing(config.distance)
        self.memory_s = (1.0 - config.kappa) * config.max_stance

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the constraint at the minimum-distance moment of ``stance``, if it is a step."""
        moment = self.moment(stance, gait)
        if moment is None:
            return ()
        target = self.spacing.value_m
        constrain = partial(self.apply, target=target, heading=stance.heading)
        left, right = gait.positions_after(moment).tolist()
        separation = [a - b for a, b in zip(left, right, strict=True)]
        if self.config.apply_at == "moment" and norm(separation) > target:
            return (Request(moment, True, constrain),)
        return (Request(moment, False, partial(constrain, separation=separation)),)

    def moment(self, stance: StancePhase, gait: Gait) -> int | None:
        """Return the epoch of the minimum distance, None when the stance is no step."""
        moment = stance.moment(self.config.kappa)
        if stance.duration_s > self.config.max_stance or not gait.remembers(moment):
            return None
        return None if gait.in_stance(1 - stance.foot, moment) else moment

    def apply(
        self,
        estimate: JointEstimate,
        target: float | None = None,
        heading: float = 0.0,
        separation: Vector | None = None,
    ) -> Outcome:
        """Constrain the distance to ``target`` m (as given or learnt) if it exceeds it.

        ``separation`` is r at the moment, when the constraint is applied later; ``heading`` (rad)
        goes into the outcome.
        """
        target = self.spacing.value_m if target is None else target
        given = (0.0, 0.0, 0.0) if separation is None else separation
        exceeds, found = estimate.act(
            "constrain_distance",
            target,
            self.config.distance_std,
            self.is_exact,
            separation is not None,
            *given,
        )
        if exceeds and not self.is_exact:
            r = found[lay.X_BEFORE : lay.X_NOW]
            self.correct(estimate, r, covariance_of(found), target)
            distance, moved = estimate.act("distance_after")
            found[lay.X_AFTER : lay.X_DISTANCE] = moved[lay.X_AFTER : lay.X_DISTANCE]
            found[lay.X_DISTANCE_AFTER] = distance
        return self.outcome(estimate, found, target, heading)

    def outcome(
        self, estimate: JointEstimate, found: list[float], target: float, heading: float
    ) -> Outcome:
        """Return what came of a constraint, of what the kernel has ``found``."""
        r, error = found[lay.X_BEFORE : lay.X_NOW], found[lay.X_Y]
        distance_after, reason = None, None
        exceeds = found[lay.X_EXCEEDS] != 0.0
        if exceeds:
            distance_after = found[lay.X_DISTANCE_AFTER]
        else:
            reason = Reason.DISTANCE_WITHIN_C0 if error <= 0.0 else Reason.NO_UNCERTAINTY
        limit = DistanceLimit(found[lay.X_DISTANCE], target, distance_after)
        passing = Passing(limit, heading, r, found[lay.X_AFTER : lay.X_DISTANCE])
        S = np.array([[found[lay.X_S]]])
        return Outcome(np.array([error]), S, nis_of(found), exceeds, passing, reason)

    @property
    def is_exact(self) -> bool:
        """Whether the least correction is wanted, which the kernel makes; else `correct` does."""
        return False

    def correct(self, estimate: JointEstimate, r: Vector, p: Matrix, target: float) -> None:
        """Bring ``estimate`` to ``target`` m; ``r`` (3,) is the separation, ``p`` its (3, 3)."""
        raise AssertionError(f"{type(self).__name__} says what a constraint does")


def nis_of(found: Sequence[float]) -> float:
    """Return the NIS of the distance, no number where the kernel has found none."""
    nis = found[lay.X_NIS]
    return nis if nis >= 0.0 else math.nan


def covariance_of(found: Sequence[float]) -> Matrix:
    """Return the covariance (3, 3) m^2 of the separation that the kernel has found."""
    return [list(found[at : at + 3]) for at in range(lay.M_P, lay.M_AXES, 3)]
