"""Rotations and velocities of many steps, one after the other, for many walks at once.

Quaternions are (x, y, z, w), Hamilton; their parts and those of vectors stand first, so that each
operation runs over everything else.
"""

from __future__ import annotations

import numpy as np

from ..core import FloatArray


def quaternions_of(turns: FloatArray) -> FloatArray:
    """Return the quaternions (4, ...) of rotation vectors (3, ...) rad."""
    half = 0.5 * np.sqrt((turns * turns).sum(axis=0))
    return np.concatenate([0.5 * np.sinc(half / np.pi) * turns, np.cos(half)[np.newaxis]])


def products(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the quaternions (4, ...) of first ``b``, then ``a``."""
    (ax, ay, az, aw), (bx, by, bz, bw) = a, b
    made = np.empty(np.broadcast_shapes(a.shape, b.shape))
    np.subtract(aw * bx + ax * bw + ay * bz, az * by, out=made[0])
    np.add(aw * by - ax * bz + ay * bw, az * bx, out=made[1])
    np.add(aw * bz + ax * by - ay * bx, az * bw, out=made[2])
    np.subtract(aw * bw - ax * bx - ay * by, az * bz, out=made[3])
    return made


def turned(quaternions: FloatArray, vectors: FloatArray) -> FloatArray:
    """Return vectors (3, ...) rotated by quaternions (4, ...)."""
    axis, w = quaternions[:3], quaternions[3]
    twice = 2.0 * _cross(axis, vectors)
    found: FloatArray = vectors + w * twice + _cross(axis, twice)
    return found


def one_after_another(rotation: FloatArray, velocity: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return quaternion (4, ...) and velocity (3, ...) after steps (., L, ...) in a row.

    ``velocity`` is what each step adds, in the axes before it.  Neighbours are made one step, all
    of them at once: so L steps take log L rounds.
    """
    while (count := rotation.shape[1]) > 1:
        last = rotation[:, count & ~1 :], velocity[:, count & ~1 :]  # one, or none
        first, second = rotation[:, 0 : count - 1 : 2], rotation[:, 1::2]
        pushed = velocity[:, 0 : count - 1 : 2] + turned(first, velocity[:, 1::2])
        rotation = np.concatenate([products(first, second), last[0]], axis=1)
        velocity = np.concatenate([pushed, last[1]], axis=1)
    return rotation[:, 0], velocity[:, 0]


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    (ax, ay, az), (bx, by, bz) = a, b
    made = np.empty(np.broadcast_shapes(a.shape, b.shape))
    np.subtract(ay * bz, az * by, out=made[0])
    np.subtract(az * bx, ax * bz, out=made[1])
    np.subtract(ax * by, ay * bx, out=made[2])
    return made
