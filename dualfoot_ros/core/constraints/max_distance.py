"""``max_distance``: the classical upper bound on the distance of the feet.

Skog et al. 2012, as in Liu et al. 2023 ("MaxDist"): when the estimated distance exceeds the bound
and enough time has passed since the last constraint, the joint state is projected onto it (the
exact constrained least squares of ``idc``, with the bound in place of c0).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..kernel import layout as lay
from ..parameters import Parameters, parameter
from ..results.payloads import DistanceLimit
from .method import Gait, Method, Request
from .minimum_moment import nis_of


@dataclass(frozen=True)
class MaxDistanceConfig(Parameters):
    """Parameters of the maximum-distance constraint."""

    bound: float = parameter(
        0.9, "largest distance of the two sensors", unit="m", minimum=0.1, maximum=3.0
    )
    bound_std: float = parameter(
        0.05, "uncertainty of the bound (0: hard)", unit="m", minimum=0.0, maximum=1.0
    )
    interval: float = parameter(
        0.5, "least time between two constraints", unit="s", minimum=0.0, maximum=10.0
    )


class MaxDistance(Method):
    """Projects onto the bound when it is exceeded."""

    name = "max_distance"
    config_class = MaxDistanceConfig
    config: MaxDistanceConfig

    def __init__(self, config: MaxDistanceConfig) -> None:
        """Use ``config``."""
        self.config = config
        self.watch_m = config.bound
        self._last: int | None = None

    def on_epoch(self, gait: Gait) -> Sequence[Request]:
        """Return a projection unless the last one is too recent."""
        since = None if self._last is None else (gait.now - self._last) * gait.period_s
        if since is not None and since < self.config.interval:
            return ()
        self._last = gait.now
        return (Request(gait.now, False, self.apply),)

    def apply(self, estimate: JointEstimate) -> Outcome:
        """Project the joint state onto |r| = bound."""
        bound, std = self.config.bound, self.config.bound_std
        now = (False, 0.0, 0.0, 0.0)  # the separation is that of now
        exceeds, found = estimate.act("constrain_distance", bound, std, True, *now)
        after = found[lay.X_DISTANCE_AFTER] if exceeds else None
        limit = DistanceLimit(found[lay.X_DISTANCE], bound, after)
        innovation, s = np.array([found[lay.X_Y]]), np.array([[found[lay.X_S]]])
        return Outcome(innovation, s, nis_of(found), exceeds != 0.0, limit)
