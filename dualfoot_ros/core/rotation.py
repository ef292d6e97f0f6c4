"""Rotations off the hot path: turns about the vertical, quaternions, matrices and yaw angles.

Quaternions are Hamilton, (x, y, z, w), body to navigation; the navigation frame has z up.  The
kernel has its own, in place, in ``kernel/strapdown.py`` and ``kernel/turn.py``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .samples.series import FloatArray


def about_z(angle: float) -> FloatArray:
    """Return the rotation (3, 3) about the vertical by ``angle`` rad."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def rotate_vectors(vectors: FloatArray, rotation: FloatArray) -> FloatArray:
    """Return vectors (N, 3) or (3,) rotated by ``rotation`` (3, 3)."""
    rotated: FloatArray = vectors @ rotation.T
    return rotated


def rotate_covariances(matrices: FloatArray, rotation: FloatArray) -> FloatArray:
    """Return covariances (..., 3, 3) rotated by ``rotation`` (3, 3)."""
    rotated: FloatArray = rotation @ matrices @ rotation.T
    return rotated


def turn_quaternions(quaternions: FloatArray, yaw: float) -> FloatArray:
    """Return attitudes (N, 4) turned about the vertical by ``yaw`` rad, all with w >= 0."""
    c, s = math.cos(0.5 * yaw), math.sin(0.5 * yaw)
    x, y, z, w = quaternions.T.copy()
    turned = np.stack([c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z], axis=1)
    return np.where(turned[:, 3:] < 0.0, -turned, turned)


def yaw_quaternion(yaw: float) -> FloatArray:
    """Return the quaternion (4,) of a rotation about the vertical by ``yaw`` rad."""
    return np.array([0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw)])


def quaternion_yaw(quaternion: FloatArray) -> float:
    """Return the heading of the body x axis of a quaternion (4,), rad."""
    x, y, z, w = (float(v) for v in quaternion)
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def quaternion_matrix(quaternion: FloatArray) -> FloatArray:
    """Return R_nb (3, 3) of a unit quaternion (4,)."""
    x, y, z, w = quaternion.tolist()
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion_matrices(quaternions: FloatArray) -> FloatArray:
    """Return R_nb (N, 3, 3) of quaternions (N, 4) of any length.

    The sums are those of ``scipy.spatial.transform.Rotation``, in its order, without loading it.
    """
    x, y, z, w = quaternions.T
    x, y, z, w = np.array([x, y, z, w]) / np.sqrt(x * x + y * y + z * z + w * w)
    xx, yy, zz, ww = x * x, y * y, z * z, w * w
    rows = (
        (xx - yy - zz + ww, 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), -xx + yy - zz + ww, 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), -xx - yy + zz + ww),
    )
    return np.stack([np.stack(row, axis=1) for row in rows], axis=1)


def rotate_each(vectors: FloatArray, rotations: FloatArray) -> FloatArray:
    """Return vectors (N, 3), each rotated by its own of ``rotations`` (N, 3, 3)."""
    rotated: FloatArray = np.einsum("ijk,ik->ij", rotations, vectors)
    return rotated


def skew(vector: FloatArray) -> FloatArray:
    """Return the matrix (3, 3) of the cross product with ``vector`` (3,) from the left."""
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exact_rotation(turn: FloatArray) -> FloatArray:
    """Return the rotation (3, 3) by the rotation vector ``turn`` (3,) rad, however long it is."""
    angle = math.hypot(*turn.tolist())
    if angle == 0.0:
        return np.eye(3)
    cross, half = skew(turn / angle), math.sin(0.5 * angle)
    rotation: FloatArray = np.eye(3) + math.sin(angle) * cross + 2.0 * half * half * cross @ cross
    return rotation


def turn_between(before: FloatArray, after: FloatArray) -> float:
    """Return the turn about the vertical between two R_nb (3, 3), rad, however the sensor sits."""
    return turn_of_rows(before[:2].ravel().tolist(), after[:2].ravel().tolist())


def turn_of_rows(before: Sequence[float], after: Sequence[float]) -> float:
    """Return the same of the first two rows (6,) of both matrices."""
    a, b, c, d, e, f = before
    u, v, w, x, y, z = after
    across = (x * a + y * b + z * c) - (u * d + v * e + w * f)
    return math.atan2(across, (u * a + v * b + w * c) + (x * d + y * e + z * f))


def mean_angle(a: float, b: float) -> float:
    """Return the circular mean of two angles, rad (eq. (7) of Ma and Särkkä 2023)."""
    return math.atan2(math.sin(a) + math.sin(b), math.cos(a) + math.cos(b))
