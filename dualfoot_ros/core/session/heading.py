"""Heading is a gauge: nothing before the first stride fixes it, so each foot is turned once.

Ma and Särkkä 2023, IV-B, take the direction of the first stride; the left foot's first step is
short and changes width, so here it is the way from stance 1 to stance 3.  Turning a track is
exact: nominal states, covariance and every snapshot turn with it, and an event tells the rest.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..groups import HeadingConfig
from ..kernel import Engine, Workspace
from ..kernel import layout as lay
from ..results.events import FEET, Event, EventKind
from ..results.facing import Facing
from ..results.payloads import YawTurn
from ..rotation import about_z, mean_angle, turn_between, turn_of_rows
from ..samples.series import FloatArray
from .initial_state import InitialState

BOTH_THERE = [False, False]  # neither foot is absent
LEAST_WAY = 0.5  # m; a shorter way has no direction
SCATTER_RATE = 0.03  # rad/s, of a foot's heading over two strides of a straight walk


class Direction(NamedTuple):
    """Where a foot went on its first strides.

    Attributes
    ----------
    angle : rad, of the way between the two stances
    turned : rad, by which the foot's heading turned from the one to the other
    seconds : between them
    stamp_ns : half-way between them
    rotation : (3, 3) R_nb in the second of them
    pivot : (3,) m, where the foot stood first
    """

    angle: float
    turned: float
    seconds: float
    stamp_ns: int
    rotation: FloatArray
    pivot: FloatArray


class FirstStrides:
    """Collects one foot's stances until they give a direction."""

    def __init__(self, config: HeadingConfig) -> None:
        """Use ``config.from_stance`` and ``config.to_stance`` (stance 0 is the stand)."""
        self._config = config
        self._stances: list[tuple[FloatArray, FloatArray, int]] = []

    def add(self, position: FloatArray, rotation: FloatArray, stamp_ns: int) -> Direction | None:
        """Take the next stance: position (3,) m, R_nb (3, 3); return the direction if known.

        A foot that has hardly moved (steps on the spot) waits for later stances.
        """
        self._stances.append((position, rotation, stamp_ns))
        if len(self._stances) <= self._config.to_stance:
            return None
        start, start_rotation, start_ns = self._stances[self._config.from_stance]
        way = position - start
        if math.hypot(way[0], way[1]) < LEAST_WAY:
            return None
        return Direction(
            math.atan2(way[1], way[0]),
            turn_between(start_rotation, rotation),
            (stamp_ns - start_ns) * 1e-9,
            start_ns + (stamp_ns - start_ns) // 2,
            rotation,
            self._stances[0][0],
        )


class Headings:
    """Both feet's headings: fixed by the first strides, then followed from stance to stance."""

    def __init__(self, config: HeadingConfig, space: Workspace, initial: InitialState) -> None:
        """Start with neither foot's heading known, unless the sensors are taken as they are."""
        self._space, self._initial = space, initial
        as_is = config.source == "sensor"
        self._strides = [None if as_is else FirstStrides(config) for _ in FEET]
        self._first: Direction | None = None  # of the foot that was turned first
        self._late: int | None = None
        self.absent = [False, False]  # feet whose heading is not followed now
        self.forward = config.given
        # a rotation of each sensor and the heading of the foot at that moment
        self._reference: list[tuple[FloatArray, float] | None] = [None, None]
        self._levelled = [self._rotation(foot) for foot in range(2)]
        self.feet = (config.given, config.given)

    @property
    def known(self) -> bool:
        """Whether both feet know their heading."""
        return self._strides[0] is None and self._strides[1] is None

    def knows_way(self, foot: int) -> bool:
        """Whether the heading of ``foot`` is fixed."""
        return self._strides[foot] is None

    @property
    def mean(self) -> float:
        """Direction the person faces: the circular mean of the feet that are there, rad."""
        left, right = self.feet if self.absent == BOTH_THERE else self.present
        return mean_angle(left, right)

    @property
    def present(self) -> tuple[float, float]:
        """Headings of both feet, rad; that of the other one for a foot that is absent."""
        left, right = self.feet
        if self.absent[0] and not self.absent[1]:
            return right, right
        return (left, left) if self.absent[1] and not self.absent[0] else (left, right)

    def knows(self, foot: int) -> bool:
        """Whether the heading of ``foot`` has been known, as how its sensor sits on the shoe."""
        return self._reference[foot] is not None

    def heading_with(self, foot: int, rotation: FloatArray) -> float:
        """Return the heading of ``foot`` when its sensor had ``rotation`` (3, 3), rad."""
        known = self._reference[foot]
        if known is None:
            return self.forward
        return known[1] + turn_between(known[0], rotation)

    def late(self, foot: int) -> None:
        """Take note that ``foot`` begins after the other: forward is then where that one heads."""
        self._late = foot

    def facing(self) -> Facing:
        """Return what the headings of both feet follow from until their next stance."""
        left = self._reference[0] or (self._levelled[0], self.forward)
        right = self._reference[1] or (self._levelled[1], self.forward)
        levers = (self._lever(0), self._lever(1))
        known = self.known or all(self.knows_way(foot) or self.absent[foot] for foot in range(2))
        return Facing((left[0], right[0]), (left[1], right[1]), levers, self.present, known)

    def _lever(self, foot: int) -> FloatArray:
        start = lever_start(foot)
        return self._space.w[start : start + 3].copy()

    def levelled(self) -> None:
        """Take note that both feet have been levelled: they face forward as they are."""
        self._levelled = [self._rotation(foot) for foot in range(2)]

    def face(self, yaw: float) -> None:
        """Take ``yaw`` (rad) as forward, before the first step."""
        self.forward, self.feet = yaw, (yaw, yaw)

    def stance(self, engine: Engine, foot: int, stamp: int, walking: bool) -> list[Event]:
        """Attend to a new stance of ``foot``: turn it if that fixes its heading, or follow it."""
        strides = self._strides[foot]
        if strides is None:
            if walking:
                self.follow(foot)
            return []
        start = foot * lay.FOOT + lay.POS
        position = self._space.w[start : start + 3].copy()
        direction = strides.add(position, self._rotation(foot), stamp)
        if direction is None:
            return []
        self._strides[foot] = None
        late = foot == self._late and self._reference[1 - foot] is not None
        heading = self.feet[1 - foot] if late else self._forward_at(direction)
        by = heading - direction.angle
        ahead = heading + 0.5 * direction.turned
        rotation = about_z(by) @ direction.rotation
        self._reference[foot] = (rotation, ahead)
        self._initial.aim(foot, rotation.T @ np.array([math.cos(ahead), math.sin(ahead), 0.0]))
        turned = turn(self._space, engine, foot, by, direction.pivot, np.zeros(3), stamp=stamp)
        self.follow(foot)
        return [turned]

    def follows(self, foot: int) -> bool:
        """Whether the heading of ``foot`` is followed from a reference of its sensor."""
        return self._strides[foot] is None and self._reference[foot] is not None

    def follow(self, foot: int) -> None:
        """Take the heading of ``foot`` from how its sensor has turned since the reference."""
        known = self._reference[foot]
        if known is None:
            known = self._reference[foot] = (self._rotation(foot), self.forward)
        start = foot * lay.FOOT + lay.ROT
        now = self._space.w[start : start + 6].tolist()
        heading = known[1] + turn_of_rows(known[0].ravel().tolist()[:6], now)
        self.feet = (heading, self.feet[1]) if foot == 0 else (self.feet[0], heading)

    def _forward_at(self, direction: Direction) -> float:
        """Return the heading of the walk when a foot went its ``direction``, rad.

        The foot that is first defines forward.  The other one went its way half a stride earlier
        or later, between which a walk that starts in a curve turns by several degrees.  A turn
        that may be no more than the scatter of the footprints counts for little.
        """
        if self._first is None:
            self._first = direction
            return self.forward
        both = (self._first, direction)
        rate = 0.5 * sum(one.turned / one.seconds for one in both)
        trust = rate**2 / (rate**2 + SCATTER_RATE**2)
        apart = (direction.stamp_ns - self._first.stamp_ns) * 1e-9
        return self.forward + trust * rate * apart

    def set_pose(
        self, engine: Engine, position: FloatArray, yaw: float, stamp: int
    ) -> list[Event]:
        """Move and turn both tracks so that the person is at ``position`` (3,) facing ``yaw``."""
        w = self._space.w
        middle = 0.5 * (w[lay.POS : lay.POS + 3] + w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3])
        by, shift = yaw - self.mean, position - middle
        self.feet = (self.feet[0] + by, self.feet[1] + by)
        for foot, known in enumerate(self._reference):
            if known is not None:
                self._reference[foot] = (about_z(by) @ known[0], known[1] + by)
        return [
            turn(self._space, engine, f, by, middle, shift, stamp=stamp, joint=True)
            for f in range(2)
        ]

    def _rotation(self, foot: int) -> FloatArray:
        start = foot * lay.FOOT + lay.ROT
        return self._space.w[start : start + 9].reshape(3, 3).copy()


def lever_start(foot: int) -> int:
    """Return where the lever arm of foot 0 or 1 starts in a workspace."""
    return lay.C_FOOT + foot * lay.C_STRIDE + lay.C_LEVER


def turn(
    space: Workspace,
    engine: Engine,
    foot: int,
    yaw: float,
    pivot: FloatArray,
    shift: FloatArray,
    *,
    stamp: int,
    joint: bool = False,
) -> Event:
    """Turn a foot's state and snapshots by ``yaw`` about ``pivot`` (3,), then ``shift`` (3,).

    ``joint`` says that the other foot turns with it.
    """
    c, s = math.cos(yaw), math.sin(yaw)
    for start in space.states():
        engine.turn(space.w, start, foot, c, s, pivot, shift)
    turned = YawTurn(
        yaw,
        (float(pivot[0]), float(pivot[1]), 0.0),
        (float(shift[0]), float(shift[1]), float(shift[2])),
        joint,
    )
    return Event(EventKind.HEADING, stamp, FEET[foot], stamp, payload=turned)
