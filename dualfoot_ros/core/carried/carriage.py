"""What carries the person, if anything does: found, followed, and said in events."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from ..constraints.method import Request
from ..gait_history import GaitHistory
from ..groups import FloorConfig
from ..joint_estimate import Outcome, Touchdown
from ..kernel import Workspace
from ..kernel import layout as lay
from ..results.events import Event, EventKind
from ..results.payloads import FloorKind, Reason, Ride
from ..roll_back import RollBack
from ..samples.series import FloatArray
from .boarding import Boarding, Step
from .ground import Ground
from .probability import nis_gate
from .standing_ride import StandingRide

WALKWAY_STD = 0.08  # m/s, of a floor whose velocity both feet have told
INCLINE = 0.3  # half the climb of an escalator, which may be none, over its horizontal velocity
REST = 0.5  # share of the velocity of a floor below which stepping off leads to one at rest
USUAL_S = 90.0  # after which the end of a walkway may have been missed


class Carriage:
    """Looks for moving floors and changes the filter's frame to theirs."""

    def __init__(
        self, config: FloorConfig, space: Workspace, gait: GaitHistory, roll_back: RollBack
    ) -> None:
        """Start with a floor at rest."""
        self._space, self._gait, self._roll_back = space, gait, roll_back
        self._ground = Ground(space)
        self._boarding = Boarding(space, gait)
        self.retune(config)
        self._ride = StandingRide(space, self._ground)
        self.kind: FloorKind | None = None
        self._began_ns = 0

    def retune(self, config: FloorConfig) -> None:
        """Go on with another gate."""
        self.watches = config.watch
        self._boarding.gate = nis_gate(config.landing_gate, 3)

    def window(self) -> list[Event]:
        """Attend to a window of both standing feet that the kernel has noticed."""
        gained, seconds, alike = self._ride.window()
        if self.kind is FloorKind.WALKWAY:
            self._doubt()
            return []
        now = self._gait.stamp(self._space.epoch)
        if self.kind is None:
            if not alike or not self._ride.begins(gained, seconds):
                return []
            self.kind = self._ride.kind
            self._began_ns = now - round(self._ground.seconds * 1e9)
            self._fix()
            return [self._event(self._began_ns, now)]
        goes_on = self._ride.goes_on(gained, seconds, alike=alike)
        self._fix()
        return [] if goes_on else [self._end(now)]

    def expects(self, nis: float) -> bool:
        """Return whether a landing of this NIS, as of a floor at rest, is nothing to look at."""
        return self.kind is None and self._boarding.is_usual(nis)

    def landed(self, foot: int, touchdown: Touchdown, *, heading_known: bool) -> list[Event]:
        """Attend to a stance of ``foot`` that has been confirmed."""
        if self.kind is FloorKind.LIFT or self.kind is FloorKind.VEHICLE:
            if self._ride.landed():
                return []
            self._fix()
            return [self._end(self._gait.stamp(self._space.epoch))]
        if not heading_known:  # the axes of the feet are not the same
            return []
        step = self._boarding.landed(foot, touchdown)
        self._doubt()
        if step is not None:
            return [self._change(step, self._gait.stamp(self._space.epoch))]
        if self.kind is FloorKind.WALKWAY and self._boarding.contradicts(self._ground.velocity):
            return [self._take_back(self._gait.stamp(self._space.epoch))]
        return []

    def constrained(self, outcome: Outcome) -> None:
        """Take note of a constraint; one that does not fit moves the feet as a floor would."""
        if outcome.reason is Reason.DID_NOT_FIT:
            self._boarding.mistrust()

    def interrupted(self) -> None:
        """Take note that samples of a foot are missing: what the floor does now is unknown."""
        self._boarding.forget()
        if self.kind is not None:
            self._take_any_velocity()

    def _fix(self) -> None:
        """Allow no roll-back to before a change of the floor that was made at once."""
        self._roll_back.forget()
        self._space.forget()

    def _change(self, step: Step, now: int) -> Event:
        """Go over to the floor on which both feet have stepped, from the first landing on."""
        velocity = self._ground.velocity + step.velocity
        before = self._ground.velocity
        size = math.sqrt(float(velocity @ velocity))
        over = size < REST * math.sqrt(float(before @ before))
        ride = self._walkway(before if over else velocity, over=over)
        by = (np.zeros(3) if over else np.array(ride.velocity)) - before
        if self._gait.remembers(step.epoch - 1):
            apply = partial(self._ground.change, by=by, ride=ride)
            self._roll_back.apply([Request(step.epoch - 1, True, apply)])
        else:
            # both feet have been at rest on the new floor since, so that their velocities are
            # against it already
            apply = partial(self._ground.change, by=np.zeros(3), ride=ride)
            self._roll_back.apply([Request(self._space.epoch, False, apply)])
            self._fix()
        self.kind = None if over else FloorKind.WALKWAY
        self._began_ns = step.stamp_ns
        return Event(EventKind.CARRIED, step.stamp_ns, "both", now, step.velocity, payload=ride)

    def _take_back(self, now: int) -> Event:
        """Let the floor be at rest: landings on it have told that it is none.

        The feet have been at rest against the world since, and what they were moved is unknown.
        """
        ride = self._walkway(self._ground.velocity, over=True)
        moved = math.hypot(*ride.velocity) * self._ground.seconds
        self._ground.blur(lay.E_POS, moved, 0.0)
        apply = partial(self._ground.change, by=np.zeros(3), ride=ride)
        self._roll_back.apply([Request(self._space.epoch, False, apply)])
        self._fix()
        self.kind = None
        self._boarding.mistrust()
        return Event(EventKind.CARRIED, now, "both", now, payload=ride)

    def _walkway(self, velocity: FloatArray, *, over: bool) -> Ride:
        x, y = float(velocity[0]), float(velocity[1])
        up = WALKWAY_STD + INCLINE * math.hypot(x, y)
        seconds = self._ground.seconds if over else 0.0
        return Ride(FloorKind.WALKWAY, (x, y, 0.0), WALKWAY_STD, up, seconds, over)

    def _doubt(self) -> None:
        """Take any velocity up to that of the floor for possible when it carries for too long."""
        if self.kind is FloorKind.WALKWAY and self._ground.seconds > USUAL_S:
            self._take_any_velocity()

    def _take_any_velocity(self) -> None:
        """Let the floor be at rest as likely as in motion."""
        velocity, ride = self._ground.velocity, self._ground.ride(FloorKind.WALKWAY)
        size = math.sqrt(float(velocity @ velocity))
        level = 0.0 if self.kind is FloorKind.LIFT else size
        self._ground.move(velocity, max(ride.std, level), max(ride.up_std, size))
        self._fix()

    def _end(self, now: int) -> Event:
        """Say that the ride is over, and let the floor be at rest."""
        assert self.kind is not None
        ride = self._ground.ride(self.kind, over=True)._replace(velocity=self._ride.mean_velocity)
        self._ground.rest()
        self._ride.forget()
        self._boarding.forget()
        self.kind = None
        return Event(EventKind.CARRIED, now, "both", now, payload=ride)

    def _event(self, stamp: int, now: int) -> Event:
        assert self.kind is not None
        return Event(EventKind.CARRIED, stamp, "both", now, payload=self._ground.ride(self.kind))
