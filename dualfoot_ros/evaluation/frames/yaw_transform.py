"""Transforms in yaw and translation, which are unobservable, from an estimate to its reference.

Position and heading of the start are a gauge: four degrees of freedom (yaw and translation) that
no inertial sensor observes.  Roll and pitch are observed, so they are never aligned away.  Two
ways to fix the gauge are offered and every report names the one it used:

``first_strides``
    The start coincides and the heading is the best fit over the first metres, as a user would
    set out with a map.  Errors then grow from zero, as Liu et al. 2023, Table III, counts them.
``umeyama4``
    The best fit over the whole walk (Umeyama 1991 with scale one and yaw only), the absolute
    trajectory error of robotics.  Smaller, since half of a heading drift is fitted away.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ...core import EvaluationError, FloatArray, FootTrajectory, new_array

FIRST_STRIDES_M = 4.8
LEAST_WAY_M = 0.1  # that a foot goes in a stride
"""Length of the start over which ``first_strides`` fits the heading (five floor markers)."""


class Align(StrEnum):
    """The method that fixes the frame of an estimate to that of the reference."""

    FIRST_STRIDES = "first_strides"
    UMEYAMA4 = "umeyama4"


class Pair(StrEnum):
    """One transform for both feet, or one for each foot."""

    COMMON = "common"
    EACH = "each"


class YawTransform(NamedTuple):
    """A turn by ``yaw`` (rad) about the vertical, then a shift by ``translation`` (3,) m."""

    yaw: float
    translation: FloatArray

    @property
    def matrix(self) -> FloatArray:
        """Return the (3, 3) rotation about z."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def position(self, points: FloatArray) -> FloatArray:
        """Return transformed (N, 3) positions."""
        moved = self.vector(points)
        moved += self.translation
        return moved

    def vector(self, vectors: FloatArray) -> FloatArray:
        """Return turned (N, 3) vectors; they are not shifted."""
        turned: FloatArray = np.matmul(vectors, self.matrix.T, out=new_array(np.shape(vectors)))
        return turned

    def covariance(self, matrices: FloatArray) -> FloatArray:
        """Return turned (N, 3, 3) covariances."""
        return self.matrix @ matrices @ self.matrix.T

    def quaternion(self, quaternions: FloatArray) -> FloatArray:
        """Return turned (N, 4) attitudes, Hamilton, x y z w."""
        s, c = math.sin(self.yaw / 2), math.cos(self.yaw / 2)
        x, y, z, w = np.asarray(quaternions).T
        turned = new_array((len(x), 4))
        turned[:, 0], turned[:, 1] = c * x - s * y, c * y + s * x
        turned[:, 2], turned[:, 3] = c * z + s * w, c * w - s * z
        return turned

    def foot(self, track: FootTrajectory) -> FootTrajectory:
        """Return a whole foot trajectory in the new frame, covariances included."""
        return replace(
            track,
            position=self.position(track.position),
            velocity=self.vector(track.velocity),
            quaternion=self.quaternion(track.quaternion),
            position_covariance=track.position_covariance.turned(self.matrix),
            velocity_covariance=track.velocity_covariance.turned(self.matrix),
            attitude_covariance=track.attitude_covariance.turned(self.matrix),
        )

    def to_dict(self) -> dict[str, object]:
        """Return the transform in plain values."""
        return {"yaw_deg": math.degrees(self.yaw), "translation_m": self.translation.tolist()}


Points = Sequence[FloatArray]


def umeyama4(estimate: FloatArray, reference: FloatArray) -> YawTransform:
    """Return the yaw and translation of least squared distance between (N, 3) point pairs."""
    centre_e, centre_r = estimate.mean(axis=0), reference.mean(axis=0)
    yaw = _best_yaw(estimate - centre_e, reference - centre_r)
    return _transform_through(yaw, centre_e, centre_r)


def first_strides(
    estimate: Points, reference: Points, length: float = FIRST_STRIDES_M
) -> YawTransform:
    """Return the transform that joins the starts and fits the heading over the first strides.

    ``estimate`` and ``reference`` hold, for each foot that takes part, (M, 3) positions of its
    stances.  The yaw is the least squares turn about each foot's own start of the stances within
    ``length`` (m) of it; the translation joins the means of the starts.

    Raises
    ------
    EvaluationError
        When no foot made a stride within ``length``.
    """
    from_e, from_r = [], []
    for e, r in zip(estimate, reference, strict=True):
        near = np.linalg.norm((r - r[0])[:, :2], axis=1) <= length + 1e-6
        first = len(r) if near.all() else int(np.argmin(near))
        from_e.append((e - e[0])[:first])
        from_r.append((r - r[0])[:first])
    if not any(np.abs(r[:, :2]).max() > LEAST_WAY_M for r in from_r):
        raise EvaluationError(
            f"no stride within the first {length:g} m of the tracked walk, so nothing shows its "
            "heading for first_strides; align with umeyama4"
        )
    yaw = _best_yaw(np.vstack(from_e), np.vstack(from_r))
    start_e = np.mean([e[0] for e in estimate], axis=0)
    start_r = np.mean([r[0] for r in reference], axis=0)
    return _transform_through(yaw, start_e, start_r)


def fit(how: Align, estimate: Points, reference: Points, length: float) -> YawTransform:
    """Return the transform of kind ``how`` for the given points of one foot or of both."""
    if how is Align.UMEYAMA4:
        return umeyama4(np.vstack(estimate), np.vstack(reference))
    return first_strides(estimate, reference, length)


def _best_yaw(estimate: FloatArray, reference: FloatArray) -> float:
    cross = estimate[:, 0] @ reference[:, 1] - estimate[:, 1] @ reference[:, 0]
    dot = estimate[:, 0] @ reference[:, 0] + estimate[:, 1] @ reference[:, 1]
    return math.atan2(cross, dot)


def _transform_through(yaw: float, origin: FloatArray, target: FloatArray) -> YawTransform:
    turn = YawTransform(yaw, np.zeros(3))
    return YawTransform(yaw, target - turn.position(origin[None])[0])
