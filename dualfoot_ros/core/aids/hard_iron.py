"""The hard iron of one foot, learnt while walking: what its magnets add to the earth's field.

Iron on the foot turns with it, the earth's field does not, so both part as soon as the walk has
turned.  With R the attitude as the gyros alone would have it, m the measured field, B that of the
earth, k the iron in body axes and a heading that drifts by d t,

    R m = B + R k + d t (B_y, -B_x, 0) + noise,

which is linear in (B, k, d) with the field of the reference in the last term.  Least squares over
the stances, with a prior for k and d, is all it takes.
"""

from __future__ import annotations

import numpy as np

from ..samples.series import FloatArray
from .field import NavigationField

MICRO = 1e-6
IRON_STD_UT = 1.0  # prior
DRIFT_STD = 1.0e-3  # rad/s
EARTH_STD_UT = 100.0
NOISE_UT = 4.0  # of a stance: attitude, and a field that varies along the way
KNOWN_UT = 0.4  # standard deviation of the level part, below which iron counts as known
FIELD, IRON, DRIFT = slice(0, 3), slice(3, 6), 6


class HardIron:
    """Least squares of field, iron and drift over the stances of one foot."""

    def __init__(self) -> None:
        """Start from the prior."""
        stds = [EARTH_STD_UT] * 3 + [IRON_STD_UT] * 3 + [DRIFT_STD]
        self._information = np.diag(np.square(1.0 / np.array(stds)))
        self._vector = np.zeros(7)
        self._begin_ns: int | None = None
        self.tesla = np.zeros(3)
        self.field: NavigationField | None = None

    def add(
        self, stamp_ns: int, rotation: FloatArray, measured: FloatArray, earth: NavigationField
    ) -> None:
        """Take a stance: R_nb (3, 3) of the gyros alone, field (3,) T; ``earth`` is nearly B."""
        self._begin_ns = stamp_ns if self._begin_ns is None else self._begin_ns
        seconds = (stamp_ns - self._begin_ns) * 1e-9
        rows = np.zeros((3, 7))
        rows[:, FIELD], rows[:, IRON] = np.eye(3), rotation
        rows[:2, DRIFT] = seconds * earth.y / MICRO, -seconds * earth.x / MICRO
        self._information += rows.T @ rows / NOISE_UT**2
        self._vector += rows.T @ (rotation @ measured) / MICRO / NOISE_UT**2
        covariance = np.linalg.inv(self._information)
        found = covariance @ self._vector
        level = rotation @ covariance[IRON, IRON] @ rotation.T
        if float(np.sqrt(max(level[0, 0], level[1, 1]))) < KNOWN_UT:
            self.tesla = found[IRON] * MICRO
            self.field = NavigationField(*(found[FIELD] * MICRO).tolist())

    @property
    def known(self) -> bool:
        """Whether the walk has turned enough to tell iron from earth."""
        return self.field is not None
