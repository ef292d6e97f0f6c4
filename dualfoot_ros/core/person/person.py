"""The person between the feet: on the floor, facing where both feet turn, with an honest sigma."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import numpy as np

from ..kernel import layout as lay
from ..results.events import FEET, EventKind
from ..results.facing import UNKNOWN_VARIANCE, Facing
from ..results.update import Update
from ..samples.series import FloatArray
from .swing_pattern import SwingPattern

RATE_SPAN_S = 0.5  # about a step; the yaw rate is the turn over so long
HEADING_STD = math.radians(1.5)  # of the person's heading against that of the feet, straight ahead
LEAD_S = 0.06  # by which the swinging foot turns ahead of the person, on average
LEAD_STD_S = 0.05  # by which that differs from turn to turn
FLOOR_STD = 0.02  # m, of the pivot of a standing foot above the floor
SURE_S = 0.1  # a foot that has stood for so long is on the floor
LONGEST_GAP_S = 1.0  # after a longer one nothing is remembered


class PersonEstimate(NamedTuple):
    """The person at one epoch, in the navigation frame (z up).

    Attributes
    ----------
    position : (3,) m, midway between the feet, on the floor
    velocity : (3,) m/s, with the ripple of the steps
    heading : rad, where the person faces, not wrapped; it moves while a foot swings
    yaw_rate : rad/s, over the last half second
    pose_covariance : (6, 6) of position (m) and rotation about fixed axes (rad)
    velocity_covariance : (3, 3), (m/s)^2
    yaw_rate_variance : (rad/s)^2
    heading_known : whether the first strides have been made
    """

    stamp_ns: int
    position: FloatArray
    velocity: FloatArray
    heading: float
    yaw_rate: float
    pose_covariance: FloatArray
    velocity_covariance: FloatArray
    yaw_rate_variance: float
    heading_known: bool


class PersonTracker:
    """Follows the person over the updates of a tracker.

    Attributes
    ----------
    swing_turn : rad, by which the mean heading of the feet in stance is ahead of the person's now
    """

    def __init__(self) -> None:
        """Start with nothing."""
        self.clear()

    def clear(self) -> None:
        """Forget everything: the track starts anew."""
        self._start_ns, self._last_ns = 0, 0
        self._facing: Facing | None = None
        self._floor: list[float | None] = [None, None]
        self._stands_since = [0.0, 0.0]
        self._forget_headings()

    def _forget_headings(self) -> None:
        """Forget what is known of headings: that of a foot has been turned."""
        self._feet: list[float | None] = [None, None]
        self._patterns = SwingPattern(), SwingPattern()
        self._turns: deque[tuple[float, float]] = deque()
        self.swing_turn = 0.0

    def add(self, update: Update) -> PersonEstimate | None:
        """Take an update; return the person, or None while the tracker is aligning."""
        if any(event.kind is EventKind.RESET for event in update.announced):
            self.clear()
        pedestrian = update.pedestrian()
        if pedestrian is None:
            return None
        time_s = self._advance(update)
        heading = self._heading(update, time_s)
        rate = self._rate(time_s, heading)
        heading -= LEAD_S * rate
        self.swing_turn = math.remainder(pedestrian.heading - heading, math.tau)
        known = update.facing.known
        covariance = pedestrian.pose_covariance.copy()
        model = HEADING_STD**2 + (LEAD_STD_S * rate) ** 2
        covariance[5, 5] = covariance[5, 5] + model if known else UNKNOWN_VARIANCE
        covariance[2, 2] += FLOOR_STD**2
        position = np.append(pedestrian.position[:2], self._floor_height(update, time_s))
        return PersonEstimate(
            update.stamp_ns,
            position,
            pedestrian.velocity,
            heading,
            rate,
            covariance,
            pedestrian.velocity_covariance,
            2.0 * model / RATE_SPAN_S**2,
            known,
        )

    def _advance(self, update: Update) -> float:
        """Return the time since the start, s; begin anew after a gap or when the track turned."""
        facing = update.facing
        gap_s = (update.stamp_ns - self._last_ns) * 1e-9
        turned = self._facing is not None and facing.known and not self._facing.known
        if self._facing is None or not 0.0 < gap_s < LONGEST_GAP_S:
            self.clear()
            self._start_ns = update.stamp_ns
        turns = {e.foot: e.turn for e in update.announced if e.kind is EventKind.HEADING}
        if turned or turns:
            self._forget_headings()
        for foot, turn in turns.items():
            height = self._floor[FEET.index(foot)]
            if height is not None:
                self._floor[FEET.index(foot)] = height + turn.shift[2]
        self._facing, self._last_ns = facing, update.stamp_ns
        return (update.stamp_ns - self._start_ns) * 1e-9

    def _heading(self, update: Update, time_s: float) -> float:
        """Return the mean heading of the feet, each without what its swing always does, rad."""
        assert update.row is not None
        total = 0.0
        for foot, wrapped in enumerate(update.foot_headings()):
            before = self._before(foot)
            heading = before + math.remainder(wrapped - before, math.tau)
            self._feet[foot] = heading
            stance = bool(update.row[foot * lay.O_FOOT + lay.O_STANCE])
            total += heading - self._patterns[foot].add(time_s, heading, stance)
        return 0.5 * total

    def _before(self, foot: int) -> float:
        """Return the heading next to which that of ``foot`` is taken, rad."""
        own, other = self._feet[foot], self._feet[1 - foot]
        return own if own is not None else (0.0 if other is None else other)

    def _rate(self, time_s: float, heading: float) -> float:
        """Return the yaw rate over the last half second, rad/s."""
        turns = self._turns
        turns.append((time_s, heading))
        while len(turns) > 2 and turns[1][0] <= time_s - RATE_SPAN_S:
            turns.popleft()
        passed = time_s - turns[0][0]
        return (heading - turns[0][1]) / passed if passed > 0.5 * RATE_SPAN_S else 0.0

    def _floor_height(self, update: Update, time_s: float) -> float:
        """Return the mean height of the pivots of both feet where they stand or last stood, m."""
        assert update.row is not None
        parts = update.row[: 2 * lay.O_FOOT].reshape(2, lay.O_FOOT)
        heights = []
        for foot, part in enumerate(parts):
            if not part[lay.O_STANCE]:
                self._stands_since[foot] = time_s
            if time_s - self._stands_since[foot] > SURE_S or self._floor[foot] is None:
                position, attitude = part[:3], part[lay.O_QUAT : lay.O_QUAT + 4]
                self._floor[foot] = update.facing.pivot_height(foot, position, attitude)
            heights.append(self._floor[foot] or 0.0)
        return 0.5 * (heights[0] + heights[1])
