"""A lift or a vehicle: a floor that gains velocity while both feet stand on it.

A lift goes up or down, and what both feet gain is its velocity; when that has come back to zero
the ride is over.  What a vehicle gains is soon taken for a tilt, so its velocity stays unknown.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernel import Workspace
from ..kernel import layout as lay
from ..results.payloads import FloorKind
from ..samples.series import FloatArray
from .ground import Ground

LEAST_WINDOWS = {FloorKind.LIFT: 2, FloorKind.VEHICLE: 4}  # in a row
LEAST_VELOCITY = 0.15  # m/s, of a lift
LEFT, DRIFT = 0.2, 0.015  # m/s and m/s^2: what a lift may have left at its end
LEFT_SHARE = 0.4  # of its greatest velocity, that it has left at most
QUIET = 0.15  # m/s^2
QUIET_WINDOWS = 2
LIFT_STD = 0.05  # m/s
VEHICLE_STD, HILL_STD = 10.0, 1.0  # m/s, of which nothing is known
STEPS_AFTER = 6  # landings without a sign of motion: the person has got off


class StandingRide:
    """Follows what both standing feet gain, window by window."""

    def __init__(self, space: Workspace, ground: Ground) -> None:
        """Start with a floor at rest."""
        self._space, self._ground = space, ground
        self.kind: FloorKind | None = None
        self._run: list[tuple[FloatArray, float]] = []  # gained (3,) m/s, over how long, s
        self._last = -1  # epoch of the newest window that gained
        self._peak, self._quiet, self._landings = 0.0, 0, 0
        self._start_m = 0.0  # height of the left foot at the start
        self._biases = np.zeros((2, 3))  # of the accelerometers, before the floor moved
        self._rested = np.zeros(2)  # m/s^2, what both feet read upwards then

    def window(self) -> tuple[FloatArray, float, bool]:
        """Return what both feet gained (3,) m/s, over how long, and whether both gained alike."""
        w = self._space.w
        seconds = float(w[lay.F_SECONDS])
        gains = w[lay.F_SUM : lay.F_SUM + 6].reshape(2, 3).copy()
        w[lay.F_SECONDS] = 0.0
        gains[:, 2] -= seconds * self._rest()
        mean, apart = 0.5 * (gains[0] + gains[1]), gains[0] - gains[1]
        size = math.sqrt(float(mean @ mean))
        alike = math.sqrt(float(apart @ apart)) < 0.5 * size
        return mean, seconds, alike and size > QUIET * seconds

    def _rest(self) -> FloatArray:
        """Return what both feet (2,) read upwards at rest, m/s^2: before a ride, if there is one.

        Ahead, a vehicle may begin so slowly that this would be part of its start.
        """
        if self.kind is not None:
            return self._rested
        return self._space.w[lay.F_REST : lay.F_REST + 6].reshape(2, 3)[:, 2].copy()

    def begins(self, gained: FloatArray, seconds: float) -> bool:
        """Take a window in which both feet gained alike; return whether the floor moves now."""
        epoch, length = self._space.epoch, seconds * self._space.rate_hz
        if epoch - self._last > 1.5 * length or float(gained @ self._total()) <= 0.0:
            self._run.clear()
        if not self._run:
            self._keep_biases(epoch - round(length))
        self._last = epoch
        self._run.append((gained, seconds))
        total = self._total()
        upward = abs(float(total[2])) > math.hypot(float(total[0]), float(total[1]))
        kind = FloorKind.LIFT if upward else FloorKind.VEHICLE
        if len(self._run) < LEAST_WINDOWS[kind]:
            return False
        if upward and abs(float(total[2])) < LEAST_VELOCITY:
            return False
        self._begin(kind)
        return True

    def _keep_biases(self, epoch: int) -> None:
        """Keep the accelerometer biases of an epoch, or the oldest that is remembered."""
        space = self._space
        self._rested = self._rest()
        state = space.snapshot(max(epoch, space.oldest))
        self._biases = np.array([state[at : at + 3] for at in (lay.BA, lay.FOOT + lay.BA)])

    def _hold(self) -> None:
        """Hold both feet at rest on their floor, as a foot that seems to swing is not held.

        What a ride has taught the accelerometer biases is taken back: they do not know of it.
        """
        for foot, bias in enumerate(self._biases):
            start = foot * lay.FOOT
            self._space.w[start + lay.BA : start + lay.BA + 3] = bias
            self._space.w[start + lay.VEL : start + lay.VEL + 3] = 0.0

    def _total(self) -> FloatArray:
        return np.sum([gained for gained, _ in self._run], axis=0) if self._run else np.zeros(3)

    def _begin(self, kind: FloorKind) -> None:
        self.kind = kind
        self._quiet, self._landings = 0, 0
        self._hold()
        self._start_m = float(self._space.w[lay.POS + 2])
        since = sum(seconds for _, seconds in self._run)
        if kind is FloorKind.VEHICLE:
            self._ground.move(np.zeros(3), VEHICLE_STD, HILL_STD, since)
            self._run.clear()
            return
        velocity = 0.0
        for gained, seconds in self._run:
            self._ground.shift((velocity + 0.5 * float(gained[2])) * seconds)
            velocity += float(gained[2])
        self._peak = abs(velocity)
        self._run.clear()
        self._ground.move(np.array([0.0, 0.0, velocity]), 0.0, LIFT_STD, since)

    def goes_on(self, gained: FloatArray, seconds: float, *, alike: bool) -> bool:
        """Take a window of the ride; return False when the ride is over."""
        self._hold()
        self._quiet = 0 if alike else self._quiet + 1
        if alike:
            self._landings, self._last = 0, self._space.epoch
        if self.kind is FloorKind.VEHICLE:
            return True
        before = self._ground.velocity
        velocity = float(before[2]) + float(gained[2])
        self._peak = max(self._peak, abs(velocity))
        self._ground.shift(0.5 * float(gained[2]) * seconds)
        self._ground.move(np.array([0.0, 0.0, velocity]), 0.0, LIFT_STD)
        most = min(LEFT + DRIFT * self._ground.seconds, LEFT_SHARE * self._peak)
        if self._quiet < QUIET_WINDOWS or abs(velocity) > most:
            return True
        # what is left of the velocity of a floor at rest has grown evenly
        self._ground.shift(-0.5 * velocity * self._ground.seconds)
        return False

    def landed(self) -> bool:
        """Take a landing; return False when the person has walked off."""
        self._landings += 1
        if self._landings < STEPS_AFTER:
            return True
        if self.kind is FloorKind.LIFT:  # its end was missed: who knows when
            unknown = (self._space.epoch - self._last) / self._space.rate_hz
            self._ground.blur(lay.E_POS, 0.0, unknown * abs(float(self._ground.velocity[2])))
        return False

    @property
    def mean_velocity(self) -> tuple[float, float, float]:
        """Mean velocity of the floor since the start, m/s: that of a standing foot."""
        if self.kind is not FloorKind.LIFT or self._ground.seconds <= 0.0:
            return (0.0, 0.0, 0.0)
        climbed = float(self._space.w[lay.POS + 2]) - self._start_m
        return (0.0, 0.0, climbed / self._ground.seconds)

    def forget(self) -> None:
        """Forget the ride."""
        self.kind = None
        self._run.clear()
