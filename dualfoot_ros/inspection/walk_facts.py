"""A walk in figures that tell whether its stances were found and its tracks are possible.

The feet take turns: while one makes a step, the other stands once.  So a foot that has no stance
while the other has two has missed one, whatever the track says.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core import (
    FloatArray,
    FootTrajectory,
    IntArray,
    Trajectory,
    median,
    picked,
    stance_bounds,
    swing_passings,
)

LEAST_STRIDE_M = 0.3  # shorter ones are shuffling, or turning on the spot
LEAST_STRIDES = 6  # of a foot, for a course
LEAST_TURN_STD = 0.3  # rad, of the course, to compare turns
STEP_STANCE_S = 1.2  # a longer stance is no step
LEAST_HOLE_S = 0.1  # without a sample; a stance may be in it
HOLE_EPOCHS = 1.5  # times the mean time between epochs: at 10 Hz 0.1 s is no hole


class StepFacts(NamedTuple):
    """The steps of one foot.

    Attributes
    ----------
    strides : number of strides of LEAST_STRIDE_M or more
    paced : the same with the half strides of a start and a stop as what they are of the median one
    median_stride_m, longest_stride_m : m, of these, horizontal; nan without any
    longest_at_s : s, when the longest one ends, from the start of the track
    longest_hole_s : s, the longest time without a sample in it
    missed : stances that the foot must have had while the other one stood repeatedly, where it
        had samples
    without_stance_s, without_stance_at_s : s, the longest time without a stance after the first
        one, and when it begins
    without_stance_hole_s : s, the longest time without a sample in it
    usual_swing_s : s, median time between stances
    moving_share : median share of stance in the cycles of the strides; nan without any
    way_m : m, from stance to stance
    """

    strides: int
    paced: float
    median_stride_m: float
    longest_stride_m: float
    longest_at_s: float
    longest_hole_s: float
    missed: int
    without_stance_s: float
    without_stance_at_s: float
    without_stance_hole_s: float
    usual_swing_s: float
    moving_share: float
    way_m: float


class WalkFacts(NamedTuple):
    """The steps of both feet, and the feet against each other.

    Attributes
    ----------
    feet : by name
    turned_rad : net turn of the walk, rad, left positive
    turns_alike : slope of the right foot's course over the left foot's: 1 where they turn alike,
        -1 where one is the mirror image of the other; nan for a walk that hardly turns
    passings : how often one foot went by the other
    widest_m, widest_at_s : m and s, the greatest distance of the tracks where they pass
    """

    feet: dict[str, StepFacts]
    turned_rad: float
    turns_alike: float
    passings: int
    widest_m: float
    widest_at_s: float


def walk_facts(trajectory: Trajectory) -> WalkFacts:
    """Return the figures of a tracked walk."""
    left, right = trajectory.left, trajectory.right
    passings = swing_passings(left.position, right.position, left.stance, right.stance)
    widest = int(np.argmax(passings.distance_m)) if len(passings.index) else -1
    courses = _course(left), _course(right)
    return WalkFacts(
        feet={"left": _steps(left, right), "right": _steps(right, left)},
        turned_rad=float(np.mean([course[-1] - course[0] for _, course in courses])),
        turns_alike=_slope(*courses),
        passings=len(passings.index),
        widest_m=float(passings.distance_m[widest]) if widest >= 0 else 0.0,
        widest_at_s=_seconds(left, int(passings.index[widest])) if widest >= 0 else float("nan"),
    )


def _steps(foot: FootTrajectory, other: FootTrajectory) -> StepFacts:
    bounds = stance_bounds(foot.stance)
    places = picked(foot.position, (bounds[:, 0] + bounds[:, 1] - 1) // 2)[:, :2]
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    strides = lengths >= LEAST_STRIDE_M
    longest = int(np.argmax(lengths)) if strides.any() else -1
    median_m = median(lengths[strides]) if strides.any() else float("nan")
    swings, holes = _swings_s(foot, bounds), longest_holes_s(foot, bounds)
    gap = int(np.argmax(swings)) if len(swings) else -1
    return StepFacts(
        strides=int(strides.sum()),
        paced=float(_paced(foot, bounds, lengths / median_m)[strides].sum()),
        median_stride_m=median_m,
        longest_stride_m=float(lengths[longest]) if longest >= 0 else float("nan"),
        longest_at_s=(
            _seconds(foot, int(bounds[longest + 1, 0])) if longest >= 0 else float("nan")
        ),
        longest_hole_s=float(holes[longest]) if longest >= 0 else 0.0,
        missed=int(_missed(bounds, other.stance)[holes[:-1] < LEAST_HOLE_S].sum()),
        without_stance_s=float(swings[gap]) if gap >= 0 else 0.0,
        without_stance_at_s=_seconds(foot, int(bounds[gap, 1]) - 1) if gap >= 0 else float("nan"),
        without_stance_hole_s=float(holes[gap]) if gap >= 0 else 0.0,
        usual_swing_s=median(swings) if len(swings) else float("nan"),
        moving_share=_moving_share(foot, bounds, strides),
        way_m=float(lengths.sum()),
    )


def _paced(foot: FootTrajectory, bounds: IntArray, shares: FloatArray) -> FloatArray:
    """Return what each stride counts: one, and its share beside a stand, where it may be half.

    Between steps every stride counts in full, however short: on stairs all of them are.
    """
    stamps = foot.stamp_ns
    stood = (stamps[bounds[:, 1] - 1] - stamps[bounds[:, 0]]) * 1e-9 > STEP_STANCE_S
    counted: FloatArray = np.where(stood[:-1] | stood[1:], np.minimum(shares, 1.0), 1.0)
    return counted


def _seconds(foot: FootTrajectory, epoch: int) -> float:
    """Return the time from the start of the track to an epoch."""
    return float(foot.stamp_ns[epoch] - foot.stamp_ns[0]) * 1e-9


def _missed(bounds: IntArray, other: np.ndarray) -> IntArray:
    """Return how many stances of ``other`` more than one lie within each step of a foot."""
    theirs = stance_bounds(other)
    before = np.searchsorted(theirs[:, 0], bounds[:-1, 1], side="left")
    until = np.searchsorted(theirs[:, 1], bounds[1:, 0], side="right")
    missed: IntArray = np.maximum(until - before - 1, 0)
    return missed


def _swings_s(foot: FootTrajectory, bounds: IntArray) -> FloatArray:
    """Return the times between stances, s; the last one is that until the end."""
    if not len(bounds):
        return np.zeros(0)
    begins = np.append(bounds[1:, 0], len(foot) - 1)
    swings: FloatArray = (foot.stamp_ns[begins] - foot.stamp_ns[bounds[:, 1] - 1]) * 1e-9
    return swings


def longest_holes_s(foot: FootTrajectory, bounds: IntArray) -> FloatArray:
    """Return the longest time without a sample, s, for each stance and the step after it.

    The step before it counts too: a foot that was away is put right in its first stance.
    """
    if not len(bounds):
        return np.zeros(0)
    there = np.flatnonzero(foot.present)
    steps = np.diff(foot.stamp_ns[there], prepend=foot.stamp_ns[:1]) * 1e-9
    least = HOLE_EPOCHS * _seconds(foot, -1) / max(1, len(foot) - 1)
    firsts = np.searchsorted(there, np.append(bounds[:1, 0], bounds[:-1, 0])) + 1
    lasts = np.searchsorted(there, np.append(bounds[1:, 1], len(foot)))
    spans = np.column_stack([np.minimum(firsts, len(steps)), lasts])
    holes = np.maximum.reduceat(np.append(steps, 0.0), spans.ravel())[::2]
    return np.where((spans[:, 0] < spans[:, 1]) & (holes >= least), np.maximum(holes, 0.0), 0.0)


def _moving_share(foot: FootTrajectory, bounds: IntArray, strides: np.ndarray) -> float:
    """Return the median share of stance in the cycles that are strides and begin with a step."""
    if not strides.any():
        return float("nan")
    stamps = foot.stamp_ns
    stance = (stamps[bounds[:-1, 1] - 1] - stamps[bounds[:-1, 0]]) * 1e-9
    cycle = (stamps[bounds[1:, 0]] - stamps[bounds[:-1, 0]]) * 1e-9
    used = strides & (stance < STEP_STANCE_S)
    return median(stance[used] / cycle[used]) if used.any() else float("nan")


def _course(foot: FootTrajectory) -> tuple[FloatArray, FloatArray]:
    """Return stamps (S,) s and unwrapped directions (S,) rad of a foot's strides."""
    middles = stance_bounds(foot.stance).sum(axis=1) // 2
    ways: FloatArray = np.diff(picked(foot.position, middles)[:, :2], axis=0)
    long = np.linalg.norm(ways, axis=1) >= LEAST_STRIDE_M
    if not long.any():
        return np.zeros(1), np.zeros(1)
    seconds = (foot.stamp_ns[middles] - foot.stamp_ns[0]) * 1e-9
    headings = np.unwrap(np.arctan2(ways[long, 1], ways[long, 0]))
    return 0.5 * (seconds[1:] + seconds[:-1])[long], headings


def _slope(left: tuple[FloatArray, FloatArray], right: tuple[FloatArray, FloatArray]) -> float:
    """Return the slope of the right course over the left one; nan for a walk without turns."""
    at = np.interp(left[0], *right)
    course = left[1] - left[1].mean()
    spread = float(course @ course)
    if len(course) < LEAST_STRIDES or spread < len(course) * LEAST_TURN_STD**2:
        return float("nan")
    return float(course @ (at - at.mean())) / spread
