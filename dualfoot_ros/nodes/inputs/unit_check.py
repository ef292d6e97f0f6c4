"""Recognises samples that are not in SI units, and says so once."""

from __future__ import annotations

import math
from collections.abc import Callable

WINDOW = 100  # samples
GRAVITY_IN_G = (0.7, 1.4)  # mean norm of specific force in g, of a foot that stands or walks
LEAST_GRAVITY = 4.0  # m/s^2; a mean norm below this is no foot on Earth
FASTEST = 35.0  # rad/s, 2000 deg/s: full scale of the sensors people put on their feet
SUSPECT_SHARE = 0.05


class UnitSuspicion:
    """Looks at windows of samples of one sensor; ``said`` holds what was found."""

    def __init__(self, name: str, warn: Callable[[str], object]) -> None:
        self.said: list[str] = []
        self._name, self._warn = name, warn
        self._norm = 0.0
        self._fast = 0
        self._count = 0

    def look(self, values: list[float]) -> None:
        """Take specific force and angular rate (6,) of one sample; not finite is ignored."""
        norm = math.hypot(*values[:3])
        rate = math.hypot(*values[3:])
        if not math.isfinite(norm + rate):
            return
        self._norm += norm
        self._fast += rate > FASTEST
        self._count += 1
        if self._count == WINDOW:
            self._judge(self._norm / WINDOW, self._fast / WINDOW)
            self._norm, self._fast, self._count = 0.0, 0, 0

    def _judge(self, norm: float, fast_share: float) -> None:
        if GRAVITY_IN_G[0] < norm < GRAVITY_IN_G[1]:
            self._say(
                f"specific force of {self._name} has a mean norm of {norm:.2f}; it looks like g "
                "where m/s^2 is expected: set units.specific_force of imu_adapter to g"
            )
        elif norm < LEAST_GRAVITY:
            self._say(
                f"specific force of {self._name} has a mean norm of {norm:.2f} m/s^2 where "
                "about 9.8 is due: gravity seems to be removed; the raw specific force is needed"
            )
        if fast_share > SUSPECT_SHARE:
            self._say(
                f"angular rate of {self._name} goes beyond {FASTEST:g} rad/s; it looks like deg/s "
                "where rad/s is expected: set units.angular_rate of imu_adapter to deg/s"
            )

    def _say(self, sentence: str) -> None:
        topic = sentence.split(" of ")[0]
        if not any(said.startswith(topic) for said in self.said):
            self.said.append(sentence)
            self._warn(sentence)
