"""``min_distance``: the moment from the recursive positions, then the distance as observation.

Niu et al. 2019, as described by Liu et al. 2023 (section IV-A, "MinDist"): the moment is the
minimum of the buffered distances of the estimated positions within a gait cycle, at least
``interval`` after the last one; the distance is a pseudo-observation as in ``mdmd_ekf``.  Because
the positions drift, so does the moment: that is what MDMD was made to mend.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parameters import parameter
from .mdmd import MdmdEkf
from .method import Gait, StancePhase
from .minimum_moment import MomentConfig


@dataclass(frozen=True)
class MinDistanceConfig(MomentConfig):
    """Parameters of the classical minimum-distance constraint; kappa is not used."""

    interval: float = parameter(
        0.3, "least time between two constraints", unit="s", minimum=0.0, maximum=5.0
    )


class MinDistance(MdmdEkf):
    """Looks for the minimum in the positions since the last constraint."""

    name = "min_distance"
    config_class = MinDistanceConfig
    config: MinDistanceConfig

    def __init__(self, config: MinDistanceConfig) -> None:
        """Use ``config``."""
        super().__init__(config)
        self.memory_s = config.max_stance
        self._last = -1

    def moment(self, stance: StancePhase, gait: Gait) -> int | None:
        """Return the epoch within the stance at which the estimated distance is least."""
        if stance.duration_s > self.config.max_stance:
            return None
        epochs = [e for e in range(stance.first, stance.last + 1) if gait.remembers(e)]
        if not epochs:
            return None
        separations = np.array([np.subtract(*gait.positions_after(e)) for e in epochs])
        least = epochs[int(np.argmin((separations**2).sum(axis=1)))]
        if least in (epochs[0], epochs[-1]) or gait.in_stance(1 - stance.foot, least):
            return None
        if self._last >= 0 and (least - self._last) * stance.period_s < self.config.interval:
            return None
        self._last = least
        return least
