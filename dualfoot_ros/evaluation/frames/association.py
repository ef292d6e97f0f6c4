"""A reference at the stamps of an estimate, and the feet from stance to stance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import (
    EvaluationError,
    FloatArray,
    FootTrajectory,
    IntArray,
    PoseSeries,
    new_array,
    picked,
    stance_bounds,
    stance_middles,
)
from .between_poses import GreatCircles, HermiteSpline

TOGETHER = 1 << 12  # stamps at once: what they need stays in the cache of the processor


def seconds(stamp_ns: IntArray, origin_ns: int) -> FloatArray:
    """Return (N,) seconds since ``origin_ns``."""
    return (np.asarray(stamp_ns, dtype=np.int64) - origin_ns) * np.float64(1e-9)


def truth_at(stamp_ns: IntArray, truth: PoseSeries) -> PoseSeries:
    """Return the truth interpolated to (N,) stamps that lie within it.

    Positions follow cubic Hermite splines where velocities are known and straight lines where
    not; attitudes follow great circles (slerp).
    """
    origin = int(truth.stamp_ns[0])
    known, wanted = seconds(truth.stamp_ns, origin), seconds(stamp_ns, origin)
    _check_poses(known, truth.quaternion)
    attitude, position = (new_array((len(wanted), columns)) for columns in (4, 3))
    circles, velocity, spline = GreatCircles(known, truth.quaternion), None, None
    if truth.velocity is not None:
        velocity = new_array((len(wanted), 3))
        spline = HermiteSpline(known, truth.position, truth.velocity)
    for start in range(0, len(wanted), TOGETHER):
        part = slice(start, start + TOGETHER)
        attitude[part] = circles.at(wanted[part])
        if velocity is None or spline is None:
            for axis, places in enumerate(truth.position.T):
                position[part, axis] = np.interp(wanted[part], known, places)
        else:
            position[part], velocity[part] = spline.at(wanted[part])
    return PoseSeries(stamp_ns, position, attitude, velocity)


def _check_poses(known: FloatArray, quaternions: FloatArray) -> None:
    """Refuse poses (K,) that are not in order, or are no attitudes."""
    if not (np.diff(known) > 0.0).all():
        raise EvaluationError("the stamps of the truth do not increase; record it anew")
    if not quaternions.any(axis=1).all():
        raise EvaluationError("the truth has quaternions of length 0, which are no attitudes")


def within(stamp_ns: IntArray, truth: PoseSeries) -> np.ndarray:
    """Return the (N,) mask of the stamps between the first and the last of the truth."""
    inside: np.ndarray = (stamp_ns >= truth.stamp_ns[0]) & (stamp_ns <= truth.stamp_ns[-1])
    if inside.sum() < 2:
        raise EvaluationError(
            f"the truth covers {truth.stamp_ns[0]} to {truth.stamp_ns[-1]} ns and the estimate "
            f"{stamp_ns[0]} to {stamp_ns[-1]} ns; they must overlap in time"
        )
    return inside


def as_slice(keep: np.ndarray) -> np.ndarray | slice:
    """Return the (N,) mask as a slice where it keeps one stretch: that needs no copy of a walk."""
    at = np.flatnonzero(keep)
    whole = len(at) > 0 and int(at[-1]) - int(at[0]) + 1 == len(at)
    return slice(int(at[0]), int(at[-1]) + 1) if whole else keep


@dataclass(frozen=True)
class Footfalls:
    """Where one foot stood: stance by stance.

    Attributes
    ----------
    bounds : (M, 2) first and one-past-last epoch of every stance
    middle : (M,) middle epoch of every stance
    """

    bounds: IntArray
    middle: IntArray

    @classmethod
    def of(cls, track: FootTrajectory) -> Footfalls:
        """Find the stances of a track."""
        return cls(stance_bounds(track.stance), stance_middles(track.stance))

    def __len__(self) -> int:
        """Return the number of stances."""
        return len(self.middle)

    def mean(self, position: FloatArray) -> FloatArray:
        """Return (M, 3) mean positions over each stance of (N, 3) positions."""
        sums = [np.add.reduce(position[a:b]) for a, b in self.bounds.tolist()]
        means: FloatArray = np.reshape(sums, (-1, 3)) / np.diff(self.bounds)
        return means

    def walked(self, position: FloatArray, stamp_ns: IntArray) -> FloatArray:
        """Return the (N,) horizontal way from stance to stance, in m, at every epoch.

        The way grows evenly in time within a stride, and is zero up to the first stance's middle.
        """
        if len(self) == 0:
            return np.zeros(len(stamp_ns))
        steps = np.linalg.norm(np.diff(picked(position, self.middle)[:, :2], axis=0), axis=1)
        way = np.concatenate([[0.0], np.cumsum(steps)])
        origin = int(stamp_ns[0])
        time = seconds(stamp_ns, origin)
        walked: FloatArray = np.interp(time, time[self.middle], way)
        return walked
