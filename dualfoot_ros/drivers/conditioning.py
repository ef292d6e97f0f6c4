"""From the sensor's axes and units to forward-left-up and SI."""

from __future__ import annotations

from dataclasses import dataclass

from ..core import FORCE_UNITS, IDENTITY, RATE_UNITS, Matrix, Mounting, Vector, dot, parameter
from .sample import Sample


@dataclass(frozen=True)
class Conditioning(Mounting):
    """How the sensor sits on the foot, and the units of what it sends."""

    force_unit: str = parameter(
        "m/s^2", "unit of the specific force as it comes", choices=("m/s^2", "g")
    )
    rate_unit: str = parameter(
        "rad/s", "unit of the angular rate as it comes", choices=("rad/s", "deg/s")
    )


class Conditioner:
    """Turn and scale samples."""

    def __init__(self, options: Conditioning | None = None) -> None:
        """Work out the rotation.

        Raises
        ------
        ConfigError
            When ``axes`` are not three different, right-handed ones.
        """
        options = options or Conditioning()
        self.rotation = options.rotation()
        self._force = FORCE_UNITS[options.force_unit]
        self._rate = RATE_UNITS[options.rate_unit]
        self._idle = self.rotation == IDENTITY and self._force == self._rate == 1.0

    def apply(self, sample: Sample) -> Sample:
        """Return the sample in axes forward-left-up and SI units."""
        if self._idle:
            return sample
        field = sample.magnetic_field
        return sample._replace(
            specific_force=_turned(self.rotation, sample.specific_force, self._force),
            angular_rate=_turned(self.rotation, sample.angular_rate, self._rate),
            magnetic_field=None if field is None else _turned(self.rotation, field, 1.0),
        )


def _turned(matrix: Matrix, vector: Vector, factor: float) -> Vector:
    """Return ``factor`` times ``matrix`` times ``vector``."""
    x, y, z = matrix
    return (factor * dot(x, vector), factor * dot(y, vector), factor * dot(z, vector))
