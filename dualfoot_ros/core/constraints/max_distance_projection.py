"""``max_distance_projection``: the moving foot is pulled onto the sphere about the standing foot.

Prateek et al. 2013, as MaxDC in Ma and Särkkä 2023, eqs (3), (4): p = p_MS + gamma / d (p_move -
p_MS) when d > gamma.  Closed form, positions only: neither velocity nor covariance is touched,
which is what the papers do and why the estimate does not learn from it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..parameters import Parameters, parameter
from ..results.payloads import DistanceLimit
from .method import Gait, Method, Request


@dataclass(frozen=True)
class MaxDistanceProjectionConfig(Parameters):
    """Parameters of the maximum-distance projection."""

    bound: float = parameter(
        0.9, "largest distance gamma of the two sensors", unit="m", minimum=0.1, maximum=3.0
    )


class MaxDistanceProjection(Method):
    """Pulls the moving foot back at every epoch beyond the bound."""

    name = "max_distance_projection"
    config_class = MaxDistanceProjectionConfig
    config: MaxDistanceProjectionConfig

    def __init__(self, config: MaxDistanceProjectionConfig) -> None:
        """Use ``config``."""
        self.config = config
        self.watch_m = config.bound

    def on_epoch(self, gait: Gait) -> Sequence[Request]:
        """Return the pull when just one foot is moving."""
        still = [gait.in_stance(foot, gait.now) for foot in range(2)]
        if still[0] == still[1]:
            return ()
        moving = 1 if still[0] else 0
        bound = self.config.bound
        return (Request(gait.now, False, partial(pull, moving=moving, bound=bound)),)


def pull(estimate: JointEstimate, moving: int, bound: float) -> Outcome:
    """Move foot ``moving`` onto the sphere of radius ``bound`` m about the other one, eq. (4)."""
    standing = estimate.position(1 - moving)
    away = estimate.position(moving) - standing
    distance = float(np.sqrt((away**2).sum()))
    accepted = distance > bound
    if accepted:
        estimate.place(moving, standing + bound / distance * away)
    limit = DistanceLimit(distance, bound, min(distance, bound))
    innovation = np.array([distance - bound])
    return Outcome(innovation, np.full((1, 1), np.nan), float("nan"), accepted, limit)
