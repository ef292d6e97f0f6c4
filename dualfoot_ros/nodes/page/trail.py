"""Places along a walk in bounded memory: the longer the walk, the farther apart they are."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...core import FloatArray, YawTurn

TURNS = 20  # that are remembered for places whose messages come late


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

    A place is turned by every turn that was announced after it was published, in whatever order
    the messages come.
    """

    def __init__(self, capacity: int, spacing: float, separation: Separation = metres) -> None:
        self._capacity, self._least, self._separation = capacity, spacing, separation
        self._turns: deque[tuple[float, YawTurn | None]] = deque(maxlen=TURNS)
        self.edition = 0
        self.clear()

    def clear(self) -> None:
        """Forget every place and every turn: another walk begins."""
        self._turns.clear()
        self._forget()

    def _forget(self) -> None:
        self.places: list[Place] = []
        self._published: list[float] = []
        self._spacing, self.length = self._least, 0.0
        self.edition += 1

    def add(self, place: Place, published: float | None = None) -> None:
        """Take a place that was published at ``published`` (default: when it was passed), s.

        One too near to the one before is left out, and so is one that cannot be drawn.
        """
        at = place.t if published is None else published
        turned = self._turn_late(place, at)
        if turned is not None and turned.is_finite:
            self._append(turned, at)

    def _turn_late(self, place: Place, published: float) -> Place | None:
        """Return a place after the turns that were announced since; None: it is dropped."""
        for announced, turn in self._turns:
            if published < announced:
                if turn is None:
                    return None
                (place,) = _turned([place], turn)
        return place

    def _append(self, place: Place, published: float) -> None:
        if self.places:
            gone = self._separation(self.places[-1], place)
            if gone < self._spacing:
                return
            self.length += gone
        self.places.append(place)
        self._published.append(published)
        if len(self.places) > self._capacity:
            self._thin()

    def _thin(self) -> None:
        self.places, self._published = self.places[::2], self._published[::2]
        self._spacing = 2.0 * self._spacing
        self.edition += 1

    def seed(self, places: Iterable[Place], published: float) -> None:
        """Begin with places that were passed before; those that are there already go behind."""
        known = list(zip(self.places, self._published, strict=True))
        self._forget()
        for place in places:
            if not known or place.t < known[0][0].t:
                self.add(place, published)
        for place, at in known:
            self._append(place, at)

    def turn(self, announced: float, turn: YawTurn | None) -> None:
        """Turn what was published before ``announced`` (s) as a heading event says.

        Without a turn it is dropped.
        """
        self._turns.append((announced, turn))
        before = [at < announced for at in self._published]
        if not any(before):
            return
        if turn is None:
            self.places = [p for p, old in zip(self.places, before, strict=True) if not old]
            self._published = [at for at in self._published if at >= announced]
            self.length = sum(self._separation(*pair) for pair in pairwise(self.places))
        else:
            turned = _turned(self.places, turn)
            pairs = zip(before, turned, self.places, strict=True)
            self.places = [new if old else place for old, new, place in pairs]
        self.edition += 1


def _turned(places: Sequence[Place], turn: YawTurn) -> list[Place]:
    positions: FloatArray = np.array([place[1:] for place in places])
    moved = turn.positions(positions).tolist()
    return [Place(place.t, *position) for place, position in zip(places, moved, strict=True)]
