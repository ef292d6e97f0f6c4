"""The motion of one shoe as a quintic B-spline: exact position, velocity, rotation and rates.

The rough motion (footprints, templates, ringing, wobble) is sampled at the control points of a
uniform quintic B-spline.  The spline through them *is* the truth: four times continuously
differentiable, exactly at rest where the rough motion rests, every derivative a closed form.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...core import FloatArray
from .euler_angles import Columns, EulerAngles, cross_columns, rotation_zyx

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

BLOCK = 4096  # moments at a time, whose columns stay in the processor's cache


@dataclass(frozen=True)
class Poses:
    """Where a sensor at one place on the shoe is; the sensor's frame is the body frame.

    Attributes
    ----------
    position : (N, 3) m
    velocity : (N, 3) m/s
    rotation : (N, 3, 3) body to navigation
    """

    position: FloatArray
    velocity: FloatArray
    rotation: FloatArray


@dataclass(frozen=True)
class ShoeMotion:
    """Ball of the foot (x, y, z, m) and yaw, pitch, roll (rad) of the shoe as one spline."""

    spline: BSpline
    gravity: float

    def ball(self, time_s: FloatArray) -> FloatArray:
        """Return the (N, 3) position of the ball of the foot."""
        ball: FloatArray = self.spline(time_s)[:, :3]
        return ball

    def arm(self, time_s: FloatArray, lever: FloatArray) -> FloatArray:
        """Return the (N, 3) m from the ball to the point at ``lever`` (3,) m in the shoe."""
        arm: FloatArray = rotation_zyx(*self.spline(time_s)[:, 3:].T) @ lever
        return arm

    def position(self, time_s: FloatArray, lever: FloatArray) -> FloatArray:
        """Return the (N, 3) position of the point at ``lever`` (3,) m in the shoe."""
        state = self.spline(time_s)
        position: FloatArray = state[:, :3] + rotation_zyx(*state[:, 3:].T) @ lever
        return position

    def poses(self, time_s: FloatArray, lever: FloatArray, mounting: FloatArray) -> Poses:
        """Return where a sensor at ``lever`` (3,), turned by ``mounting`` (3, 3), is."""
        state, first = self.spline(time_s), self.spline(time_s, 1)
        shoe = rotation_zyx(*state[:, 3:].T)
        rate = np.column_stack(EulerAngles.of(*state[:, 3:].T).rates(first[:, 3:].T))
        return Poses(
            position=state[:, :3] + shoe @ lever,
            velocity=first[:, :3] + np.einsum("nij,nj->ni", shoe, np.cross(rate, lever)),
            rotation=shoe @ mounting,
        )

    def sensed(
        self, time_s: FloatArray, lever: FloatArray, mounting: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return specific force (N, 3) m/s^2 and angular rate (N, 3) rad/s of a sensor there."""
        force, rate = np.empty((len(time_s), 3)), np.empty((len(time_s), 3))
        for first in range(0, len(time_s), BLOCK):
            block = slice(first, first + BLOCK)
            columns = self._in_the_shoe(time_s[block], lever)
            for axis in range(3):
                force[block, axis], rate[block, axis] = columns[0][axis], columns[1][axis]
        return force @ mounting, rate @ mounting

    def _in_the_shoe(self, time_s: FloatArray, lever: FloatArray) -> tuple[Columns, Columns]:
        """Return specific force and angular rate of the point at ``lever``, axes of the shoe."""
        state, first, second = (np.array(self.spline(time_s, k).T, order="C") for k in range(3))
        angles = EulerAngles.of(*state[3:])
        rate, point = angles.rates(first[3:]), (lever[0], lever[1], lever[2])
        turned = cross_columns(angles.accelerations(first[3:], second[3:]), point)
        swung = cross_columns(rate, cross_columns(rate, point))
        x, y, z = second[0], second[1], second[2] + self.gravity
        pushed = (a * x + b * y + c * z for a, b, c in zip(*angles.rows(), strict=True))
        force = [p + (t + s) for p, t, s in zip(pushed, turned, swung, strict=True)]
        return (force[0], force[1], force[2]), rate
