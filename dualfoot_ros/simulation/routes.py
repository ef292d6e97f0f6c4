"""Routes: the line on the floor along which the walker's middle goes, from straights to stairs.

A route is a chain of pieces of constant curvature, so that the point, the heading and the floor at
any progress (metres along the line) are closed forms.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..core import FloatArray, SimulationError


@dataclass(frozen=True)
class Piece:
    """A straight (turn 0), an arc (turn in rad, left positive), or a flight of stairs.

    ``treads`` above 0 makes it a flight: each tread is ``length / treads`` deep and ``rise /
    treads`` above the one before.
    """

    length: float
    turn: float = 0.0
    rise: float = 0.0
    treads: int = 0


@dataclass(frozen=True)
class Route:
    """A chain of pieces that starts at the origin along x, with vectorised geometry."""

    pieces: tuple[Piece, ...]
    closed: bool = False

    @cached_property
    def length(self) -> float:
        """Length of the line in metres."""
        return float(self._starts[-1, 0])

    def heading(self, progress: FloatArray) -> FloatArray:
        """Return the (N,) heading in rad, not wrapped, at ``progress`` (N,) m."""
        piece, inside = self._locate(progress)
        heading: FloatArray = self._starts[piece, 3] + self._curvature[piece] * inside
        return heading

    def point(self, progress: FloatArray, lateral: FloatArray) -> FloatArray:
        """Return the (N, 2) point in m, ``lateral`` (N,) m to the left of the line."""
        piece, inside = self._locate(progress)
        start = self._starts[piece]
        half = 0.5 * self._curvature[piece] * inside
        chord = inside * np.sinc(half / np.pi)
        heading = start[:, 3] + 2.0 * half
        along = start[:, 3] + half
        return np.column_stack(
            [
                start[:, 1] + chord * np.cos(along) - lateral * np.sin(heading),
                start[:, 2] + chord * np.sin(along) + lateral * np.cos(heading),
            ]
        )

    def floor(self, progress: FloatArray) -> FloatArray:
        """Return the (N,) height of the floor in m on which a foot placed there stands."""
        piece, inside = self._locate(progress)
        treads = np.array([p.treads for p in self.pieces], dtype=float)[piece]
        length = np.array([max(p.length, 1e-9) for p in self.pieces])[piece]
        rise = np.array([p.rise for p in self.pieces])[piece]
        tread = np.clip(np.round(inside / length * treads), 0, treads)
        height: FloatArray = self._starts[piece, 4] + rise * tread / np.maximum(treads, 1)
        return height

    def repeated(self, laps: int) -> Route:
        """Return the route walked ``laps`` times; only a closed one can be.

        Raises
        ------
        SimulationError
            When an open route is to be repeated.
        """
        if laps > 1 and not self.closed:
            raise SimulationError(f"laps is {laps}, but the route is open; allowed is 1")
        return Route(self.pieces * laps, self.closed)

    def _locate(self, progress: FloatArray) -> tuple[np.ndarray, FloatArray]:
        progress = np.asarray(progress, dtype=float)
        piece = np.searchsorted(self._starts[1:-1, 0], progress, side="right")
        return piece, progress - self._starts[piece, 0]

    @cached_property
    def _curvature(self) -> FloatArray:
        return np.array([p.turn / p.length if p.length > 0 else 0.0 for p in self.pieces])

    @cached_property
    def _starts(self) -> FloatArray:
        """Progress, x, y, heading, height at the start of each piece and at the end."""
        rows = [(0.0, 0.0, 0.0, 0.0, 0.0)]
        for piece in self.pieces:
            progress, x, y, heading, height = rows[-1]
            chord = piece.length * float(np.sinc(0.5 * piece.turn / np.pi))
            along = heading + 0.5 * piece.turn
            x, y = x + chord * math.cos(along), y + chord * math.sin(along)
            rows.append((progress + piece.length, x, y, heading + piece.turn, height + piece.rise))
        return np.array(rows)


def straight(length: float) -> Piece:
    """Return a straight of ``length`` m."""
    return Piece(length)


def arc(radius: float, degrees: float) -> Piece:
    """Return an arc of ``radius`` m that turns by ``degrees`` (left positive)."""
    turn = math.radians(degrees)
    return Piece(radius * abs(turn), turn)


def stairs(treads: int, riser: float, going: float = 0.30) -> Piece:
    """Return a flight of ``treads`` steps, each ``riser`` m up (or down) and ``going`` m deep."""
    return Piece(treads * going, rise=treads * riser, treads=treads)


def _rectangle() -> Route:
    corner = arc(0.8, 90.0)
    return Route((straight(16.4), corner, straight(8.4), corner) * 2, closed=True)


def _track() -> Route:
    bend = arc(36.80, 180.0)
    side = straight(0.5 * (400.0 - 2.0 * bend.length))
    return Route((side, bend, side, bend), closed=True)


def _city() -> Route:
    corners = (70, -75, 30, -60, 85, -20, -80, 55, -35)
    blocks = (120.0, 85.0, 140.0, 60.0, 150.0, 95.0, 130.0, 110.0, 90.0)
    pieces = [p for b, c in zip(blocks, corners, strict=True) for p in (straight(b), arc(2.0, c))]
    rest = 1100.0 - sum(p.length for p in pieces)
    return Route((*pieces, straight(rest)))


def _stairs() -> Route:
    return Route(
        (
            straight(8.0),
            stairs(12, 0.17),
            straight(1.5),
            arc(0.7, 180.0),
            straight(0.5),
            stairs(10, 0.17),
            straight(6.0),
            arc(1.0, -90.0),
            straight(4.0),
            stairs(8, -0.17),
            straight(5.0),
        )
    )


@dataclass(frozen=True)
class RouteKind:
    """A named route: a function that builds it, and its description."""

    build: Callable[[], Route]
    description: str


ROUTES: dict[str, RouteKind] = {
    "straight": RouteKind(lambda: Route((straight(60.0),)), "60 m straight ahead"),
    "L": RouteKind(
        lambda: Route((straight(30.0), arc(1.0, 90.0), straight(20.0))),
        "30 m, a left turn, 20 m",
    ),
    "rectangle": RouteKind(_rectangle, "18 m x 10 m, counter-clockwise, ends where it starts"),
    "figure_eight": RouteKind(
        lambda: Route((arc(5.0, 360.0), arc(5.0, -360.0)), closed=True),
        "a left and a right circle of 5 m radius, ends where it starts",
    ),
    "track": RouteKind(_track, "one lap of a 400 m running track, counter-clockwise"),
    "city": RouteKind(_city, "1100 m through streets, open: no loop, no turning round"),
    "stairs": RouteKind(_stairs, "two flights up with a half-turn landing, one flight down"),
    "standing": RouteKind(lambda: Route((straight(0.0),)), "no step at all"),
}


def route(name: str, laps: int = 1) -> Route:
    """Return the route of that name, repeated ``laps`` times.

    Raises
    ------
    SimulationError
        When there is no such route, or an open one is to be repeated.
    """
    if name not in ROUTES:
        raise SimulationError(f"route is '{name}'; allowed is one of {', '.join(ROUTES)}")
    return ROUTES[name].build().repeated(laps)
