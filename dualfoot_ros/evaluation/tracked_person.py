"""The person between the feet: place, heading, floor, and how well the place is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import (
    Covariances,
    FloatArray,
    FootTrajectory,
    IntArray,
    Trajectory,
    new_array,
    picked,
    quaternion_matrices,
    row_blocks,
)
from .frames.association import Footfalls, seconds
from .gait import forward_axis
from .person_shares import PersonCovariances, person_positions, person_shares

CHI2_95_PLANE = 5.991
"""95 % quantile of chi-square with two degrees of freedom."""


@dataclass(frozen=True)
class PersonTrack:
    """The track of the person, one row an epoch.

    Attributes
    ----------
    stamp_ns : (N,)
    position : (N, 3) m, midway between the sensors of the feet; where one foot has no samples,
        that of the other
    covariance : (N, 3, 3) m^2, of the position
    heading : (N,) rad, unwrapped: mean of the directions in which the feet point while they stand
    floor_m : (N,) m, height of the feet where they stand, from stance to stance
    walked_m : (N,) m, horizontal distance from stance to stance, mean of the feet
    """

    stamp_ns: IntArray
    position: FloatArray
    covariance: Covariances | FloatArray
    heading: FloatArray
    floor_m: FloatArray
    walked_m: FloatArray

    def at(self, rows: slice | IntArray) -> PersonTrack:
        """Return some epochs of it."""
        return PersonTrack(**{name: values[rows] for name, values in vars(self).items()})

    @property
    def radius_95_m(self) -> FloatArray:
        """Radius (N,) m that holds the true place with 95 %: the longer axis of the ellipse."""
        return np.sqrt(CHI2_95_PLANE * np.maximum(self.axes[0], 0.0))

    @property
    def axes(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Variances (N,) m^2 along the longer and shorter axis, and angle of the longer, rad."""
        xx, yy, xy = (self.covariance[:, i, j] for i, j in ((0, 0), (1, 1), (0, 1)))
        middle, half = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
        return middle + half, np.maximum(middle - half, 0.0), 0.5 * np.arctan2(2 * xy, xx - yy)


def person_track(trajectory: Trajectory) -> PersonTrack:
    """Return the person's track of both feet, or of the foot that has samples."""
    feet = trajectory.left, trajectory.right
    stood = [(foot, Footfalls.of(foot)) for foot in feet]
    steps = (np.diff(f.walked(foot.position, foot.stamp_ns), prepend=0.0) for foot, f in stood)
    floors = (_floor(foot, f) for foot, f in stood)
    headings = (_heading(foot, f) for foot, f in stood)
    return PersonTrack(
        stamp_ns=feet[0].stamp_ns,
        position=person_positions(trajectory),
        covariance=PersonCovariances(trajectory),
        heading=_mean_heading(trajectory, *headings),
        floor_m=_shared(trajectory, *floors),
        walked_m=_summed(_shared(trajectory, *steps)),
    )


def _shared(trajectory: Trajectory, left: FloatArray, right: FloatArray) -> FloatArray:
    """Return the mean (N,) of what both feet say, by their shares in the person."""
    mean = new_array(left.shape)
    for part in row_blocks(len(mean)):
        a, b = person_shares(trajectory, part)
        mean[part] = a * left[part] + b * right[part]
    return mean


def _summed(steps: FloatArray) -> FloatArray:
    """Return the sums (N,) up to each of the steps, in their place."""
    sums: FloatArray = np.cumsum(steps, out=steps)
    return sums


def _floor(foot: FootTrajectory, falls: Footfalls) -> FloatArray:
    """Return the height (N,) m of a foot where it stands; as it is without any stance."""
    height = foot.position[:, 2]
    return _held(foot, falls, picked(height, falls.middle)) if len(falls) else height


def _held(foot: FootTrajectory, falls: Footfalls, values: FloatArray) -> FloatArray:
    """Return ``values`` (M,) in the middles of the stances joined by lines, at all epochs (N,)."""
    time = seconds(foot.stamp_ns, int(foot.stamp_ns[0]))
    held: FloatArray = np.interp(time, time[falls.middle], values)
    return held


def _heading(foot: FootTrajectory, falls: Footfalls) -> FloatArray:
    """Return the heading (N,) of a foot, rad; zero for a foot that made no straight stride."""
    axis = forward_axis(foot, falls)
    if axis is None:
        return np.zeros(len(foot))
    ahead = quaternion_matrices(picked(foot.quaternion, falls.middle)) @ axis
    return _held(foot, falls, np.unwrap(np.arctan2(ahead[:, 1], ahead[:, 0])))


def _mean_heading(trajectory: Trajectory, left: FloatArray, right: FloatArray) -> FloatArray:
    """Return the mean of two unwrapped headings (N,), whole turns apart or not."""
    turns = np.round((right[0] - left[0]) / (2 * np.pi)) * 2 * np.pi if len(left) else 0.0
    return _shared(trajectory, left, right - turns)
