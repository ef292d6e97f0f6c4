"""Gyro biases learnt anew at every standstill of a walk.

The windows of a standing foot are weighed by their stillness, as at the start; at the end of the
stand their mean is one measurement of the bias, with the uncertainty that their scatter gives it.
Positions and headings are not corrected: a stand tells nothing of the way that lies behind.
"""

from __future__ import annotations

import math

import numpy as np

from ..alignment import FootStand, Window
from ..config import TrackerConfig
from ..joint_estimate import HeadingCorrection, JointEstimate, Outcome
from ..kernel import Workspace
from ..kernel import layout as lay
from ..kernel.layout import gyro_bias_row
from ..results.payloads import StandBias

LEAST_STD = 5.0e-5  # rad/s


class Stands:
    """Collects the windows of both feet while they stand."""

    def __init__(self, config: TrackerConfig, space: Workspace) -> None:
        """Start with no window."""
        self._config, self._space = config, space
        self._stands = [FootStand(config.alignment) for _ in range(2)]
        self._newest: list[Window | None] = [None, None]

    def take(self, foot: int, stamp_ns: int) -> None:
        """Take the window of ``foot`` that the kernel has filled.

        The newest is kept back until another follows: in the last second before a step the weight
        shifts.
        """
        window = self._read(foot, stamp_ns)
        before, self._newest[foot] = self._newest[foot], window
        if before is not None and self._is_still(before):
            self._stands[foot].add(before)

    def _is_still(self, window: Window) -> bool:
        """Return whether a window can be of a standing foot, and not of a sensor that is stuck."""
        limits = self._config.alignment
        mean = math.hypot(*window.mean[3:])
        return 0.0 < window.rate_std <= limits.max_rate_std and mean <= limits.max_rate

    def _read(self, foot: int, stamp_ns: int) -> Window:
        w, a = self._space.w, lay.A_FOOT + foot * lay.A_STRIDE
        count = w[a + lay.A_COUNT]
        mean = w[a + lay.A_SUM : a + lay.A_SUM + 3] / count
        variance = w[a + lay.A_SQUARES : a + lay.A_SQUARES + 3] / count - mean * mean
        std = np.sqrt(np.maximum(variance, 0.0))
        w[a + lay.A_SECONDS] = 0.0
        nothing = [0.0, 0.0, 0.0]
        parts = [*nothing, *mean.tolist()], [*nothing, *std.tolist()]
        return Window(*parts, stamp_ns, lay.STOOD_S)

    def stood(self, foot: int) -> bool:
        """Return whether there is something to learn from the stand of ``foot``."""
        return self._stands[foot].count > 0

    def learn(self, foot: int, estimate: JointEstimate) -> Outcome:
        """Update the gyro bias of ``foot`` from its stand, and forget the stand."""
        still = self._stands[foot].result()
        self._stands[foot].clear()
        self._newest[foot] = None
        std = math.hypot(still.rate_std, LEAST_STD)
        innovation = estimate.gyro_bias(foot) - still.angular_rate
        rows = [{gyro_bias_row(foot, axis): -1.0} for axis in range(3)]
        s, nis = estimate.update(rows, innovation.tolist(), [std**2] * 3, HeadingCorrection.BIAS)
        estimate.keep_gyro_bias_std(foot, self._config.initial.gyro_bias)
        learnt = StandBias(still.angular_rate.tolist(), std, still.seconds)
        return Outcome(innovation, s, nis, True, learnt)

    def forget(self, foot: int) -> None:
        """Forget the windows of a stand from which nothing was learnt."""
        if self.stood(foot):
            self._stands[foot].clear()
        self._newest[foot] = None
