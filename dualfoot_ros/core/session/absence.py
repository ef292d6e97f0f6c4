"""A foot without samples: frozen while it is away, levelled and joined again when it is back.

What happens to a foot whose sensor is silent is unknown, but the other foot goes on and sees the
turns of the walk.  So when the samples are back the foot is as uncertain as its absence makes it;
at its next stance gravity gives its level and the other foot its heading, as it was known how the
sensor sits on the shoe; and in the middle of that stance the other foot passes it, which gives its
position.  Only then are the feet constrained to each other again.
"""

from __future__ import annotations

import math
from enum import StrEnum

import numpy as np

from ..config import TrackerConfig
from ..gait_history import GaitHistory
from ..joint_estimate import HeadingCorrection, JointEstimate, Outcome, relative_row
from ..kernel import Workspace
from ..kernel import layout as lay
from ..results.events import FEET, Event, EventKind
from ..rotation import about_z, turn_between
from ..samples.series import FloatArray
from .heading import Headings

SWING_SPEED = 2.0  # m/s, of a foot about which nothing is known
SWING_RATE, STAND_RATE = 3.0, 0.3  # rad/s, at which a foot may have turned meanwhile
LARGEST_TILT, LARGEST_YAW = 0.7, 1.8  # rad, the latter that of any heading (pi / sqrt 3)
TURNS_FOR_S = 10.0  # after which any heading is as likely
LEVEL_STD, FEET_STD = 0.05, 0.15  # rad: level in a stance, heading of one foot against the other
KEPT_YAW = 0.1  # rad, by which a foot may have turned without being levelled anew
STANCE_SPEED = 0.1  # m/s
BESIDE_STD, BESIDE_UP_STD = 0.2, 0.15  # m, place of a foot against the one that passes it
SPACING_M = 0.15
LARGEST_BIAS = 0.5  # m/s^2, of an accelerometer


class Presence(StrEnum):
    """How far a foot is part of the track.

    Attributes
    ----------
    JOINED : as usual
    MISSING : it has no samples
    BACK : it has samples again, but no attitude
    LEVELLED : it has an attitude, but no place beside the other foot
    """

    JOINED = "joined"
    MISSING = "missing"
    BACK = "back"
    LEVELLED = "levelled"


JOINED = Presence.JOINED  # asked at each stance: a look into an enumeration takes long


class Absences:
    """The presence of both feet, and what is done when it changes."""

    def __init__(
        self, config: TrackerConfig, space: Workspace, headings: Headings, gait: GaitHistory
    ) -> None:
        """Start with both feet joined."""
        self._bias_std, self._space = config.initial.accelerometer_bias, space
        self._headings, self._gait = headings, gait
        self.of = [Presence.JOINED, Presence.JOINED]
        self._since_ns = [0, 0]
        self._stood = [False, False]
        self._follows = [False, False]  # feet levelled with the heading of the other one

    @property
    def none(self) -> bool:
        """Whether both feet are joined."""
        return self.of[0] is JOINED and self.of[1] is JOINED

    def gone(self, foot: int, stamp: int, *, standing: bool) -> Event:
        """Take note that ``foot`` has no sample at ``stamp``, as it has had before it."""
        if self.of[foot] is not Presence.MISSING:
            self._since_ns[foot] = stamp
        self.of[foot], self._stood[foot] = Presence.MISSING, standing
        self._headings.absent[foot] = True
        w, o = self._space.w, foot * lay.FOOT
        for item in (lay.VEL, lay.ALPHA, lay.GAMMA, lay.RATE):
            w[o + item : o + item + 3] = 0.0
        w[o + lay.FOLLOWS] = 0.0
        self._unknown(foot, lay.E_VEL, SWING_SPEED)
        return Event(EventKind.MISSING, stamp, FEET[foot], stamp)

    def never_there(self, foot: int, stamp: int) -> None:
        """Take note that ``foot`` has had no sample yet: nothing is known of it."""
        self.of[foot], self._since_ns[foot] = Presence.MISSING, stamp
        self._headings.late(foot)
        self._headings.absent[foot] = True
        self._space.n[lay.N_FOOT + foot * lay.N_STRIDE + lay.N_GONE] = 1

    def back(self, foot: int, stamp: int) -> None:
        """Take note that ``foot`` has samples again: its attitude is as it was, but uncertain."""
        self.of[foot] = Presence.BACK
        # Its speed now says nothing of where it went meanwhile: a ZUPT must not correct its place.
        self._unknown(foot, lay.E_VEL, SWING_SPEED)
        seconds = max(0.0, (stamp - self._since_ns[foot]) * 1e-9)
        rate = STAND_RATE if self._stood[foot] else SWING_RATE
        tilt = min(LARGEST_TILT, rate * seconds)
        yaw = min(LARGEST_YAW, rate * seconds)
        rows = self._space.own_block(foot)
        for axis, std in enumerate((tilt, tilt, yaw)):
            rows[lay.E_ATT + axis, lay.E_ATT + axis] += std**2
        if yaw < KEPT_YAW:  # it has hardly turned: its attitude holds
            self.of[foot] = Presence.LEVELLED

    def lost(self, foot: int, since_ns: int, stamp: int, speed: float) -> None:
        """Take note at ``stamp`` that the samples of ``foot`` were wrong since ``since_ns``.

        ``speed`` m/s is that with which it seemed to land.
        """
        self._somewhere(foot, speed * max(0.0, (stamp - since_ns) * 1e-9))
        self.gone(foot, since_ns, standing=False)
        self.back(foot, stamp)
        self.of[foot] = Presence.BACK
        self._forget_bias(foot)

    def _forget_bias(self, foot: int) -> None:
        """Take back what the present stance has taught the accelerometer bias of ``foot``."""
        start = foot * lay.FOOT + lay.BA
        bias = self._space.snapshot(self._space.foot(foot, "N_START"))[start : start + 3].copy()
        size = math.hypot(*bias.tolist())
        if size > LARGEST_BIAS:  # those before were wrong too
            bias, size = np.zeros(3), 0.0
        self._space.w[start : start + 3] = bias
        self._unknown(foot, lay.E_BA, max(self._bias_std, size))

    def _somewhere(self, foot: int, std: float) -> None:
        """Make the place of ``foot`` unknown by ``std`` m besides."""
        rows = self._space.own_block(foot)
        for i in range(lay.E_POS, lay.E_POS + 3):
            rows[i, i] += std * std

    def _unknown(self, foot: int, state: int, std: float) -> None:
        """Make three error states of ``foot`` unknown to ``std``, independent of all others."""
        P = self._space.covariance()
        states = lay.ERRORS * foot + state + np.arange(3)
        P[states] = P[:, states] = 0.0
        P[states, states] = std**2
        self._space.put_covariance(P)

    def level(self, foot: int) -> None:
        """Level ``foot`` in its first stance since it is back, with the heading of the walk.

        The heading is that of the other foot, where that is joined and both are known; else what
        the foot has had before.
        """
        up = self._up(foot)
        before = self._rotation(foot)
        rotation = levelled(up)
        rotation = about_z(turn_between(rotation, before)) @ rotation
        start = foot * lay.FOOT
        self._space.w[start + lay.ROT : start + lay.ROT + 9] = rotation.ravel()
        self._space.w[start + lay.VEL : start + lay.VEL + 3] = 0.0
        follows = self.of[1 - foot] is Presence.JOINED and self._headings.knows(foot)
        if follows:
            self._face(foot)
        self._know_attitude(foot, follows=follows)
        self._follows[foot] = follows
        self.of[foot] = Presence.LEVELLED

    def _face(self, foot: int) -> float:
        """Turn ``foot`` to where the other one heads at this moment; return that heading, rad."""
        own, ahead = (
            self._headings.heading_with(each, self._rotation(each)) for each in (foot, 1 - foot)
        )
        start = foot * lay.FOOT + lay.ROT
        turned = about_z(ahead - own) @ self._rotation(foot)
        self._space.w[start : start + 9] = turned.ravel()
        return ahead

    def _up(self, foot: int) -> FloatArray:
        """Return where up is in the axes of a standing foot (3,): the mean force of its stance."""
        first = self._space.foot(foot, "N_START")
        epochs = range(max(first, self._space.epoch - self._space.ring + 1), self._space.epoch + 1)
        force = np.mean([self._gait.sample(foot, epoch)[:3] for epoch in epochs], axis=0)
        start = foot * lay.FOOT + lay.BA
        force = force - self._space.w[start : start + 3]
        up: FloatArray = force / math.sqrt(float(force @ force))
        return up

    def _know_attitude(self, foot: int, *, follows: bool) -> None:
        """Set the covariance of a levelled foot; its heading error is the other's, or its own."""
        P = self._space.covariance()
        own, other = lay.ERRORS * foot, lay.ERRORS * (1 - foot)
        yaw, its = own + lay.E_ATT + 2, other + lay.E_ATT + 2
        tilts = [own + lay.E_ATT, own + lay.E_ATT + 1]
        speeds = [own + lay.E_VEL + axis for axis in range(3)]
        P[tilts + speeds] = P[:, tilts + speeds] = 0.0
        P[tilts, tilts], P[speeds, speeds] = LEVEL_STD**2, STANCE_SPEED**2
        if follows:
            P[yaw] = P[its]
            P[:, yaw] = P[:, its]
            P[yaw, yaw] = P[its, its] + FEET_STD**2
        self._space.put_covariance(P)

    def _rotation(self, foot: int) -> FloatArray:
        start = foot * lay.FOOT + lay.ROT
        return self._space.w[start : start + 9].reshape(3, 3).copy()

    def can_join(self, foot: int) -> bool:
        """Return whether ``foot`` has all that it needs to be put beside the other one."""
        return self.of[foot] is Presence.LEVELLED and self._headings.known

    def joined(self, foot: int, stamp: int) -> Event:
        """Take note that ``foot`` is part of the track again."""
        self.of[foot] = Presence.JOINED
        self._headings.absent[foot] = False
        return Event(EventKind.JOINED, self._since_ns[foot], FEET[foot], stamp)

    def put_beside(self, estimate: JointEstimate, foot: int, spacing_m: float) -> Outcome:
        """Update with the place of the feet in passing: side by side across the heading, level.

        In a turn the heading of a foot in its stance is that which the other one has in passing.
        """
        heading = self._face(foot) if self._follows[foot] else self._headings.mean
        left = np.array([-math.sin(heading), math.cos(heading), 0.0])
        innovation = np.array(estimate.relative_position()) - (spacing_m or SPACING_M) * left
        rows = [relative_row(direction) for direction in np.eye(3).tolist()]
        variances = [BESIDE_STD**2, BESIDE_STD**2, BESIDE_UP_STD**2]
        correction = HeadingCorrection.NONE
        s, nis = estimate.update(rows, innovation.tolist(), variances, correction)
        return Outcome(innovation, s, nis)


def levelled(up: FloatArray) -> FloatArray:
    """Return R_nb (3, 3) with up (3,) in body axes, and some heading."""
    axis = np.eye(3)[int(np.argmin(np.abs(up)))]
    x = axis - up * float(axis @ up)
    x /= math.sqrt(float(x @ x))
    return np.array([x, np.cross(up, x), up])
