"""``spacing_vector``: the vector between the feet when they are side by side (SVC).

Ma and Särkkä 2023, III-C, eqs (5)-(9): at mid-stance, the swinging foot passing by, the right foot
is 2a to the right of the left one, across the mean heading of the feet, eq. (7); the joint state
is projected onto that (their "estimate projection").  The paper's frame has x to the right and y
forward; here x is forward at heading psi = 0, so the vector from left to right is 2a (sin psi,
-cos psi), and the right foot does come out on the right.  The heading of a foot is the yaw of its
sensor less what that was on the first strides, so a sensor need not point forward.

``variant: lateral`` keeps only the component across the heading: where along the way the swinging
foot is at that moment is not known to centimetres, and the moment is not known exactly either.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from ..joint_estimate import LEFT_ALONE, JointEstimate, Outcome
from ..kernel import layout as lay
from ..parameters import Parameters, parameter
from ..results.payloads import DistanceLimit, Passing
from ..samples.series import FloatArray
from .at_passing import AtPassing, rule_of
from .learnt_spacing import Spacing
from .method import Gait, Request, StancePhase
from .varying_distance import feet_adjacent


@dataclass(frozen=True)
class SpacingVectorConfig(Parameters):
    """Parameters of the spacing vector constraint."""

    spacing: float = parameter(
        0.0,
        "lateral distance 2a of the two sensors (0: learnt from the walk)",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    spacing_std: float = parameter(
        0.08,
        "scatter of the spacing vector (0: hard projection)",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    variant: str = parameter(
        "vector",
        "both horizontal components or the lateral one only",
        choices=("vector", "lateral"),
    )
    moment: str = parameter(
        "share",
        "at a share of the stance or at the swinging foot's gyro peak",
        choices=("share", "feet_adjacent"),
    )
    share: float = parameter(
        0.5, "moment as a share of the stance (0.5: mid-stance)", minimum=0.0, maximum=1.0
    )
    max_stance: float = parameter(
        1.2, "a longer stance is no step", unit="s", minimum=0.2, maximum=3.0
    )
    height_std: float = parameter(
        0.15,
        "difference in height of the feet in passing (0: height is not constrained)",
        unit="m",
        minimum=0.0,
        maximum=5.0,
    )
    heading_correction: str = parameter(
        "difference",
        "what the constraint corrects of heading and gyro bias: all (full), as in the paper, the "
        "difference of the headings, or nothing (none)",
        choices=("full", "difference", "none"),
    )


class SpacingVector(AtPassing):
    """Asks for the spacing vector at the middle of every stance of a walk."""

    name = "spacing_vector"
    config_class = SpacingVectorConfig
    config: SpacingVectorConfig

    def __init__(self, config: SpacingVectorConfig) -> None:
        """Use ``config``."""
        self.spacing = Spacing(config.spacing)
        self.memory_s = config.max_stance
        self._use(config)

    def retune(self, config: Parameters) -> None:
        """Go on with ``config``; a spacing that has changed is used, or learnt, from here on."""
        assert isinstance(config, SpacingVectorConfig)
        if config.spacing != self.config.spacing:
            self.spacing = Spacing(config.spacing)
        self._use(config)

    def _use(self, config: SpacingVectorConfig) -> None:
        self.config, self.dimensions = config, rows_of(config)
        own = type(self) is SpacingVector  # another one may say something else at a stance
        self.rule = self._rule() if own and config.moment == "share" else None

    def _rule(self) -> FloatArray:
        config = self.config
        return rule_of(
            {
                lay.R_KIND: lay.R_SPACING,
                lay.R_SHARE: config.share,
                lay.R_LONGEST_S: config.max_stance,
                lay.R_STD: config.spacing_std,
                lay.R_HEIGHT_STD: config.height_std,
                lay.R_LATERAL: config.variant == "lateral",
                lay.R_LEFT_ALONE: LEFT_ALONE[config.heading_correction],
                lay.R_ROWS: self.dimensions,
                lay.R_LEARNS: self.spacing.learner is not None,
            }
        )

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the constraint of a stance that was a step."""
        other = 1 - stance.foot
        if stance.duration_s > self.config.max_stance:
            return ()
        if self.config.moment == "share":
            moment = stance.moment(self.config.share)
        else:
            swing = [
                e for e in range(stance.first, stance.last + 1) if not gait.in_stance(other, e)
            ]
            if len(swing) < 4:
                return ()
            moment = feet_adjacent(gait, other, range(swing[0], swing[-1] + 1))
        if not gait.remembers(moment) or gait.in_stance(other, moment):
            return ()
        constrain = partial(self.apply, target=self.spacing.value_m, heading=stance.heading)
        return (Request(moment, True, constrain),)

    def apply(
        self, estimate: JointEstimate, heading: float, target: float | None = None
    ) -> Outcome:
        """Project onto eq. (9), or onto its component across ``heading`` (rad), and in height.

        ``target`` is the spacing (m), that of now unless it is given.
        """
        config = self.config
        target = self.spacing.value_m if target is None else target
        _, found = estimate.act(
            "constrain_spacing",
            math.cos(heading),
            math.sin(heading),
            target,
            config.spacing_std,
            config.height_std,
            config.variant == "lateral",
            LEFT_ALONE[config.heading_correction],
        )
        return self.outcome(estimate, found, target, heading)

    def outcome(
        self, estimate: JointEstimate, found: list[float], target: float, heading: float
    ) -> Outcome:
        """Return what came of a constraint, of what the kernel has ``found``."""
        passing = Passing(
            DistanceLimit(found[lay.X_DISTANCE], target),
            heading,
            found[lay.X_BEFORE : lay.X_BEFORE + 3],
            found[lay.X_AFTER : lay.X_AFTER + 3],
            found[lay.X_LATERAL],
        )
        return Outcome(*estimate.measured(self.dimensions), found[lay.X_NIS], True, passing)


def rows_of(config: SpacingVectorConfig) -> int:
    """Return how many rows the constraint has."""
    return (2 if config.variant == "vector" else 1) + (config.height_std > 0.0)
