"""``varying_distance``: a bound on the distance that follows the gait (VDC).

Ma and Särkkä 2023, III-B: over the moving period of a foot the bound gamma_k is a flipped
Gaussian, symmetric about feet adjacent (FA), from ``maximum`` at the ends to ``minimum`` at FA;
beyond it the moving foot is pulled back as in eq. (4).  FA is the peak of the moving foot's
horizontal angular rate (II-A).  Both are known when the foot has landed, so the period is then run
again from its start.  The paper gives sigma = 5 without a unit; here it is samples at its 60 Hz.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..parameters import Parameters, parameter
from .max_distance_projection import pull
from .method import Gait, Method, Request, StancePhase


@dataclass(frozen=True)
class VaryingDistanceConfig(Parameters):
    """Parameters of the varying distance constraint."""

    maximum: float = parameter(
        0.9, "bound at the ends of the moving period", unit="m", minimum=0.1, maximum=3.0
    )
    minimum: float = parameter(
        0.2, "bound when the feet are adjacent", unit="m", minimum=0.01, maximum=1.0
    )
    sigma: float = parameter(
        0.0833, "width of the flipped Gaussian", unit="s", minimum=0.005, maximum=1.0
    )
    max_swing: float = parameter(
        1.5, "a longer moving period is no step", unit="s", minimum=0.2, maximum=3.0
    )


class VaryingDistance(Method):
    """Bounds the distance over each moving period, once the foot has landed."""

    name = "varying_distance"
    config_class = VaryingDistanceConfig
    config: VaryingDistanceConfig

    def __init__(self, config: VaryingDistanceConfig) -> None:
        """Use ``config``."""
        self.config = config
        self.memory_s = config.max_swing

    def on_stance_start(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return one pull for every epoch of the moving period that has just ended."""
        start = gait.last_stance_end(stance.foot) + 1
        epochs = range(start, stance.first)
        too_long = len(epochs) * stance.period_s > self.config.max_swing
        if start <= 0 or not epochs or too_long or not gait.remembers(start):
            return ()
        adjacent = feet_adjacent(gait, stance.foot, epochs)
        return [
            Request(
                e, True, partial(pull, moving=stance.foot, bound=self.bound(e - adjacent, stance))
            )
            for e in epochs
            if gait.in_stance(1 - stance.foot, e)
        ]

    def bound(self, offset: int, stance: StancePhase) -> float:
        """Return gamma_k in m, ``offset`` epochs from feet adjacent."""
        config = self.config
        x = offset * stance.period_s / config.sigma
        return config.maximum - (config.maximum - config.minimum) * math.exp(-0.5 * x * x)


def feet_adjacent(gait: Gait, foot: int, epochs: range) -> int:
    """Return the epoch at which the moving foot passes the standing one.

    The swing turns the foot about its lateral axis twice, backwards while it is thrown forward
    and the other way at both ends; the forward throw's peak is where the feet are adjacent.  The
    lateral axis is that of the largest angular rate over the moving period.
    """
    rates = np.array([gait.sample(foot, e)[3:] for e in epochs])
    axis = np.linalg.eigh(rates.T @ rates)[1][:, -1]
    turn = rates @ axis
    middle = slice(len(turn) // 4, max(len(turn) // 4 + 1, 3 * len(turn) // 4))
    sign = 1.0 if turn[middle].sum() >= 0.0 else -1.0
    return epochs[middle.start + int(np.argmax(sign * turn[middle]))]
