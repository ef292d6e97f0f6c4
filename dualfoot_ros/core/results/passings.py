"""The moments at which one foot passes the other, in the tracks of a whole walk.

One foot stands and the other swings by.  There are two moments to choose from:

- the middle of a *swing* (:func:`swing_passings`), from the stances alone, so that it is the same
  moment for every method: for figures that compare methods;
- the middle of a *stance* (:func:`stance_passings`), from the events of the tracker, at which the
  constraint methods expect the feet side by side: for estimates from two unconstrained tracks.

Swings of less than 0.3 m (shuffling, turning on the spot) have no direction and do not count.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..samples.by_block import picked
from ..samples.series import BoolArray, FloatArray, IntArray
from .events import FEET, EventKind
from .trajectory import Trajectory, stance_bounds

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
    passings = [each for foot in range(2) for each in _passings(trajectory, stances, foot)]
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


def _passings(
    trajectory: Trajectory, stances: list[list[StanceEpochs]], foot: int
) -> Iterator[StancePassing]:
    """Yield the passings within the stances of ``foot``, at which the other foot went by."""
    tracks = trajectory.left.position, trajectory.right.position
    own, other = (
        np.reshape(np.array(stances[f], dtype=np.int64), (-1, 2)) for f in (foot, 1 - foot)
    )
    moments = np.rint(own @ [1.0 - MID_STANCE, MID_STANCE]).astype(np.int64)
    number, swing = _swings_at(other, moments)
    begin_ns, end_ns = trajectory.left.stamp_ns[own[number].T]
    step = end_ns - begin_ns <= LONGEST_STANCE_S * 1e9
    number, swing = number[step], swing[step]
    forward = _forward(tracks[foot], own, number, _directions(tracks[1 - foot], swing))
    known = ~np.isnan(forward[:, 0])
    number, swing, forward = number[known], swing[known], forward[known]
    places = [picked(track, moments[number])[:, :2] for track in tracks]
    middle, separation = 0.5 * (places[0] + places[1]), places[0] - places[1]
    plain = zip(number.tolist(), moments[number].tolist(), swing.tolist(), strict=True)
    for k, (stance, at, (last, first)) in enumerate(plain):
        epochs = stances[foot][stance]
        yield StancePassing(at, foot, epochs, (last, first), separation[k], forward[k], middle[k])


def _forward(
    position: FloatArray, stances: IntArray, number: IntArray, way: FloatArray
) -> FloatArray:
    """Return the mean direction (K, 2) of the feet's strides, nan where there is none.

    ``way`` (K, 2) is that of the foot that goes by; the other one stands, and so in the stance
    ``number`` (K,) of ``stances`` (M, 2).
    """
    inside = np.flatnonzero((number > 0) & (number < len(stances) - 1))
    around = np.column_stack([stances[number[inside] - 1, 1], stances[number[inside] + 1, 0]])
    both = (way[inside] + _directions(position, around)) / 2.0
    forward = way.copy()
    forward[inside] = np.where(np.isnan(both), way[inside], both)
    size = _sizes(forward)
    return forward / np.where(size < SAME_WAY, np.nan, size)[:, np.newaxis]


def _swings_at(stances: IntArray, epochs: IntArray) -> tuple[IntArray, IntArray]:
    """Return which of ``epochs`` (K,) lie between two of the stances (M, 2), and what bounds it.

    That is the last epoch of the stance before and the first of the one after.
    """
    after = np.searchsorted(stances[:, 0], epochs, side="right")
    within = np.flatnonzero((after > 0) & (after < len(stances)))
    after = after[within]
    swing = np.column_stack([stances[after - 1, 1], stances[after, 0]])
    apart = swing[:, 0] < epochs[within]
    return within[apart], swing[apart]


def _directions(position: FloatArray, swings: IntArray) -> FloatArray:
    """Return unit vectors (K, 2) from one footprint to the next, nan for a short swing."""
    last, first = swings.T
    way = (picked(position, first) - picked(position, last))[:, :2]
    size = _sizes(way)
    directions: FloatArray = way / np.where(size < LEAST_SWING_M, np.nan, size)[:, np.newaxis]
    return directions


def _sizes(vectors: FloatArray) -> FloatArray:
    """Return the lengths (K,) of vectors (K, 2)."""
    sizes: FloatArray = np.sqrt((vectors[:, np.newaxis] @ vectors[:, :, np.newaxis])[:, 0, 0])
    return sizes
