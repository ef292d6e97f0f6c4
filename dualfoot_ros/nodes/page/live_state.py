"""State of a walk as the page shows it: trails, and what is true now."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ...core import YawTurn
from .trail import Place, Trail, seconds

PERSON, HEIGHT = "person", "height"
PLACES, PRINTS = 2000, 1500  # at most: of a line, of the footprints of one foot
SPACING_M, PERIOD_S = 0.2, 0.5  # of the line, of the heights
DIGITS = 3  # millimetres

Cursor = Mapping[str, tuple[int, int]]
"""What a reader has: edition and number of places of each trail."""


class LiveState:
    """What the page shows; one thread writes, any number read."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.trails = {
            PERSON: Trail(PLACES, SPACING_M),
            HEIGHT: Trail(PLACES, PERIOD_S, seconds),
            "left": Trail(PRINTS, 0.0),
            "right": Trail(PRINTS, 0.0),
        }
        self._now: dict[str, Any] = {}

    def show(self, **values: Any) -> None:
        """Set what is true now, by name: plain values for JSON."""
        with self._lock:
            self._now |= values

    def add(self, trails: Iterable[str], place: Place, published: float | None = None) -> None:
        """Add a place to each of the trails named; see :meth:`Trail.add`."""
        with self._lock:
            for name in trails:
                self.trails[name].add(place, published)

    def seed(self, trails: Iterable[str], places: Sequence[Place], published: float) -> None:
        """Put places that were passed before the page began in front of the trails named."""
        with self._lock:
            for name in trails:
                self.trails[name].seed(places, published)

    def turn(self, trails: Iterable[str], announced: float, turn: YawTurn | None) -> None:
        """Turn the trails named; see :meth:`Trail.turn`."""
        with self._lock:
            for name in trails:
                self.trails[name].turn(announced, turn)

    def clear(self) -> None:
        """Forget the walk."""
        with self._lock:
            for trail in self.trails.values():
                trail.clear()

    def message(self, cursor: Cursor) -> tuple[dict[str, Any], Cursor]:
        """Return what a reader who has ``cursor`` needs, and its cursor after it."""
        with self._lock:
            trails, after = {}, {}
            for name, trail in self.trails.items():
                edition, count = cursor.get(name, (-1, 0))
                first = count if edition == trail.edition else 0
                after[name] = trail.edition, len(trail.places)
                new = trail.places[first:]
                if new or edition != trail.edition:
                    trails[name] = {"first": first, "places": [_rounded(p) for p in new]}
            now = {**self._now, "walked": self.trails[PERSON].length}
            return {"now": now, "trails": trails}, after


def _rounded(place: Place) -> list[float]:
    return [round(value, DIGITS) for value in place]
