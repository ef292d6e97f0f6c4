"""Attitudes and positions between the poses of a reference, with the sums of scipy in its order.

``Slerp`` and ``CubicHermiteSpline`` take several times as long for an hour of samples, and to load
them takes half a second.
"""

from __future__ import annotations

import numpy as np

from ...core import FloatArray, IntArray

SMALL_ANGLE = 1e-3  # rad, below which scipy takes the first terms of the series


class GreatCircles:
    """Attitudes on great circles between quaternions (K, 4) at ``known`` (K,) s (slerp).

    They are Hamilton, x y z w, of any length but zero; those returned have length one.
    """

    def __init__(self, known: FloatArray, quaternions: FloatArray) -> None:
        unit = _unit(quaternions.T)
        self._known, self._step, self._unit = known, np.diff(known), unit
        self._turns = _turn_vectors(_unit(_product(_inverse(unit[:, :-1]), unit[:, 1:])))

    def at(self, wanted: FloatArray) -> FloatArray:
        """Return attitudes (N, 4) at ``wanted`` (N,) s."""
        k: IntArray = np.maximum(np.searchsorted(self._known, wanted) - 1, 0)
        share = (wanted - self._known[k]) / self._step[k]
        turned = _quaternions(self._turns[:, k] * share)
        return _unit(_product(self._unit[:, k], turned)).T


def turns_between(before: FloatArray, after: FloatArray) -> FloatArray:
    """Return rotation vectors (N, 3) rad, fixed axes, from attitudes (N, 4) to others."""
    turn = _product(_unit(after.T), _inverse(_unit(before.T)))
    return _turn_vectors(_unit(turn)).T


class HermiteSpline:
    """Cubics through positions (K, 3) at ``known`` (K,) s, with the velocities (K, 3) there."""

    def __init__(self, known: FloatArray, position: FloatArray, velocity: FloatArray) -> None:
        step = np.diff(known)[:, np.newaxis]
        slope = np.diff(position, axis=0) / step
        bend = (velocity[:-1] + velocity[1:] - 2 * slope) / step
        self._known = known
        self._third, self._second = bend / step, (slope - velocity[:-1]) / step - bend
        self._first, self._zeroth = velocity[:-1], position[:-1]

    def at(self, wanted: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return positions and velocities (N, 3) at ``wanted`` (N,) s."""
        last = len(self._known) - 2
        k: IntArray = np.minimum(np.searchsorted(self._known, wanted, side="right") - 1, last)
        since = (wanted - self._known[k])[:, np.newaxis]
        square = since * since
        first, second, third = self._first[k], self._second[k], self._third[k]
        position = self._zeroth[k] + first * since + second * square + third * (square * since)
        return position, first + second * since * 2.0 + third * square * 3.0


def _unit(quaternions: FloatArray) -> FloatArray:
    x, y, z, w = quaternions
    unit: FloatArray = quaternions / np.sqrt(x * x + y * y + z * z + w * w)
    return unit


def _inverse(quaternions: FloatArray) -> FloatArray:
    x, y, z, w = quaternions
    return np.array([-x, -y, -z, w])


def _product(one: FloatArray, other: FloatArray) -> FloatArray:
    """Return the products of quaternions (4, N)."""
    a, b, c, d = one
    x, y, z, w = other
    return np.array(
        [
            d * x + w * a + (b * z - c * y),
            d * y + w * b + (c * x - a * z),
            d * z + w * c + (a * y - b * x),
            d * w - a * x - b * y - c * z,
        ]
    )


def _turn_vectors(quaternions: FloatArray) -> FloatArray:
    """Return rotation vectors (3, K) rad of unit quaternions (4, K): half a turn at most."""
    x, y, z, w = np.where(quaternions[3] < 0.0, -quaternions, quaternions)
    angles = 2.0 * np.arctan2(np.sqrt(x * x + y * y + z * z), w)
    squares = angles * angles
    with np.errstate(invalid="ignore", divide="ignore"):
        scale = angles / np.sin(angles / 2.0)
    series = 2.0 + squares / 12.0 + 7.0 * squares * squares / 2880.0
    turns: FloatArray = np.where(angles <= SMALL_ANGLE, series, scale) * np.array([x, y, z])
    return turns


def _quaternions(turns: FloatArray) -> FloatArray:
    """Return the unit quaternions (4, N) of rotation vectors (3, N) rad."""
    x, y, z = turns
    angles = np.sqrt(x * x + y * y + z * z)
    squares = angles * angles
    with np.errstate(invalid="ignore", divide="ignore"):
        scale = np.sin(angles / 2.0) / angles
    series = 0.5 - squares / 48.0 + squares * squares / 3840.0
    scale = np.where(angles <= SMALL_ANGLE, series, scale)
    return np.array([scale * x, scale * y, scale * z, np.cos(angles / 2.0)])
