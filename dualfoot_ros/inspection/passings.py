"""The moments at which one foot passes the other, in tracks that nothing ties together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core import FEET, EventKind, FloatArray, FootTrajectory, IntArray, Trajectory

LONGEST_STANCE_S = 1.2  # a longer stance is no step
LEAST_SWING_M = 0.3  # a shorter swing has no direction
SHARE = 0.5  # of the stance, when the other foot goes by


class Stance(NamedTuple):
    """First and last epoch of a stance, as the constraint methods see it."""

    first: int
    last: int


@dataclass(frozen=True)
class Passing:
    """One foot stands, the other swings by.

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
    stance: Stance
    swing: tuple[int, int]
    separation: FloatArray
    forward: FloatArray
    middle: FloatArray

    @property
    def left(self) -> FloatArray:
        """Return the (2,) unit vector to the left of the walk."""
        return np.array([-self.forward[1], self.forward[0]])


def passings_of(trajectory: Trajectory) -> list[Passing]:
    """Return the passings of a walk in order; ``trajectory`` is best of method ``zupt``."""
    stances = [stances_of_foot(trajectory, foot) for foot in FEET]
    tracks = (trajectory.left, trajectory.right)
    stamps = trajectory.left.stamp_ns
    longest = LONGEST_STANCE_S * 1e9
    found = [
        passing
        for foot in range(2)
        for number, stance in enumerate(stances[foot])
        if stamps[stance.last] - stamps[stance.first] <= longest
        for passing in _passing(tracks, stances, foot, number)
    ]
    return sorted(found, key=lambda p: p.epoch)


def stances_of_foot(trajectory: Trajectory, foot: str) -> list[Stance]:
    """Return the stances of a foot that have ended, from the events of the tracker."""
    kinds = (EventKind.STANCE_START, EventKind.STANCE_END)
    events = [e for e in trajectory.events if e.foot == foot and e.kind in kinds]
    events.sort(key=lambda e: (e.stamp_ns, e.kind is EventKind.STANCE_END))
    stamps: IntArray = trajectory.left.stamp_ns
    found, first = [], None
    for event in events:
        at = int(np.clip(np.searchsorted(stamps, event.stamp_ns), 0, len(stamps) - 1))
        if event.kind is EventKind.STANCE_START:
            first = at
        elif first is not None and at > first:
            found.append(Stance(first, at))
            first = None
    return found


def _passing(
    tracks: tuple[FootTrajectory, FootTrajectory],
    stances: list[list[Stance]],
    foot: int,
    number: int,
) -> Iterator[Passing]:
    """Yield the passing within one stance of ``foot``, if the other foot went by."""
    stance = stances[foot][number]
    moment = round((1.0 - SHARE) * stance.first + SHARE * stance.last)
    swing = swing_around(stances[1 - foot], moment)
    if swing is None:
        return
    way = _direction(tracks[1 - foot], *swing)
    if way is None:
        return
    ways = [way]
    if 0 < number < len(stances[foot]) - 1:
        before, after = stances[foot][number - 1], stances[foot][number + 1]
        own = _direction(tracks[foot], before.last, after.first)
        ways += [] if own is None else [own]
    forward = np.mean(ways, axis=0)
    size = float(np.linalg.norm(forward))
    if size < 0.5:  # the feet went opposite ways
        return
    places = tracks[0].position[moment, :2], tracks[1].position[moment, :2]
    middle = 0.5 * (places[0] + places[1])
    yield Passing(moment, foot, stance, swing, places[0] - places[1], forward / size, middle)


def swing_around(stances: list[Stance], epoch: int) -> tuple[int, int] | None:
    """Return the epochs that bound the swing in which ``epoch`` lies, None within a stance."""
    after = int(np.searchsorted([s.first for s in stances], epoch, side="right"))
    if not 0 < after < len(stances) or stances[after - 1].last >= epoch:
        return None
    return stances[after - 1].last, stances[after].first


def _direction(track: FootTrajectory, begin: int, end: int) -> FloatArray | None:
    way: FloatArray = (track.position[end] - track.position[begin])[:2]
    length = float(np.linalg.norm(way))
    return None if length < LEAST_SWING_M else way / length
