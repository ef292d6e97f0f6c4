"""The magnetic field: what a foot's sensor has measured of it lately, and its parts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..refusals import Refusal
from ..samples.series import FloatArray
from .log import Log

RANGE_T = (1e-6, 1e-3)  # beyond these it is not near the earth's (25 to 65 uT), or not in T


class FieldLog(Log[FloatArray]):
    """What one sensor has measured: the field (3,) T in the axes of the foot over time."""

    def add(self, stamp_ns: int, tesla: Sequence[float] | FloatArray) -> Refusal | None:
        """Take a sample; return why it is refused, if it is."""
        field = np.array(tesla, dtype=np.float64)
        if not RANGE_T[0] < math.hypot(*field.tolist()) < RANGE_T[1]:
            return Refusal.FIELD_OUT_OF_RANGE  # as is what is not finite
        return None if self.put(stamp_ns, field) else Refusal.FIELD_OUT_OF_ORDER


class NavigationField(NamedTuple):
    """A field (x, y, z) T in navigation axes, of which z points up."""

    x: float
    y: float
    z: float

    @property
    def norm(self) -> float:
        """Size, T."""
        return math.sqrt(self.x * self.x + self.y * self.y + self.z * self.z)

    @property
    def level(self) -> float:
        """Size of the level part, T."""
        return math.sqrt(self.x * self.x + self.y * self.y)

    @property
    def dip(self) -> float:
        """Angle below the horizon, rad."""
        return math.atan2(-self.z, self.level)

    @property
    def angle(self) -> float:
        """Direction of the level part, rad from x to y."""
        return math.atan2(self.y, self.x)

    def turned(self, angle: float) -> NavigationField:
        """Return the field turned about the vertical by ``angle`` rad."""
        c, s = math.cos(angle), math.sin(angle)
        return NavigationField(c * self.x - s * self.y, s * self.x + c * self.y, self.z)


def mean_field(fields: Sequence[NavigationField]) -> NavigationField:
    """Return the mean of ``fields``, component by component."""
    return NavigationField(*np.mean([(f.x, f.y, f.z) for f in fields], axis=0).tolist())
