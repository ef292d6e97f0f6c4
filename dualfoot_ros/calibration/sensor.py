"""The calibration of one sensor: bias and matrix of each triad, and their application."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..core import FloatArray, ImuSeries

TRIADS = ("accelerometer", "gyro")


@dataclass(frozen=True)
class Triad:
    """Three axes of one kind: ``corrected = matrix (measured - bias)``.

    Attributes
    ----------
    bias : (3,) m/s^2 or rad/s, in the axes of the samples
    matrix : (3, 3) dimensionless; scale factors and misalignment
    about : details of the fit by name; not used when it is applied
    """

    bias: FloatArray
    matrix: FloatArray
    about: Mapping[str, Any] = field(default_factory=dict)

    def apply(self, measured: FloatArray) -> FloatArray:
        """Return corrected samples for measured ones, (3,) or (N, 3)."""
        return (measured - self.bias) @ self.matrix.T


@dataclass(frozen=True)
class SensorCalibration:
    """The calibration of one sensor; a triad that is None is left as it is."""

    accelerometer: Triad | None = None
    gyro: Triad | None = None

    def apply(self, series: ImuSeries) -> ImuSeries:
        """Return corrected samples; stamps and magnetic field stay."""
        force, rate = series.specific_force, series.angular_rate
        return replace(
            series,
            specific_force=force
            if self.accelerometer is None
            else self.accelerometer.apply(force),
            angular_rate=rate if self.gyro is None else self.gyro.apply(rate),
        )

    def values(self, values: FloatArray) -> FloatArray:
        """Return one corrected sample (6,): specific force in m/s^2, angular rate in rad/s."""
        force, rate = values[:3], values[3:6]
        return np.concatenate(
            [
                force if self.accelerometer is None else self.accelerometer.apply(force),
                rate if self.gyro is None else self.gyro.apply(rate),
            ]
        )

    def triads(self) -> dict[str, Triad]:
        """Return the triads that are calibrated, by name."""
        both = {name: getattr(self, name) for name in TRIADS}
        return {name: triad for name, triad in both.items() if triad is not None}

    def summary(self) -> str:
        """Return the names of the corrected triads in one line."""
        return " and ".join(self.triads()) or "nothing"
