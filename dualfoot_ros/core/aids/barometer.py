"""``barometer``: the height of a standing foot from air pressure.

Chen, Liu, Guo 2024, section 2.3: the height is observed while the foot stands, relative to the
first stance.  Pressure becomes height by the troposphere of the ICAO Standard Atmosphere (Doc
7488): h = T0 / L ((p0 / p)^(R L / g) - 1) with T0 = 288.15 K, L = -6.5 K/km, p0 = 101 325 Pa; only
differences of it are used, over which the true temperature matters by its ratio to T0.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import numpy as np

from ..config_aids import Aids
from ..constraints.method import Gait, Method, Request, StancePhase
from ..estimate import JointEstimate, Outcome
from ..trajectory import EventKind

SEA_LEVEL_PA = 101325.0
SCALE_M = 288.15 / 0.0065
EXPONENT = 0.190263
KEEP_NS = 30_000_000_000


def pressure_height(pascal: float) -> float:
    """Return the height in m above the 101 325 Pa level of the ICAO Standard Atmosphere."""
    return SCALE_M * (1.0 - float(pascal / SEA_LEVEL_PA) ** EXPONENT)


class Barometer(Method):
    """Collects pressure and observes each stance's mean height against the first stance's."""

    def __init__(self, config: Aids) -> None:
        """Use ``config.barometer_std`` and ``config.barometer_samples``."""
        self._config = config
        self._stamps: tuple[list[int], list[int]] = ([], [])
        self._heights: tuple[list[float], list[float]] = ([], [])
        self._zero: list[float | None] = [None, None]

    def add(self, foot: int, stamp_ns: int, pascal: float) -> bool:
        """Take a pressure sample of ``foot``; return False when its stamp is not a later one."""
        stamps, heights = self._stamps[foot], self._heights[foot]
        if stamps and stamp_ns <= stamps[-1]:
            return False
        stamps.append(stamp_ns)
        heights.append(pressure_height(pascal))
        return True

    def forget(self, foot: int, before_ns: int) -> None:
        """Drop what is older than ``before_ns``."""
        first = bisect_left(self._stamps[foot], before_ns)
        del self._stamps[foot][:first], self._heights[foot][:first]

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the stance's mean height, if enough samples fell into it."""
        foot, last_ns = stance.foot, gait.stamp(stance.last)
        first_ns = gait.stamp(stance.first, last_ns - KEEP_NS)
        stamps = self._stamps[foot]
        span = slice(bisect_left(stamps, first_ns), bisect_right(stamps, last_ns))
        inside = self._heights[foot][span]
        self.forget(foot, last_ns)
        if len(inside) < self._config.barometer_samples or not gait.remembers(stance.last):
            return ()
        height = sum(inside) / len(inside)
        return (Request(stance.last, True, lambda e: self._apply(e, foot, height), EventKind.AID),)

    def _apply(self, estimate: JointEstimate, foot: int, height: float) -> Outcome:
        z = float(estimate.position(foot)[2])
        detail = {"aid": "barometer", "height": height}
        zero = self._zero[foot]
        if zero is None:
            self._zero[foot] = height - z
            nothing = np.zeros(1), np.zeros((1, 1)), 0.0, False
            return Outcome(*nothing, {**detail, "reason": "reference of the first stance"})
        innovation = z - (height - zero)
        s, nis = estimate.update(
            [{15 * foot + 2: 1.0}], [innovation], [self._config.barometer_std**2]
        )
        return Outcome(np.array([innovation]), s, nis, True, detail)

    def moved(self, up_m: float) -> None:
        """Move the reference heights with the track."""
        self._zero = [None if zero is None else zero - up_m for zero in self._zero]
