"""Magnetometers on the feet: the field of earth and surroundings, and the sensors' errors.

The earth's field is the same all along a walk.  ``disturbance`` adds that of iron in floors and
walls: a sum of plane waves of random direction, so it changes smoothly over ``disturbance_length``
and is the same whenever a foot comes by.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import FloatArray, Parameters, PoseSeries, parameter

MICRO = 1e-6
WAVES = 24


@dataclass(frozen=True)
class MagnetometerConfig(Parameters):
    """The field, and sizes of the sensors' errors; the defaults are those of a park in Europe."""

    field: float = parameter(48.0, "size of the earth's field", unit="uT", minimum=1.0, maximum=99)
    dip: float = parameter(
        1.2, "of the field below the horizon", unit="rad", minimum=-1.5, maximum=1.5
    )
    north: float = parameter(
        0.6, "direction of magnetic north against x", unit="rad", minimum=-3.2, maximum=3.2
    )
    noise: float = parameter(0.3, "white noise of a sample", unit="uT", minimum=0.0, maximum=100.0)
    hard_iron: float = parameter(
        0.5, "spread of what magnets on the sensor add to each axis", unit="uT", minimum=0.0,
        maximum=500.0,
    )  # fmt: skip
    disturbance: float = parameter(
        0.0, "spread of what iron in the surroundings adds", unit="uT", minimum=0.0, maximum=500.0
    )
    disturbance_length: float = parameter(
        1.5, "over which that changes", unit="m", minimum=0.1, maximum=1000.0
    )


class Surroundings:
    """The magnetic field at any place."""

    def __init__(self, config: MagnetometerConfig, rng: np.random.Generator) -> None:
        """Draw the iron around."""
        level, down = np.cos(config.dip), np.sin(config.dip)
        north = np.array([level * np.cos(config.north), level * np.sin(config.north), -down])
        self._earth = config.field * north
        self._size = config.disturbance / np.sqrt(0.5 * WAVES)
        self._waves = rng.standard_normal((WAVES, 3)) / config.disturbance_length
        self._phases = rng.uniform(0.0, 2.0 * np.pi, WAVES)
        self._directions = rng.standard_normal((WAVES, 3))

    def field(self, position: FloatArray) -> FloatArray:
        """Return the field (N, 3) uT at places (N, 3) m, navigation axes."""
        waves = np.cos(position @ self._waves.T + self._phases)
        field: FloatArray = self._earth + self._size * waves @ self._directions
        return field


def sense_field(
    config: MagnetometerConfig,
    surroundings: Surroundings,
    truth: PoseSeries,
    rng: np.random.Generator,
) -> FloatArray:
    """Return the field (N, 3) T, sensor axes, that a magnetometer measures at poses ``truth``."""
    from scipy.spatial.transform import Rotation

    turned = Rotation.from_quat(truth.quaternion)
    field = turned.apply(surroundings.field(truth.position), inverse=True)
    field += config.hard_iron * rng.standard_normal(3)
    tesla: FloatArray = MICRO * (field + config.noise * rng.standard_normal(field.shape))
    return tesla
