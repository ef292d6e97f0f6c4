"""Feet that step on a moving floor, or off it: they land with the velocity of the floor.

Where the feet do not know of the floor, its zero-velocity update finds the whole velocity as its
innovation: 0.5 m/s, in place of 0.05 m/s (0.17 m/s in one landing of a hundred).  One landing may
be a false stance; both feet, one after the other, with the same velocity are a moving floor, and
so is a foot that lands twice, the stance of the other one having been missed, and has that
velocity the first time only.  Where landings before them had such velocities as well, something
else is wrong with the track, as a constraint to a distance that the feet do not have.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..gait_history import GaitHistory
from ..joint_estimate import Touchdown
from ..kernel import Workspace
from ..kernel import layout as lay
from ..samples.series import FloatArray

LANDING_STD = 0.06  # m/s, velocity of a sensor at the start of a stance
ALIKE = 0.5  # share of their mean by which two landings may differ
STEADY = 0.5  # share of its velocity that a landing may gain until its stance is confirmed
ODD = 1.25  # times its velocity with which no foot lands on a floor that it is on, or steps off
FASTEST = 1.0  # m/s, of a floor that one steps on
LONGEST_S = 3.0  # from the landing of one foot to that of the other


class Landing(NamedTuple):
    """The velocity (3,) m/s with which a foot has landed, where it is not that of the floor.

    ``epoch`` and ``stamp_ns`` are those of its first sample in stance.
    """

    foot: int
    epoch: int
    stamp_ns: int
    velocity: FloatArray


class Step(NamedTuple):
    """Both feet on a floor that moves by ``velocity`` (3,) m/s against the one before.

    ``epoch`` and ``stamp_ns`` are those of the first landing.
    """

    epoch: int
    stamp_ns: int
    velocity: FloatArray


class Boarding:
    """Compares the landings of both feet."""

    def __init__(self, space: Workspace, gait: GaitHistory) -> None:
        """Take landings whose NIS (3 degrees of freedom) is above ``gate``."""
        self._space, self._gait, self.gate = space, gait, math.inf
        self._before: Landing | None = None
        self._fast = [False, False, False]  # the newest landings: beyond the gate
        self._speeds = [0.0, 0.0]  # of the newest landings beyond the gate, m/s
        self._quiet = True

    def forget(self) -> None:
        """Forget the landings before."""
        self._before = None
        self._fast = [False, False, False]
        self._speeds = [0.0, 0.0]
        self._quiet = True

    def is_usual(self, nis: float) -> bool:
        """Return whether a landing of this NIS tells nothing, as those before: nearly always."""
        return self._quiet and nis <= self.gate

    def mistrust(self) -> None:
        """Take note that something else has moved the feet: landings tell nothing for a while."""
        self._before = None
        self._fast = [True, True, True]
        self._quiet = False

    def contradicts(self, velocity: FloatArray) -> bool:
        """Return whether a foot has landed as on no floor with this velocity (3,), nor off it.

        It is the landing before the newest one, which would have made both another step.
        """
        return self._speeds[0] > ODD * math.sqrt(float(velocity @ velocity))

    def landed(self, foot: int, touchdown: Touchdown) -> Step | None:
        """Take the stance of ``foot`` that is confirmed; return a step between floors."""
        landing = self._landing(foot, touchdown)
        before, self._before = self._before, landing
        self._quiet = landing is None and not any(self._fast) and not any(self._speeds)
        if (
            before is None
            or self._fast[0]
            or self._gait_ns(foot) - before.stamp_ns > LONGEST_S * 1e9
        ):
            return None
        velocity = before.velocity
        if before.foot != foot:
            if landing is None or not alike(landing.velocity, velocity):
                return None
            velocity = 0.5 * (landing.velocity + velocity)
        elif landing is not None:
            return None
        self.forget()
        return Step(before.epoch, before.stamp_ns, velocity)

    def _gait_ns(self, foot: int) -> int:
        """Return the stamp of the first sample of the stance of ``foot``, ns."""
        return self._gait.stamp(self._space.foot(foot, "N_START"))

    def _landing(self, foot: int, touchdown: Touchdown) -> Landing | None:
        """Return the landing of ``foot`` if its velocity is none that a landing has."""
        if touchdown.nis < 0.0:
            return None
        fast = touchdown.nis > self.gate
        self._fast = [*self._fast[1:], fast]
        speed = math.hypot(*touchdown.velocity) if fast and not self._gait.uneven else 0.0
        self._speeds = [self._speeds[1], speed]
        if not fast or self._gait.uneven:
            return None
        velocity, first = np.array(touchdown.velocity), self._space.foot(foot, "N_START")
        if float(velocity @ velocity) > FASTEST**2:
            return None
        if not self._steady(foot, first, velocity):
            return None
        return Landing(foot, first, self._gait.stamp(first), velocity)

    def _steady(self, foot: int, first: int, velocity: FloatArray) -> bool:
        """Return whether a foot has hardly gained velocity since it landed: it rests on a floor.

        A false stance in a swing gains as much as it had.
        """
        space, gained = self._space, np.zeros(3)
        for epoch in range(first, space.epoch + 1):
            at = space.snapshot(epoch)[foot * lay.FOOT : (foot + 1) * lay.FOOT]
            sample = lay.RINGS + lay.SAMPLE * (epoch % space.ring)
            force = space.w[sample + 1 + 6 * foot : sample + 4 + 6 * foot]
            rotation = at[lay.ROT : lay.ROT + 9].reshape(3, 3)
            pull = rotation @ (force - at[lay.BA : lay.BA + 3])
            pull[2] -= space.w[lay.C_GRAVITY]
            gained += space.w[sample] * pull
        return float(gained @ gained) < STEADY**2 * float(velocity @ velocity)


def alike(one: FloatArray, other: FloatArray) -> bool:
    """Return whether two velocities (3,) differ by less than a share of their mean."""
    apart, mean = one - other, 0.5 * (one + other)
    return float(apart @ apart) < ALIKE**2 * float(mean @ mean)
