"""A walk repeated end to end, and the places of its feet many strides later.

Ma and Särkkä 2023, IV-A and Table I: each rectangle is repeated four times, and the feet's places
at the middle of their 68th stance are compared.  To the sensors the next round is a
continuation: it starts where, and in the direction in which, the last one ended.
A rectangle that ends 90 degrees to the right of its start becomes a windmill.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...core import EvaluationError, FloatArray, ImuSeries, Trajectory
from ...recording import Recording
from ...timing import align
from ..frames.association import Footfalls

STRIDE = 68
LEFT_FROM_RIGHT = (0.6, 0.2)  # forward and left, m: half a stride behind, 0.2 m beside; Table I


def repeated(recording: Recording, times: int) -> Recording:
    """Return the samples of both feet ``times`` times in a row, on one grid, without truth.

    The floor markers of all rounds are turned and joined; the result is no closed loop.
    """
    if times == 1:
        return recording
    if recording.left is None or recording.right is None:
        raise EvaluationError("both feet are needed to repeat a walk")
    left, right = align(recording.left, recording.right)
    if len(left) < 2:
        raise EvaluationError("the feet share no time, so there is nothing to repeat")
    feet = [_repeat_samples(foot, times) for foot in (left, right)]
    reference = recording.reference
    if reference is not None:
        markers = {foot: rounds(points, times) for foot, points in reference.markers.items()}
        length = None if reference.length_m is None else times * reference.length_m
        reference = replace(reference, markers=markers, length_m=length, closed_loop=False)
    return replace(
        recording,
        left=feet[0],
        right=feet[1],
        left_truth=None,
        right_truth=None,
        reference=reference,
        pressure={},
    )


def _repeat_samples(series: ImuSeries, times: int) -> ImuSeries:
    interval = int(np.median(np.diff(series.stamp_ns)))
    length = int(series.stamp_ns[-1] - series.stamp_ns[0]) + interval
    stamps = np.concatenate([series.stamp_ns + k * length for k in range(times)])
    return ImuSeries(
        stamps,
        np.tile(series.specific_force, (times, 1)),
        np.tile(series.angular_rate, (times, 1)),
        increments=series.increments,
    )


def rounds(points: FloatArray, times: int) -> FloatArray:
    """Return the (K, 3) markers of one round joined ``times`` times: the last is the next first.

    Each round is turned so that it sets out in the direction in which the last one ended.
    """
    if len(points) < 2 or times == 1:
        return points
    way = points - points[0]
    out, home = way[1], way[-1] - way[-2]
    turn = np.arctan2(home[1], home[0]) - np.arctan2(out[1], out[0])
    start, joined = points[0], [points[:1]]
    for k in range(times):
        turned = way @ _rotation(k * turn).T + start
        joined.append(turned[1:])
        start = turned[-1]
    return np.concatenate(joined)


def _rotation(yaw: float) -> FloatArray:
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class StridePlace:
    """The places of the feet at the middle of a stance, in the frame of Table I of the paper.

    The right foot starts at the origin, y points along the first strides, x to the right; all in
    m.  ``true_*`` is from the floor markers of the right foot, None where there are none or not as
    many as stances; the left one is beside and half a stride behind, as in the paper.
    """

    right: tuple[float, float]
    left: tuple[float, float]
    true_right: tuple[float, float] | None
    true_left: tuple[float, float] | None


def stride_place(
    trajectory: Trajectory, markers: FloatArray | None, number: int = STRIDE
) -> StridePlace | None:
    """Return the places at the right foot's stance of that number (the stand is 1).

    The left foot's is its last stance before that.  None when the walk is shorter.
    ``trajectory`` is in the tracker's own frame, x along the first strides.
    """
    falls = [Footfalls.of(foot) for foot in (trajectory.left, trajectory.right)]
    if len(falls[1]) < number:
        return None
    middle = int(falls[1].middle[number - 1])
    before = falls[0].middle[falls[0].middle < middle]
    if len(before) == 0:
        return None
    at = int(before[-1]), middle
    start = trajectory.right.position[falls[1].middle[0]]
    left, right = (
        _paper_axes(foot.position[k] - start)
        for foot, k in zip((trajectory.left, trajectory.right), at, strict=True)
    )
    true_right, true_left = _true_places(markers, number, len(falls[1]))
    return StridePlace(right, left, true_right, true_left)


Place = tuple[float, float]


def _true_places(
    markers: FloatArray | None, number: int, stances: int
) -> tuple[Place | None, Place | None]:
    """Return the places of the feet by the markers, the first leg being the y axis."""
    if markers is None or len(markers) != stances:
        return None, None
    way = markers - markers[0]
    turn = _rotation(-float(np.arctan2(way[1][1], way[1][0])))
    here = way[number - 1] @ turn.T
    leg = (way[number - 1] - way[number - 2]) @ turn.T
    ahead = leg / np.linalg.norm(leg)
    beside = np.array([-ahead[1], ahead[0], 0.0])
    left = here - LEFT_FROM_RIGHT[0] * ahead + LEFT_FROM_RIGHT[1] * beside
    return _paper_axes(here), _paper_axes(left)


def _paper_axes(point: FloatArray) -> Place:
    """Return (x, y) with y forward and x to the right, from x forward and y to the left."""
    return float(-point[1]), float(point[0])
