"""What one epoch of the tracker gives: both feet's estimates and the events of the epoch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..kernel import layout as lay
from ..rotation import mean_angle, quaternion_yaw
from ..samples.series import FloatArray
from .context import Context
from .events import Event
from .facing import UNKNOWN_VARIANCE, Facing
from .rows import matrices, stance_nis, zupt_event

ONE_FOOT_STD = 0.4  # m, of the person about one foot
POSE_ROWS = np.concatenate([np.arange(3) + start for start in (lay.E_POS, lay.E_ATT)])
POSE_SIGNS = np.outer(np.repeat([1.0, -1.0], 3), np.repeat([1.0, -1.0], 3))
# position error, rotation error = -phi
MEAN_ROWS = np.concatenate([np.arange(3) + start for start in (lay.E_POS, lay.E_ATT, lay.E_VEL)])
# Where these parts are in a block, and in each of the three blocks.
POSE_PLACES = lay.ROW * POSE_ROWS[:, None] + POSE_ROWS
MEAN_PLACES = (
    lay.TOLD_BLOCK * np.arange(3)[:, None, None] + lay.ROW * MEAN_ROWS[:, None] + MEAN_ROWS
)
MEAN_SIGNS = np.outer(np.repeat([1.0, -1.0, 1.0], 3), np.repeat([1.0, -1.0, 1.0], 3))


class FootEstimate(NamedTuple):
    """The estimate of one foot at one epoch, in the navigation frame (z up)."""

    row: FloatArray
    pose: FloatArray

    @property
    def position(self) -> FloatArray:
        """Position (3,) m."""
        return self.row[lay.O_POS : lay.O_POS + 3]

    @property
    def velocity(self) -> FloatArray:
        """Velocity (3,) m/s in the navigation frame."""
        return self.row[lay.O_VEL : lay.O_VEL + 3]

    @property
    def quaternion(self) -> FloatArray:
        """Body to navigation (4,), Hamilton, x y z w."""
        return self.row[lay.O_QUAT : lay.O_QUAT + 4]

    @property
    def stance(self) -> bool:
        """Whether the foot has zero velocity as far as is known now."""
        return bool(self.row[lay.O_STANCE])

    @property
    def angular_rate(self) -> FloatArray:
        """Bias-corrected angular rate (3,) rad/s in the body frame."""
        return self.row[lay.O_RATE : lay.O_RATE + 3]

    @property
    def yaw(self) -> float:
        """Heading of the body x axis, rad."""
        return quaternion_yaw(self.quaternion)

    def pose_covariance(self) -> FloatArray:
        """Return the covariance (6, 6) of position (m) and rotation about fixed axes (rad)."""
        return self.pose

    def twist_covariance(self) -> FloatArray:
        """Return the covariance (3, 3) of the velocity in the navigation frame, (m/s)^2."""
        return matrices(self.row[lay.O_COV_VEL : lay.O_COV_VEL + 9])


class PedestrianEstimate(NamedTuple):
    """The person between the feet.

    ``position`` is midway between the sensors.  ``heading`` is the direction the person faces,
    rad: the mean of the feet's headings as last seen in stance, against what they were on the
    first strides.  Until those have been made nothing is known of it, and its variance says so.
    """

    position: FloatArray
    velocity: FloatArray
    heading: float
    pose_covariance: FloatArray
    velocity_covariance: FloatArray


class Update:
    """The result of one pair: what phase the tracker is in, the estimates, the events.

    While the phase is "aligning" there is no estimate and ``left`` and ``right`` are None.  It is
    a value: nothing of it changes with the pairs that follow.  Where pairs had to wait for the
    start of the track, ``earlier`` of the first update with an estimate has theirs.
    """

    __slots__ = ("_context", "_told", "stamp_ns")

    def __init__(self, stamp_ns: int, context: Context, told: FloatArray | None = None) -> None:
        """Keep what was computed.

        ``told`` (1, TOLD) is what the kernel tells.  Nothing is taken apart here: of most updates
        little is asked.
        """
        self.stamp_ns, self._context, self._told = stamp_ns, context, told

    @property
    def phase(self) -> str:
        """The phase: "aligning", "standing" (aligned, still refining) or "walking"."""
        return self._context.phase

    @property
    def refused(self) -> str | None:
        """Why the pair was refused, if it was."""
        return self._context.refused

    @property
    def facing(self) -> Facing:
        """What the headings of the feet follow from."""
        return self._context.facing

    @property
    def earlier(self) -> tuple[Update, ...]:
        """The updates of the pairs that had waited for the start of the track."""
        return self._context.earlier

    @property
    def row(self) -> FloatArray | None:
        """The output row (OUT,), laid out as in `core.kernel.layout`."""
        return None if self._told is None else self._told[0, : lay.OUT]

    def after(self, earlier: Sequence[Update]) -> Update:
        """Return the update with those of the pairs that had waited for the start of the track."""
        return Update(self.stamp_ns, self._context._replace(earlier=tuple(earlier)), self._told)

    @property
    def events(self) -> tuple[Event, ...]:
        """Everything that was applied or found at this epoch, zero-velocity updates included."""
        row = self.row
        if row is None:
            return self.announced
        zupts = (zupt_event(row, foot, self.stamp_ns) for foot in range(2))
        return (*(event for event in zupts if event is not None), *self.announced)

    def stance_nis(self, foot: int) -> float | None:
        """Return the NIS of the zero-velocity update of foot 0 or 1; None without one."""
        row = self.row
        return None if row is None else stance_nis(row, foot)

    @property
    def announced(self) -> tuple[Event, ...]:
        """The events without the zero-velocity updates (cheap: most epochs have none)."""
        return self._context.events

    @property
    def left(self) -> FootEstimate | None:
        """Estimate of the left foot."""
        return self._foot(0)

    @property
    def right(self) -> FootEstimate | None:
        """Estimate of the right foot."""
        return self._foot(1)

    def _foot(self, foot: int) -> FootEstimate | None:
        if self._told is None:
            return None
        start = lay.OUT + foot * lay.TOLD_BLOCK
        block = self._told[0, start : start + lay.TOLD_BLOCK]
        row = self._told[0, foot * lay.O_FOOT : (foot + 1) * lay.O_FOOT]
        return FootEstimate(row, pose_part(block))

    @property
    def present(self) -> tuple[bool, bool]:
        """Whether the left and the right foot had a sample."""
        if self._told is None:
            return True, True
        left, right = (bool(self._told[0, f * lay.O_FOOT + lay.O_PRESENT]) for f in range(2))
        return left, right

    def _shares(self) -> tuple[float, float]:
        """Return the shares of the feet in the person: a half each, or all of the one there."""
        left, right = self.present
        if left == right:
            return 0.5, 0.5
        return (1.0, 0.0) if left else (0.0, 1.0)

    def foot_headings(self) -> tuple[float, float]:
        """Return the heading of each foot now, rad; of a foot that is missing, the other's."""
        assert self._told is not None
        parts = self._told[0, : 2 * lay.O_FOOT].reshape(2, lay.O_FOOT)
        left, right = (
            self.facing.heading(foot, parts[foot, lay.O_QUAT : lay.O_QUAT + 4])
            for foot in range(2)
        )
        there = self.present
        return left if there[0] else right, right if there[1] else left

    def pedestrian(self) -> PedestrianEstimate | None:
        """Return the mid-point of the feet with heading, from the joint covariance."""
        if self._told is None:
            return None
        told = self._told[0]
        left, right = told[: lay.O_FOOT], told[lay.O_FOOT : 2 * lay.O_FOOT]
        shares = self._shares()
        covariance = mean_covariance(told[lay.OUT :], shares)
        if not self.facing.known:
            covariance[5] = covariance[:, 5] = 0.0
            covariance[5, 5] = UNKNOWN_VARIANCE
        if 1.0 in shares:  # the person is within reach of the one foot that is there
            covariance[:3, :3] += ONE_FOOT_STD**2 * np.eye(3)
        pos, vel = (slice(start, start + 3) for start in (lay.O_POS, lay.O_VEL))
        return PedestrianEstimate(
            shares[0] * left[pos] + shares[1] * right[pos],
            shares[0] * left[vel] + shares[1] * right[vel],
            mean_angle(*self.facing.stances),
            covariance[:6, :6],
            covariance[6:, 6:],
        )


def mean_covariance(blocks: FloatArray, shares: tuple[float, float] = (0.5, 0.5)) -> FloatArray:
    """Return the covariance (9, 9) of the feet's mean position, rotation and velocity.

    ``blocks`` (3 TOLD_BLOCK,) are the covariances of the left and the right foot, and the cross
    part; ``shares`` what each foot counts in the mean.
    """
    own, other, cross = blocks.take(MEAN_PLACES)
    a, b = shares
    mean: FloatArray = (a * a * own + b * b * other + a * b * (cross + cross.T)) * MEAN_SIGNS
    return mean


def pose_part(block: FloatArray) -> FloatArray:
    """Return the (6, 6) position and rotation part of a foot's covariance block (TOLD_BLOCK,).

    The filter's attitude error turns the estimate back to the truth, C_hat = (I - [phi x]) C; the
    rotation by which the estimate exceeds the truth is -phi, hence the signs of the cross part.
    """
    pose: FloatArray = block.take(POSE_PLACES) * POSE_SIGNS
    return pose
