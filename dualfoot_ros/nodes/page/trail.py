"""Places along a walk in bounded memory: the longer the walk, the farther apart they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from ...core import FloatArray, YawTurn


class Place(NamedTuple):
    """A place (m) and the time (s) at which it was passed."""

    t: float
    x: float
    y: float
    z: float

    @property
    def is_finite(self) -> bool:
        """Whether every number is one that can be drawn."""
        return all(map(math.isfinite, self))


Separation = Callable[[Place, Place], float]


def metres(before: Place, now: Place) -> float:
    """Return the distance between two places, m."""
    return math.dist(before[1:], now[1:])


def seconds(before: Place, now: Place) -> float:
    """Return the time between two places, s."""
    return now.t - before.t


class Trail:
    """Places of a walk, at least ``spacing`` apart by ``separation``, at most ``capacity``.

    A full trail drops every second place and doubles its spacing.  ``edition`` is another number
    whenever places that were there have changed; else new ones have only been added at the end.
    ``length`` is the sum of all separations, of places that were dropped too.
    """

    def __init__(self, capacity: int, spacing: float, separation: Separation = metres) -> None:
        self._capacity, self._least, self._separation = capacity, spacing, separation
        self.edition = 0
        self.clear()

    def clear(self) -> None:
        """Forget every place."""
        self.places: list[Place] = []
        self._spacing, self.length = self._least, 0.0
        self.edition += 1

    def add(self, place: Place) -> None:
        """Take a place, unless it is too near to the one before, or cannot be drawn."""
        if not place.is_finite:
            return
        if self.places:
            gone = self._separation(self.places[-1], place)
            if gone < self._spacing:
                return
            self.length += gone
        self.places.append(place)
        if len(self.places) > self._capacity:
            self._thin()

    def _thin(self) -> None:
        self.places = self.places[::2]
        self._spacing = 2.0 * self._spacing
        self.edition += 1

    def seed(self, places: Iterable[Place]) -> None:
        """Begin with places that were passed before; those that are there already go behind."""
        known = self.places
        self.clear()
        for place in places:
            if not known or place.t < known[0].t:
                self.add(place)
        for place in known:
            self.add(place)

    def turn(self, turn: YawTurn) -> None:
        """Turn and move every place as a heading event says."""
        if self.places:
            moved = turn.positions(self._positions())
            self.places = [
                Place(place.t, *position)
                for place, position in zip(self.places, moved.tolist(), strict=True)
            ]
            self.edition += 1

    def _positions(self) -> FloatArray:
        return np.array([place[1:] for place in self.places])
