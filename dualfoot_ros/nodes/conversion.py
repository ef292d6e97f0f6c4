"""From the axes and units of a sensor to SI and forward-left-up."""

from __future__ import annotations

import math

import numpy as np
from sensor_msgs.msg import Imu

from ..calibration import SensorCalibration
from ..core.series import FloatArray
from ..options import Covariance, Mounting, Units

STANDARD_GRAVITY = 9.80665  # m/s^2 in a g
SCALES = {"m/s^2": 1.0, "g": STANDARD_GRAVITY, "rad/s": 1.0, "deg/s": math.pi / 180.0}


class Conversion:
    """Scales, corrects and rotates samples, and their covariances."""

    def __init__(
        self,
        mounting: Mounting,
        units: Units,
        covariance: Covariance,
        calibration: SensorCalibration | None = None,
    ) -> None:
        """Correct by ``calibration``, which is in SI units and in the axes of the sensor."""
        self._rotation = mounting_rotation(mounting)
        self._force = SCALES[units.specific_force]
        self._rate = SCALES[units.angular_rate]
        self._force_std, self._rate_std = (
            covariance.specific_force_std,
            covariance.angular_rate_std,
        )
        plain = np.array_equal(self._rotation, np.eye(3))
        self._calibration = calibration
        self._same_axes = plain and self._force == 1.0 and self._rate == 1.0
        self._unchanged = self._same_axes and calibration is None

    def values(self, values: FloatArray) -> FloatArray:
        """Return specific force and angular rate (6,) in m/s^2 and rad/s, forward-left-up."""
        if self._unchanged:
            return values
        sensed = np.concatenate([self._force * values[:3], self._rate * values[3:]])
        if self._calibration is not None:
            sensed = self._calibration.values(sensed)
        return np.concatenate([self._rotation @ sensed[:3], self._rotation @ sensed[3:]])

    def describe(self, message: Imu) -> None:
        """Bring covariances and orientation of ``message`` to the new axes and units.

        An orientation is dropped (REP 145: -1) when the axes are turned; nobody here uses it.
        """
        message.linear_acceleration_covariance = self._covariance(
            message.linear_acceleration_covariance, self._force, self._force_std
        )
        message.angular_velocity_covariance = self._covariance(
            message.angular_velocity_covariance, self._rate, self._rate_std
        )
        if not self._same_axes:
            message.orientation_covariance[0] = -1.0

    def _covariance(self, received: FloatArray, scale: float, std: float) -> FloatArray:
        if std > 0.0:
            return (std * std * np.eye(3)).ravel()
        if self._same_axes or received[0] < 0.0:
            return received
        turned = self._rotation @ received.reshape(3, 3) @ self._rotation.T
        return (scale * scale * turned).ravel()


def mounting_rotation(mounting: Mounting) -> FloatArray:
    """Return the rotation (3, 3) from the sensor's axes to forward-left-up, Rz Ry Rx."""
    cr, sr = math.cos(mounting.roll), math.sin(mounting.roll)
    cp, sp = math.cos(mounting.pitch), math.sin(mounting.pitch)
    cy, sy = math.cos(mounting.yaw), math.sin(mounting.yaw)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    about_y = np.array([[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]])
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return about_z @ about_y @ about_x
