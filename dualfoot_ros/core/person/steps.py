"""Steps as they are made: where each foot comes to stand, against the other and the person."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..kernel import layout as lay
from ..results.events import FEET, EventKind
from ..results.rows import matrices
from ..results.update import Update
from ..samples.series import FloatArray
from .person import SURE_S, PersonEstimate

LEAST_STEP_M = 0.1  # a foot that has moved less has not stepped
LONGEST_STEP_S = 3.0  # after a longer time there was a stand in between
GOOD_M = 0.1  # error of a length up to which it counts as right


class Step(NamedTuple):
    """One step: a foot has come to stand.

    Attributes
    ----------
    stamp_ns : when it came to stand; detected_ns, when that was sure
    side : "left" or "right"
    place : (3,) m, of its sensor
    length, width, height : m, from the other foot to this one: ahead, to its own side, up
    stride : m, level distance from where this foot stood before
    duration_s : since the step before; None after a stand
    turn : rad, of the person since the step before; None after a stand
    length_std : m, of the distance of the feet
    """

    stamp_ns: int
    detected_ns: int
    side: str
    place: FloatArray
    length: float
    width: float
    height: float
    stride: float
    duration_s: float | None
    turn: float | None
    length_std: float

    @property
    def confidence(self) -> float:
        """Probability that the length is right within 0.1 m, as far as the filter knows."""
        if self.length_std <= 0.0:
            return 1.0
        return math.erf(GOOD_M / (self.length_std * math.sqrt(2.0)))


class StepTracker:
    """Finds the steps in the updates of a tracker."""

    def __init__(self) -> None:
        """Start with nothing."""
        self.clear()

    def clear(self) -> None:
        """Forget everything: the track starts anew."""
        self._places: list[FloatArray | None] = [None, None]
        self._moving_ns = [0, 0]
        self._last: tuple[int, float] | None = None  # stamp and heading of the last step

    def add(self, update: Update, person: PersonEstimate) -> list[Step]:
        """Take an update and the person at it; return the steps that are sure by now."""
        assert update.row is not None
        parts = update.row[: 2 * lay.O_FOOT].reshape(2, lay.O_FOOT)
        self._apply_turns(update)
        found = [
            step
            for event in update.announced
            if event.kind is EventKind.STANCE_START and person.heading_known
            for step in self._step(FEET.index(event.foot), event.stamp_ns, update, person)
        ]
        for foot, part in enumerate(parts):
            if not part[lay.O_STANCE]:
                self._moving_ns[foot] = update.stamp_ns
            stood_s = (update.stamp_ns - self._moving_ns[foot]) * 1e-9
            if stood_s > SURE_S or self._places[foot] is None:
                self._places[foot] = part[:3].copy()
        return found

    def _apply_turns(self, update: Update) -> None:
        """Turn the places with the track; a step across a turn has no time and turn of its own."""
        for event in update.announced:
            if event.kind is EventKind.HEADING:
                foot = FEET.index(event.foot)
                place = self._places[foot]
                if place is not None:
                    self._places[foot] = event.turn.positions(place[None])[0]
                self._last = None

    def _step(
        self, foot: int, stamp_ns: int, update: Update, person: PersonEstimate
    ) -> list[Step]:
        """Return the step of ``foot``, unless it stands where it stood."""
        assert update.row is not None
        start = foot * lay.O_FOOT
        place, before, other = update.row[start : start + 3].copy(), *self._own_and_other(foot)
        if before is None or other is None or np.hypot(*(place - before)[:2]) < LEAST_STEP_M:
            return []
        c, s = math.cos(person.heading), math.sin(person.heading)
        x, y, height = (place - other).tolist()
        duration_s = turn = None
        if self._last is not None and (stamp_ns - self._last[0]) * 1e-9 < LONGEST_STEP_S:
            duration_s = (stamp_ns - self._last[0]) * 1e-9
            turn = person.heading - self._last[1]
        self._last = stamp_ns, person.heading
        self._places[foot], self._moving_ns[foot] = place, update.stamp_ns
        width = (c * y - s * x) * (1.0 if foot == 0 else -1.0)
        ahead = np.array([c, s, 0.0])
        apart = matrices(update.row[lay.O_RELATIVE : lay.O_RELATIVE + 9])
        std = math.sqrt(max(0.0, float(ahead @ apart @ ahead)))
        stride = float(np.hypot(*(place - before)[:2]))
        return [
            Step(
                stamp_ns,
                update.stamp_ns,
                FEET[foot],
                place,
                c * x + s * y,
                width,
                height,
                stride,
                duration_s,
                turn,
                std,
            )
        ]

    def _own_and_other(self, foot: int) -> tuple[FloatArray | None, FloatArray | None]:
        return self._places[foot], self._places[1 - foot]
