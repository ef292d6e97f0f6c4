"""Where the person faces while a foot swings: how the sensors have turned since a reference."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..rotation import quaternion_matrix, turn_between
from ..samples.series import FloatArray

UNKNOWN_VARIANCE = math.pi**2 / 3.0  # rad^2, of an angle of which nothing is known


class Facing(NamedTuple):
    """References of both feet, from which their headings follow at any attitude of the sensors.

    Attributes
    ----------
    rotations : R_nb (3, 3) of each sensor at its reference
    headings : rad, of each foot at its reference
    levers : (3,) m of each sensor to the pivot of its foot, body axes
    stances : rad, heading of each foot as last seen in stance
    known : whether the first strides have fixed both headings
    """

    rotations: tuple[FloatArray, FloatArray]
    headings: tuple[float, float]
    levers: tuple[FloatArray, FloatArray]
    stances: tuple[float, float]
    known: bool

    def heading(self, foot: int, quaternion: FloatArray) -> float:
        """Return the heading (rad) of foot 0 or 1 with attitude ``quaternion`` (4,)."""
        rotation = quaternion_matrix(quaternion)
        return self.headings[foot] + turn_between(self.rotations[foot], rotation)

    def pivot_height(self, foot: int, position: FloatArray, quaternion: FloatArray) -> float:
        """Return the height (m) of the pivot of foot 0 or 1: of the floor, while it stands."""
        rotation = quaternion_matrix(quaternion)
        return float(position[2] + rotation[2] @ self.levers[foot])


NO_FACING = Facing(
    (np.eye(3), np.eye(3)), (0.0, 0.0), (np.zeros(3), np.zeros(3)), (0.0, 0.0), False
)
