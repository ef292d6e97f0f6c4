"""From the sensor's axes and units to forward-left-up and SI."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ..core.parameters import Parameters, parameter
from .errors import SourceError
from .sample import STANDARD_GRAVITY, Sample, Vector

Matrix = tuple[Vector, Vector, Vector]

FORCE_UNITS = {"m/s^2": 1.0, "g": STANDARD_GRAVITY}
RATE_UNITS = {"rad/s": 1.0, "deg/s": math.pi / 180.0}
AXES = re.compile(r"\s*([+-]?)([xyz])\s*,?\s*([+-]?)([xyz])\s*,?\s*([+-]?)([xyz])\s*")
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Conditioning(Parameters):
    """How the sensor sits on the foot, and the units of what it sends."""

    axes: str = parameter(
        "x,y,z", "axes of the sensor that point forward, left and up, as in y,-x,z"
    )
    roll: float = parameter(0.0, "about x, first", unit="rad", minimum=-6.3, maximum=6.3)
    pitch: float = parameter(0.0, "about y, second", unit="rad", minimum=-6.3, maximum=6.3)
    yaw: float = parameter(0.0, "about z, last", unit="rad", minimum=-6.3, maximum=6.3)
    force_unit: str = parameter(
        "m/s^2", "unit of the specific force as it comes", choices=tuple(FORCE_UNITS)
    )
    rate_unit: str = parameter(
        "rad/s", "unit of the angular rate as it comes", choices=tuple(RATE_UNITS)
    )


class Conditioner:
    """Turn and scale samples: first the axes are named anew, then turned by fixed-axis angles.

    A vector v of the sensor becomes Rz(yaw) Ry(pitch) Rx(roll) M v, M the matrix of ``axes``.
    """

    def __init__(self, options: Conditioning | None = None) -> None:
        """Work out the rotation.

        Raises
        ------
        SourceError
            When ``axes`` are not three different, right-handed ones.
        """
        options = options or Conditioning()
        turn = rotation(options.roll, options.pitch, options.yaw)
        self.rotation = product(turn, axes_matrix(options.axes))
        self._force = FORCE_UNITS[options.force_unit]
        self._rate = RATE_UNITS[options.rate_unit]
        self._idle = self.rotation == IDENTITY and self._force == self._rate == 1.0

    def apply(self, sample: Sample) -> Sample:
        """Return the sample in axes forward-left-up and SI units."""
        if self._idle:
            return sample
        field = sample.magnetic_field
        return sample._replace(
            specific_force=turned(self.rotation, sample.specific_force, self._force),
            angular_rate=turned(self.rotation, sample.angular_rate, self._rate),
            magnetic_field=None if field is None else turned(self.rotation, field, 1.0),
        )


def axes_matrix(axes: str) -> Matrix:
    """Return the rotation to (forward, left, up) given as signed axes of the sensor.

    Raises
    ------
    SourceError
        When they are not three different axes, or mirror the sensor.
    """
    match = AXES.fullmatch(axes)
    if match is None:
        raise _refusal(axes, "these are not three signed axes")
    groups = match.groups()
    signs = [-1.0 if sign == "-" else 1.0 for sign in groups[0::2]]
    rows = [
        tuple(sign * (name == axis) for axis in "xyz")
        for sign, name in zip(signs, groups[1::2], strict=True)
    ]
    matrix: Matrix = (rows[0], rows[1], rows[2])  # type: ignore[assignment]
    handed = determinant(matrix)
    if handed == 0.0:
        raise _refusal(axes, "an axis occurs twice")
    if handed < 0.0:
        raise _refusal(axes, "they mirror the sensor, so one sign is wrong")
    return matrix


def rotation(roll: float, pitch: float, yaw: float) -> Matrix:
    """Return Rz(yaw) Ry(pitch) Rx(roll) for angles in rad."""
    cr, sr = math.cos(roll), math.sin(roll)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def product(left: Matrix, right: Matrix) -> Matrix:
    """Return the matrix product."""
    columns = tuple(zip(*right, strict=True))
    rows = (tuple(_dot(row, column) for column in columns) for row in left)
    return tuple(rows)  # type: ignore[return-value]


def turned(matrix: Matrix, vector: Vector, factor: float) -> Vector:
    """Return ``factor`` times ``matrix`` times ``vector``."""
    x, y, z = matrix
    return (factor * _dot(x, vector), factor * _dot(y, vector), factor * _dot(z, vector))


def determinant(matrix: Matrix) -> float:
    """Return the determinant: +1 for a rotation, -1 for a mirror."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def _dot(a: Vector, b: tuple[float, ...]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _refusal(axes: str, why: str) -> SourceError:
    return SourceError(
        f"axes are '{axes}': {why}; allowed are the signed axes of the sensor that point "
        "forward, left and up, right-handed, as in 'x,y,z', 'y,-x,z' or 'x,-y,-z'"
    )
