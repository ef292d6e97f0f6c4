"""Rotations from yaw, pitch and roll, and the angular rates of a body that turns by them."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np

from ...core import FloatArray

Columns = tuple[FloatArray, FloatArray, FloatArray]  # of a vector (N, 3): x, y, z


class EulerAngles(NamedTuple):
    """Sines and cosines (N,) of yaw, pitch and roll: rotations Rz(yaw) Ry(pitch) Rx(roll)."""

    sy: FloatArray
    cy: FloatArray
    sp: FloatArray
    cp: FloatArray
    sr: FloatArray
    cr: FloatArray

    @classmethod
    def of(cls, yaw: FloatArray, pitch: FloatArray, roll: FloatArray) -> Self:
        """Return those of angles (N,) in rad."""
        return cls(
            np.sin(yaw), np.cos(yaw), np.sin(pitch), np.cos(pitch), np.sin(roll), np.cos(roll)
        )

    def rows(self) -> tuple[Columns, Columns, Columns]:
        """Return the rows of the rotation matrices."""
        sy, cy, sp, cp, sr, cr = self
        return (
            (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
            (-sp, cp * sr, cp * cr),
        )

    def rates(self, first: FloatArray) -> Columns:
        """Return the body angular rate, from the derivatives (3, N) of the angles."""
        _, _, sp, cp, sr, cr = self
        dy, dp, dr = first
        return dr - dy * sp, dp * cr + dy * cp * sr, -dp * sr + dy * cp * cr

    def accelerations(self, first: FloatArray, second: FloatArray) -> Columns:
        """Return the body angular acceleration, from both derivatives (3, N) of the angles."""
        _, _, sp, cp, sr, cr = self
        dy, dp, dr = first
        ddy, ddp, ddr = second
        return (
            ddr - ddy * sp - dy * dp * cp,
            ddp * cr - dp * dr * sr + ddy * cp * sr - dy * dp * sp * sr + dy * dr * cp * cr,
            -ddp * sr - dp * dr * cr + ddy * cp * cr - dy * dp * sp * cr - dy * dr * cp * sr,
        )


def rotation_zyx(yaw: FloatArray, pitch: FloatArray, roll: FloatArray) -> FloatArray:
    """Return the (N, 3, 3) rotations Rz(yaw) Ry(pitch) Rx(roll)."""
    out = np.empty((len(yaw), 3, 3))
    for i, row in enumerate(EulerAngles.of(yaw, pitch, roll).rows()):
        for j, column in enumerate(row):
            out[:, i, j] = column
    return out


def cross_columns(a: Columns, b: Columns) -> Columns:
    """Return the cross products of vectors that are given by their columns."""
    (ax, ay, az), (bx, by, bz) = a, b
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
