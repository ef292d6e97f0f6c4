"""Heading is a gauge: nothing before the first stride fixes it, so each foot is turned once.

Ma and Särkkä 2023, IV-B, take the direction of the first stride; the left foot's first step is
short and changes width, so here it is the way from stance 1 to stance 3.  Turning a track is
exact: nominal states, covariance and every snapshot turn with it, and an event tells the rest.
"""

from __future__ import annotations

import math

import numpy as np

from .config import Heading
from .kernel import Engine
from .kernel import layout as at
from .series import FloatArray
from .trajectory import FEET, Event, EventKind
from .workspace import Workspace

LEAST_WAY = 0.5  # m; a shorter way has no direction


class FirstStrides:
    """Collects one foot's stance positions until they give a direction."""

    def __init__(self, config: Heading) -> None:
        """Use ``config.from_stance`` and ``config.to_stance`` (stance 0 is the stand)."""
        self._config = config
        self._stances: list[FloatArray] = []

    @property
    def pivot(self) -> FloatArray:
        """Where the foot stood first (3,), m; undefined before the first stance."""
        return self._stances[0].copy()

    def add(self, position: FloatArray) -> float | None:
        """Take the position (3,) m of the next stance; return the direction when it is known.

        A foot that has hardly moved (steps on the spot) waits for later stances.
        """
        self._stances.append(position)
        if len(self._stances) <= self._config.to_stance:
            return None
        way = position - self._stances[self._config.from_stance]
        if math.hypot(way[0], way[1]) < LEAST_WAY:
            return None
        return math.atan2(way[1], way[0])


class Headings:
    """Both feet's headings: fixed by the first strides, then followed from stance to stance."""

    def __init__(self, config: Heading, space: Workspace) -> None:
        """Start with neither foot's heading known, unless the sensors are taken as they are."""
        self._space = space
        as_is = config.source == "sensor"
        self._strides = [None if as_is else FirstStrides(config) for _ in FEET]
        self._offsets = [0.0, 0.0]  # yaw of the sensor when the foot points forward
        self.forward = config.given
        self.feet = (config.given, config.given)

    @property
    def known(self) -> bool:
        """Whether both feet know their heading."""
        return self._strides[0] is None and self._strides[1] is None

    @property
    def mean(self) -> float:
        """Direction the person faces: the circular mean of the feet, rad."""
        return mean_angle(*self.feet)

    def face(self, yaw: float) -> None:
        """Take ``yaw`` (rad) as forward, before the first step."""
        self.forward, self.feet = yaw, (yaw, yaw)

    def stance(self, engine: Engine, foot: int, stamp: int, walking: bool) -> list[Event]:
        """Attend to a new stance of ``foot``: turn it if that fixes its heading, or follow it."""
        strides = self._strides[foot]
        if strides is None:
            if walking:
                heading = self._sensor_yaw(foot) - self._offsets[foot]
                self.feet = (heading, self.feet[1]) if foot == 0 else (self.feet[0], heading)
            return []
        start = foot * at.FOOT + at.POS
        direction = strides.add(self._space.w[start : start + 3].copy())
        if direction is None:
            return []
        self._strides[foot] = None
        turned = turn(
            self._space, engine, foot, self.forward - direction, strides.pivot, np.zeros(3), stamp
        )
        self._offsets[foot] = self._sensor_yaw(foot) - self.forward
        return [turned]

    def set_pose(
        self, engine: Engine, position: FloatArray, yaw: float, stamp: int
    ) -> list[Event]:
        """Move and turn both tracks so that the person is at ``position`` (3,) facing ``yaw``."""
        w = self._space.w
        middle = 0.5 * (w[at.POS : at.POS + 3] + w[at.FOOT + at.POS : at.FOOT + at.POS + 3])
        by, shift = yaw - self.mean, position - middle
        self.feet = (self.feet[0] + by, self.feet[1] + by)
        return [turn(self._space, engine, f, by, middle, shift, stamp) for f in range(2)]

    def _sensor_yaw(self, foot: int) -> float:
        w, rotation = self._space.w, foot * at.FOOT + at.ROT
        return math.atan2(w[rotation + 3], w[rotation])


def turn(
    space: Workspace,
    engine: Engine,
    foot: int,
    yaw: float,
    pivot: FloatArray,
    shift: FloatArray,
    stamp: int,
) -> Event:
    """Turn a foot's state and snapshots by ``yaw`` about ``pivot`` (3,), then ``shift`` (3,)."""
    c, s = math.cos(yaw), math.sin(yaw)
    for start in space.states():
        engine.turn(space.w, start, foot, c, s, pivot, shift)
    detail = {
        "yaw": yaw,
        "pivot": (float(pivot[0]), float(pivot[1]), 0.0),
        "shift": tuple(float(v) for v in shift),
    }
    return Event(EventKind.HEADING, stamp, FEET[foot], stamp, detail=detail)


def mean_angle(a: float, b: float) -> float:
    """Return the circular mean of two angles, rad (eq. (7) of Ma and Särkkä 2023)."""
    return math.atan2(math.sin(a) + math.sin(b), math.cos(a) + math.cos(b))
