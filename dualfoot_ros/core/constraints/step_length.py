"""``step_length``: a bound from body height, as a virtual position of the swinging foot.

Chen, Liu, Guo 2024, eqs (20), (22)-(26): B = 2.789 h - 3.897 (metres); while one foot stands and
the other swings farther away than B, the swinging foot is observed at P_stand + B / D (P_swing -
P_stand) with variance sigma_p^2 on each axis.  The paper lets B be set by hand (1.2 m for its
subject of 1.83 m, for whom eq. (20) gives 1.207 m).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..joint_estimate import JointEstimate, Outcome, nothing_done
from ..kernel.layout import position_row
from ..parameters import Parameters, parameter
from ..results.payloads import DistanceLimit, Reason
from .method import Gait, Method, Request


@dataclass(frozen=True)
class StepLengthConfig(Parameters):
    """Parameters of the step-length constraint."""

    body_height: float = parameter(
        1.75, "height of the person, eq. (20)", unit="m", minimum=1.45, maximum=2.2
    )
    bound: float = parameter(
        0.0,
        "bound B, in place of eq. (20) (0: from body_height)",
        unit="m",
        minimum=0.0,
        maximum=3.0,
    )
    position_std: float = parameter(
        0.1, "noise of the virtual position", unit="m", minimum=1e-3, maximum=5.0
    )

    @property
    def threshold_m(self) -> float:
        """The bound B."""
        return self.bound if self.bound > 0.0 else step_length(self.body_height)


def step_length(body_height: float) -> float:
    """Return the largest step in m of a person of ``body_height`` m, eq. (20)."""
    return 2.789 * body_height - 3.897


class StepLength(Method):
    """Observes the swinging foot on the sphere about the standing one."""

    name = "step_length"
    config_class = StepLengthConfig
    config: StepLengthConfig
    dimensions = 3

    def __init__(self, config: StepLengthConfig) -> None:
        """Use ``config``."""
        self.config = config
        self.watch_m = config.threshold_m

    def on_epoch(self, gait: Gait) -> Sequence[Request]:
        """Return the observation when just one foot is swinging."""
        still = [gait.in_stance(foot, gait.now) for foot in range(2)]
        if still[0] == still[1]:
            return ()
        swinging = 1 if still[0] else 0
        return (Request(gait.now, False, partial(self.apply, swinging=swinging)),)

    def apply(self, estimate: JointEstimate, swinging: int) -> Outcome:
        """Update with eqs (23)-(26)."""
        bound = self.config.threshold_m
        away = estimate.position(swinging) - estimate.position(1 - swinging)
        distance = float(np.sqrt((away**2).sum()))
        if distance <= bound:
            limit = DistanceLimit(distance, bound)
            return nothing_done(limit, Reason.DISTANCE_WITHIN_BOUND, self.dimensions)
        innovation = away * (1.0 - bound / distance)  # predicted minus virtual position
        rows = [{position_row(swinging, i): 1.0} for i in range(3)]
        variances = [self.config.position_std**2] * 3
        s, nis = estimate.update(rows, innovation.tolist(), variances)
        left = estimate.position(0) - estimate.position(1)
        limit = DistanceLimit(distance, bound, float(np.sqrt((left**2).sum())))
        return Outcome(innovation, s, nis, True, limit)
