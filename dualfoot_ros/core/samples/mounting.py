"""How a sensor sits on the foot: the rotation from its axes to forward-left-up."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ..errors import ConfigError
from ..parameters import Parameters, parameter

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]

AXES = re.compile(r"\s*([+-]?)([xyz])\s*,?\s*([+-]?)([xyz])\s*,?\s*([+-]?)([xyz])\s*")
FORWARD_LEFT_UP = "+x+y+z"  # the axes of the body
RIGHT_FRONT_UP = "+y-x+z"
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class MountingConfig(Parameters):
    """From the sensor's axes to forward-left-up: axes named anew, then turned about fixed axes.

    A vector v of the sensor becomes Rz(yaw) Ry(pitch) Rx(roll) M v, M the matrix of ``axes``.
    """

    axes: str = parameter(
        "x,y,z", "axes of the sensor that point forward, left and up, as in y,-x,z"
    )
    roll: float = parameter(0.0, "about x, first", unit="rad", minimum=-6.3, maximum=6.3)
    pitch: float = parameter(0.0, "about y, second", unit="rad", minimum=-6.3, maximum=6.3)
    yaw: float = parameter(0.0, "about z, last", unit="rad", minimum=-6.3, maximum=6.3)

    def rotation(self) -> Matrix:
        """Return the rotation (3, 3) from the sensor's axes to forward-left-up.

        Raises
        ------
        ConfigError
            When ``axes`` are not three different, right-handed ones.
        """
        return product(turn(self.roll, self.pitch, self.yaw), axes_matrix(self.axes))


def axes_matrix(axes: str) -> Matrix:
    """Return the rotation to (forward, left, up) given as signed axes of the sensor.

    ``x,y,z`` or ``+x+y+z`` is a sensor that is forward-left-up already, ``y,-x,z`` or ``+y-x+z``
    one that is right-front-up.

    Raises
    ------
    ConfigError
        When they are not three different axes, or mirror the sensor.
    """
    match = AXES.fullmatch(axes)
    if match is None:
        raise _refusal(axes, "these are not three signed axes")
    groups = match.groups()
    signs = [-1.0 if sign == "-" else 1.0 for sign in groups[0::2]]
    rows = [
        tuple(sign if name == axis else 0.0 for axis in "xyz")
        for sign, name in zip(signs, groups[1::2], strict=True)
    ]
    matrix: Matrix = (rows[0], rows[1], rows[2])  # type: ignore[assignment]
    handed = determinant(matrix)
    if handed == 0.0:
        raise _refusal(axes, "an axis occurs twice")
    if handed < 0.0:
        raise _refusal(axes, "they mirror the sensor, so one sign is wrong")
    return matrix


def turn(roll: float, pitch: float, yaw: float) -> Matrix:
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
    rows = (tuple(dot(row, column) for column in columns) for row in left)
    return tuple(rows)  # type: ignore[return-value]


def determinant(matrix: Matrix) -> float:
    """Return the determinant: +1 for a rotation, -1 for a mirror."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def dot(a: Vector, b: tuple[float, ...]) -> float:
    """Return the scalar product of two vectors (3,)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _refusal(axes: str, why: str) -> ConfigError:
    return ConfigError(
        f"axes are '{axes}': {why}; allowed are the signed axes of the sensor that point "
        "forward, left and up, right-handed, as in 'x,y,z', 'y,-x,z' or '+y-x+z'"
    )
