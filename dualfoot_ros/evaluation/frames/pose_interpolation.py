"""Poses between their stamps, and the turns between attitudes.

``scipy.interpolate`` and ``scipy.spatial`` give the same to rounding, but to load them takes as
long as to evaluate a walk of some minutes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core import FloatArray, IntArray


class Between(NamedTuple):
    """Where wanted times lie among known ones.

    Attributes
    ----------
    before : (N,) index of the known time before each
    share : (N,) of the interval that has passed
    interval_s : (N,) length of the interval
    """

    before: IntArray
    share: FloatArray
    interval_s: FloatArray

    @classmethod
    def of(cls, wanted: FloatArray, known: FloatArray) -> Between:
        """Look up (N,) wanted times in (K,) increasing known ones, between which they lie."""
        before = np.searchsorted(known, wanted, side="right") - 1
        before = np.clip(before, 0, len(known) - 2)
        interval_s = known[before + 1] - known[before]
        return cls(before, (wanted - known[before]) / interval_s, interval_s)

    def hermite(self, values: FloatArray, slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (N, 3) values and slopes on the cubic that has the known ones at both ends."""
        s, h = self.share[:, None], self.interval_s[:, None]
        begin, end = slopes[self.before], slopes[self.before + 1]
        rise = values[self.before + 1] - values[self.before]
        blend, rest = s * (1.0 - s), 1.0 - s
        value = values[self.before] + s * s * (3.0 - 2.0 * s) * rise
        value += h * blend * (rest * begin - s * end)
        slope = 6.0 * blend * rise / h + rest * (1.0 - 3.0 * s) * begin + s * (3.0 * s - 2.0) * end
        return value, slope

    def slerp(self, attitudes: FloatArray) -> FloatArray:
        """Return (N, 4) unit quaternions on the great circles between known ones (K, 4)."""
        begin, end = attitudes[self.before], attitudes[self.before + 1]
        turn = self.share[:, None] * rotation_vectors(quaternion_product(_conjugate(begin), end))
        half = 0.5 * np.linalg.norm(turn, axis=1, keepdims=True)
        part = np.hstack([0.5 * np.sinc(half / np.pi) * turn, np.cos(half)])
        return quaternion_product(begin / np.linalg.norm(begin, axis=1, keepdims=True), part)


def quaternion_product(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the Hamilton products (N, 4) of quaternions (N, 4) or (1, 4), x y z w."""
    u, v, p, q = a[:, :3], b[:, :3], a[:, 3:], b[:, 3:]
    imaginary = p * v + q * u + np.cross(u, v)
    return np.hstack([imaginary, p * q - np.sum(u * v, axis=1, keepdims=True)])


def rotation_vectors(quaternions: FloatArray) -> FloatArray:
    """Return the rotation vectors (N, 3) of quaternions (N, 4) of any length, at most pi long."""
    unit = quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)
    shorter = np.where(unit[:, 3:] < 0.0, -unit, unit)
    sine = np.linalg.norm(shorter[:, :3], axis=1, keepdims=True)
    half = np.arctan2(sine, shorter[:, 3:])
    # Of no turn the axis is unknown, and of none the length: the ratio is that of small angles.
    ratio = np.divide(half, sine, out=np.ones_like(half), where=sine > 0.0)
    vectors: FloatArray = 2.0 * ratio * shorter[:, :3]
    return vectors


def turns_between(before: FloatArray, after: FloatArray) -> FloatArray:
    """Return the rotation vectors (N, 3), fixed navigation axes, from attitudes to others."""
    return rotation_vectors(quaternion_product(after, _conjugate(before)))


def _conjugate(quaternions: FloatArray) -> FloatArray:
    """Return the inverse rotations of quaternions (N, 4)."""
    return quaternions * [-1.0, -1.0, -1.0, 1.0]
