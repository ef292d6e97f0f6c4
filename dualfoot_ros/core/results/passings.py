"""The moments at which one foot passes the other, in the tracks of a whole walk.

One foot stands and the other swings by.  There are two moments to choose from:

- the middle of a *swing* (:func:`swing_passings`), from the stances alone, so that it is the same
  moment for every method: for figures that compare methods;
- the middle of a *stance* (:func:`stance_passings`), from the events of the tracker, at which the
  constraint methods expect the feet side by side: for estimates from two unconstrained tracks.

Swings of less than 0.3 m (shuffling, turning on the spot) have no direction and do not count.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..samples.by_block import picked
from ..samples.series import BoolArray, FloatArray, IntArray
from .events import FEET, EventKind
from .trajectory import FootTrajectory, Trajectory, stance_bounds

LEAST_SWING_M = 0.3
LONGEST_STANCE_S = 1.2  # a longer stance is no step
SAME_WAY = 0.5  # length of the mean of two unit vectors that do not go opposite ways
MID_STANCE = 0.5  # share of the stance at which the other foot goes by


@dataclass(frozen=True)
class SwingPassings:
    """The middles of all swings.

    Attributes
    ----------
    index : (K,) epoch
    lateral_m : (K,) m by which the left foot is on the left of the right one; negative: crossed
    distance_m : (K,) m, three-dimensional distance between the feet
    """

    index: IntArray
    lateral_m: FloatArray
    distance_m: FloatArray

    @property
    def crossed_percent(self) -> float | None:
        """Share of the passings at which the feet are crossed, in percent."""
        return float(100.0 * np.mean(self.lateral_m < 0)) if len(self.index) else None

    def where(self, wanted: BoolArray) -> SwingPassings:
        """Return the passings at the epochs where ``wanted`` (N,) is true."""
        kept = wanted[self.index]
        return SwingPassings(self.index[kept], self.lateral_m[kept], self.distance_m[kept])


def swing_passings(
    left: FloatArray, right: FloatArray, left_stance: np.ndarray, right_stance: np.ndarray
) -> SwingPassings:
    """Return the passings of two (N, 3) tracks of equal stamps with (N,) stances each.

    The direction of walking is that of the swinging foot in the middle half of its swing.
    """
    swings = [_swings(left, left_stance), _swings(right, right_stance)]
    index, way = (np.concatenate(both) for both in zip(*swings, strict=True))
    order = np.argsort(index, kind="stable")
    index, way = index[order], way[order]
    apart = picked(left, index) - picked(right, index)
    lateral = way[:, 0] * apart[:, 1] - way[:, 1] * apart[:, 0]
    return SwingPassings(index, lateral, np.linalg.norm(apart, axis=1))


def _swings(position: FloatArray, stance: np.ndarray) -> tuple[IntArray, FloatArray]:
    """Return the middle epochs (K,) and unit directions (K, 2) of all swings between stances."""
    bounds = stance_bounds(stance)
    begin, end = bounds[:-1, 1], bounds[1:, 0]
    quarter = (end - begin) // 4
    way = (picked(position, end - 1 - quarter) - picked(position, begin + quarter))[:, :2]
    stride = (picked(position, end) - picked(position, begin - 1))[:, :2]
    far = (np.linalg.norm(stride, axis=1) >= LEAST_SWING_M) & way.any(axis=1)
    middle: IntArray = (begin[far] + end[far] - 1) // 2
    return middle, way[far] / np.linalg.norm(way[far], axis=1)[:, np.newaxis]


class StanceEpochs(NamedTuple):
    """First and last epoch of a stance, as the constraint methods see it."""

    first: int
    last: int


class StancePassing(NamedTuple):
    """The middle of one stance, while the other foot swings by.

    Attributes
    ----------
    epoch : the moment
    standing : 0 when the left foot stands, 1 for the right one
    stance : that stance
    swing : last epoch before and first epoch after the swing of the other foot
    separation : (2,) m, left minus right, horizontal
    forward : (2,) unit vector along the walk: the mean of the feet's strides
    middle : (2,) m, between the feet
    """

    epoch: int
    standing: int
    stance: StanceEpochs
    swing: tuple[int, int]
    separation: FloatArray
    forward: FloatArray
    middle: FloatArray

    @property
    def left(self) -> FloatArray:
        """Return the (2,) unit vector to the left of the walk."""
        return np.array([-self.forward[1], self.forward[0]])


def stance_passings(trajectory: Trajectory) -> list[StancePassing]:
    """Return the passings of a walk in order; ``trajectory`` is best of method ``zupt``."""
    stances = [ended_stances(trajectory, foot) for foot in FEET]
    tracks = (trajectory.left, trajectory.right)
    stamps = trajectory.left.stamp_ns
    longest = LONGEST_STANCE_S * 1e9
    passings = [
        passing
        for foot in range(2)
        for number, stance in enumerate(stances[foot])
        if stamps[stance.last] - stamps[stance.first] <= longest
        for passing in _passing(tracks, stances, foot, number)
    ]
    return sorted(passings, key=lambda passing: passing.epoch)


def ended_stances(trajectory: Trajectory, foot: str) -> list[StanceEpochs]:
    """Return the stances of a foot that have ended, from the events of the tracker."""
    kinds = (EventKind.STANCE_START, EventKind.STANCE_END)
    events = [e for e in trajectory.events if e.foot == foot and e.kind in kinds]
    events.sort(key=lambda e: (e.stamp_ns, e.kind is EventKind.STANCE_END))
    stamps: IntArray = trajectory.left.stamp_ns
    moments = np.array([event.stamp_ns for event in events], dtype=np.int64)
    epochs = np.clip(np.searchsorted(stamps, moments), 0, len(stamps) - 1).tolist()
    stances, first = [], None
    for event, at in zip(events, epochs, strict=True):
        if event.kind is EventKind.STANCE_START:
            first = at
        elif first is not None and at > first:
            stances.append(StanceEpochs(first, at))
            first = None
    return stances


def _passing(
    tracks: tuple[FootTrajectory, FootTrajectory],
    stances: list[list[StanceEpochs]],
    foot: int,
    number: int,
) -> Iterator[StancePassing]:
    """Yield the passing within one stance of ``foot``, if the other foot went by."""
    stance = stances[foot][number]
    moment = round((1.0 - MID_STANCE) * stance.first + MID_STANCE * stance.last)
    swing = swing_around(stances[1 - foot], moment)
    if swing is None:
        return
    way = _direction(tracks[1 - foot], *swing)
    if way is None:
        return
    forward = way
    if 0 < number < len(stances[foot]) - 1:
        before, after = stances[foot][number - 1], stances[foot][number + 1]
        own = _direction(tracks[foot], before.last, after.first)
        forward = way if own is None else (way + own) / 2.0
    size = math.sqrt(forward @ forward)
    if size < SAME_WAY:
        return
    places = tracks[0].position[moment, :2], tracks[1].position[moment, :2]
    middle = 0.5 * (places[0] + places[1])
    separation = places[0] - places[1]
    yield StancePassing(moment, foot, stance, swing, separation, forward / size, middle)


def swing_around(stances: list[StanceEpochs], epoch: int) -> tuple[int, int] | None:
    """Return the epochs that bound the swing in which ``epoch`` lies, None within a stance."""
    after = bisect_right(stances, epoch, key=lambda stance: stance.first)
    if not 0 < after < len(stances) or stances[after - 1].last >= epoch:
        return None
    return stances[after - 1].last, stances[after].first


def _direction(track: FootTrajectory, begin: int, end: int) -> FloatArray | None:
    """Return the (2,) unit vector from one footprint to the next, None for a short swing."""
    way: FloatArray = (track.position[end] - track.position[begin])[:2]
    length = math.sqrt(way @ way)
    return None if length < LEAST_SWING_M else way / length
