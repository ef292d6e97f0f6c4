"""Conversion from the axes and units of a sensor to SI and forward-left-up."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from sensor_msgs.msg import Imu

from ...calibration import SensorCalibration
from ...core import FORCE_UNITS, RATE_UNITS, FloatArray, MountingConfig
from ...settings import CovarianceConfig, UnitConfig


class Conversion:
    """Scale, calibration and rotation of samples, and of their covariances."""

    def __init__(
        self,
        mounting: MountingConfig,
        units: UnitConfig,
        covariance: CovarianceConfig,
        calibration: SensorCalibration | None = None,
    ) -> None:
        """Apply ``calibration``, which is in SI units and in the axes of the sensor.

        Raises
        ------
        ConfigError
            When ``mounting.axes`` are not three different axes, right-handed.
        """
        self._rotation = np.array(mounting.rotation())
        self._force = FORCE_UNITS[units.specific_force]
        self._rate = RATE_UNITS[units.angular_rate]
        self._force_std, self._rate_std = (
            covariance.specific_force_std,
            covariance.angular_rate_std,
        )
        self._plain = np.array_equal(self._rotation, np.eye(3))
        self._calibration = calibration
        self._same_axes = self._plain and self._force == 1.0 and self._rate == 1.0

    def values(self, values: FloatArray) -> FloatArray:
        """Return specific force and angular rate (6,) in m/s^2 and rad/s, forward-left-up."""
        return self.turn(self.scale(values))

    def scale(self, values: FloatArray) -> FloatArray:
        """Return a sample (6,) in m/s^2 and rad/s, in the axes of the sensor, not calibrated."""
        if self._force == 1.0 and self._rate == 1.0:
            return values
        return np.concatenate([self._force * values[:3], self._rate * values[3:]])

    def turn(self, sensed: FloatArray) -> FloatArray:
        """Return a sample (6,) in SI units calibrated, and turned to forward-left-up."""
        if self._calibration is not None:
            sensed = self._calibration.values(sensed)
        if self._plain:
            return sensed
        return np.concatenate([self._rotation @ sensed[:3], self._rotation @ sensed[3:]])

    def field(self, tesla: Sequence[float]) -> FloatArray:
        """Return a magnetic field (3,) turned to forward-left-up."""
        field: FloatArray = self._rotation @ np.array(tesla)
        return field

    def convert_covariances(self, message: Imu) -> None:
        """Convert covariances and orientation of ``message`` to the new axes and units.

        An orientation is dropped (REP 145: -1) when the axes are turned; it is not used here.
        """
        message.linear_acceleration_covariance = self._convert_covariance(
            message.linear_acceleration_covariance, self._force, self._force_std
        )
        message.angular_velocity_covariance = self._convert_covariance(
            message.angular_velocity_covariance, self._rate, self._rate_std
        )
        if not self._same_axes:
            message.orientation_covariance[0] = -1.0

    def _convert_covariance(self, received: FloatArray, scale: float, std: float) -> FloatArray:
        if std > 0.0:
            return (std * std * np.eye(3)).ravel()
        if self._same_axes or received[0] < 0.0:
            return received
        turned = self._rotation @ received.reshape(3, 3) @ self._rotation.T
        converted: FloatArray = (scale * scale * turned).ravel()
        return converted
