"""Conversion from the sensor's axes and units to forward-left-up and SI."""

from __future__ import annotations

from dataclasses import dataclass

from ..core import (
    FORCE_UNITS,
    IDENTITY,
    RATE_UNITS,
    Matrix,
    MountingConfig,
    Vector,
    dot,
    parameter,
)
from .sample import Sample


@dataclass(frozen=True)
class ConditioningConfig(MountingConfig):
    """Mounting of the sensor on the foot, and the units it sends."""

    force_unit: str = parameter(
        "m/s^2", "unit of the specific force as it comes", choices=("m/s^2", "g")
    )
    rate_unit: str = parameter(
        "rad/s", "unit of the angular rate as it comes", choices=("rad/s", "deg/s")
    )


class Conditioner:
    """Rotation and scale of the samples of one sensor."""

    def __init__(self, config: ConditioningConfig | None = None) -> None:
        """Compute the rotation.

        Raises
        ------
        ConfigError
            When ``axes`` are not three different axes, right-handed.
        """
        config = config or ConditioningConfig()
        self.rotation = config.rotation()
        self._force = FORCE_UNITS[config.force_unit]
        self._rate = RATE_UNITS[config.rate_unit]
        self._idle = self.rotation == IDENTITY and self._force == self._rate == 1.0

    def apply(self, sample: Sample) -> Sample:
        """Return the sample in axes forward-left-up and SI units."""
        if self._idle:
            return sample
        field = sample.magnetic_field
        return sample._replace(
            specific_force=_turn(self.rotation, sample.specific_force, self._force),
            angular_rate=_turn(self.rotation, sample.angular_rate, self._rate),
            magnetic_field=None if field is None else _turn(self.rotation, field, 1.0),
        )


def _turn(matrix: Matrix, vector: Vector, factor: float) -> Vector:
    """Return ``factor`` times ``matrix`` times ``vector``."""
    x, y, z = matrix
    return (factor * dot(x, vector), factor * dot(y, vector), factor * dot(z, vector))
