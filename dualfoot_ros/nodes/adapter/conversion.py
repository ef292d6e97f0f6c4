"""From the axes and units of a sensor to SI and forward-left-up."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from sensor_msgs.msg import Imu

from ...calibration import SensorCalibration
from ...core import FORCE_UNITS, RATE_UNITS, FloatArray, Mounting
from ...settings import Covariance, Units


class Conversion:
    """Scales, corrects and rotates samples, and their covariances."""

    def __init__(
        self,
        mounting: Mounting,
        units: Units,
        covariance: Covariance,
        calibration: SensorCalibration | None = None,
    ) -> None:
        """Correct by ``calibration``, which is in SI units and in the axes of the sensor.

        Raises
        ------
        ConfigError
            When ``mounting.axes`` are not three different, right-handed ones.
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
        return self.turned(self.sensed(values))

    def sensed(self, values: FloatArray) -> FloatArray:
        """Return a sample (6,) in m/s^2 and rad/s, in the axes of the sensor, not corrected."""
        if self._force == 1.0 and self._rate == 1.0:
            return values
        return np.concatenate([self._force * values[:3], self._rate * values[3:]])

    def turned(self, sensed: FloatArray) -> FloatArray:
        """Return a sample (6,) in SI units corrected, and turned to forward-left-up."""
        if self._calibration is not None:
            sensed = self._calibration.values(sensed)
        if self._plain:
            return sensed
        return np.concatenate([self._rotation @ sensed[:3], self._rotation @ sensed[3:]])

    def field(self, tesla: Sequence[float]) -> FloatArray:
        """Return a magnetic field (3,) turned to forward-left-up."""
        return self._rotation @ np.array(tesla)

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
