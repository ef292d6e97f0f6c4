"""Check of units: samples that are not in SI units are recognised and reported once."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...inspection import Finding, FindingKind, Severity
from ..ros.status import Status

WINDOW = 100  # samples
GRAVITY_IN_G = (0.7, 1.4)  # mean norm of specific force in g, of a foot that stands or walks
LEAST_GRAVITY = 4.0  # m/s^2; no foot on Earth has a smaller mean norm
FASTEST = 35.0  # rad/s, 2000 deg/s: full scale of the sensors people put on their feet
FAST_SHARE = 0.05


class UnitCheck:
    """Check of one sensor's samples, window by window; ``findings`` has one a quantity at most.

    A finding stays: the first one of a quantity is the one to act on.
    """

    def __init__(self, warn: Callable[[str], object], foot: str = "") -> None:
        """Call ``warn`` with the sentence of each finding, which names ``foot`` where given."""
        self._warn, self._foot = warn, foot
        self._name = f"the {foot} foot" if foot else "this sensor"
        self._found: dict[FindingKind, Finding] = {}
        self._norm = 0.0
        self._fast = 0
        self._count = 0

    @property
    def findings(self) -> list[Finding]:
        """The findings so far."""
        return list(self._found.values())

    def add(self, values: list[float]) -> None:
        """Take specific force and angular rate (6,) of one sample; not finite is ignored."""
        norm = math.hypot(*values[:3])
        rate = math.hypot(*values[3:])
        if not math.isfinite(norm + rate):
            return
        self._norm += norm
        self._fast += rate > FASTEST
        self._count += 1
        if self._count == WINDOW:
            self._check_window(self._norm / WINDOW, self._fast / WINDOW)
            self._norm, self._fast, self._count = 0.0, 0, 0

    def describe(self, status: Status) -> None:
        """Add the findings to a status."""
        for finding in self.findings:
            status.note(finding)

    def _check_window(self, norm: float, fast_share: float) -> None:
        if GRAVITY_IN_G[0] < norm < GRAVITY_IN_G[1]:
            self._report(
                FindingKind.FORCE_UNIT,
                f"specific force of {self._name} has a mean norm of {norm:.2f}; it looks like g "
                "where m/s^2 is expected: set units.specific_force of imu_adapter to g",
            )
        elif norm < LEAST_GRAVITY:
            self._report(
                FindingKind.FORCE_UNIT,
                f"specific force of {self._name} has a mean norm of {norm:.2f} m/s^2 where "
                "about 9.8 is expected: gravity seems to be removed",
                "the raw specific force is needed",
            )
        if fast_share > FAST_SHARE:
            self._report(
                FindingKind.RATE_UNIT,
                f"angular rate of {self._name} exceeds {FASTEST:g} rad/s; it looks like deg/s "
                "where rad/s is expected: set units.angular_rate of imu_adapter to deg/s",
            )

    def _report(self, kind: FindingKind, text: str, remedy: str = "") -> None:
        if kind in self._found:
            return
        self._found[kind] = Finding(kind, Severity.WARNING, text, remedy, self._foot)
        self._warn(self._found[kind].sentence)
