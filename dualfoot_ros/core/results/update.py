"""What one epoch of the tracker gives: both feet's estimates and the events of the epoch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..kernel import joint_covariance
from ..kernel import layout as lay
from ..rotation import mean_angle, quaternion_yaw
from ..samples.series import FloatArray
from .events import Event
from .rows import matrices, zupt_event

POSE_SIGNS = np.repeat([1.0, -1.0], 3)  # position error, rotation error = -phi


@dataclass(frozen=True)
class FootEstimate:
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


@dataclass(frozen=True)
class PedestrianEstimate:
    """The person between the feet.

    ``heading`` is the direction the person faces, rad: the mean of the feet's headings as last
    seen in stance, against what they were on the first strides.
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

    __slots__ = (
        "_blocks", "_headings", "_noted", "earlier", "phase", "refused", "row", "stamp_ns",
    )  # fmt: skip

    def __init__(
        self,
        stamp_ns: int,
        phase: str,
        *,
        refused: str | None = None,
        row: FloatArray | None = None,
        events: tuple[Event, ...] = (),
        blocks: FloatArray | None = None,
        headings: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        """Keep what was computed; ``blocks`` is the covariance as `Workspace.blocks` gives it."""
        self.stamp_ns, self.phase, self.refused, self.row = stamp_ns, phase, refused, row
        self._noted, self._blocks, self._headings = events, blocks, headings
        self.earlier: tuple[Update, ...] = ()

    def after(self, earlier: Sequence[Update]) -> Update:
        """Return the update with those of the pairs that had waited for the start of the track."""
        self.earlier = tuple(earlier)
        return self

    @property
    def events(self) -> tuple[Event, ...]:
        """Everything that was applied or found at this epoch, zero-velocity updates included."""
        if self.row is None:
            return self._noted
        zupts = (zupt_event(self.row, foot, self.stamp_ns) for foot in range(2))
        return (*(event for event in zupts if event is not None), *self._noted)

    @property
    def announced(self) -> tuple[Event, ...]:
        """The events without the zero-velocity updates (cheap: most epochs have none)."""
        return self._noted

    @property
    def left(self) -> FootEstimate | None:
        """Estimate of the left foot."""
        return self._foot(0)

    @property
    def right(self) -> FootEstimate | None:
        """Estimate of the right foot."""
        return self._foot(1)

    def _foot(self, foot: int) -> FootEstimate | None:
        if self.row is None or self._blocks is None:
            return None
        row = self.row[foot * lay.O_FOOT : (foot + 1) * lay.O_FOOT]
        block = self._blocks[foot * lay.BLOCK : (foot + 1) * lay.BLOCK]
        return FootEstimate(row, pose_part(block.reshape(lay.ERRORS, lay.ROW)))

    def pedestrian(self) -> PedestrianEstimate | None:
        """Return the mid-point of the feet with heading, from the joint covariance."""
        if self.row is None or self._blocks is None:
            return None
        left, right = self.row[: lay.O_FOOT], self.row[lay.O_FOOT : 2 * lay.O_FOOT]
        joint = joint_covariance(self._blocks)
        mean = np.zeros((9, 30))
        for i, (state, half) in enumerate(((lay.E_POS, 0.5), (lay.E_ATT, -0.5), (lay.E_VEL, 0.5))):
            for axis in range(3):
                mean[3 * i + axis, state + axis] = mean[
                    3 * i + axis, lay.ERRORS + state + axis
                ] = half
        covariance = mean @ joint @ mean.T
        return PedestrianEstimate(
            0.5 * (left[lay.O_POS : lay.O_POS + 3] + right[lay.O_POS : lay.O_POS + 3]),
            0.5 * (left[lay.O_VEL : lay.O_VEL + 3] + right[lay.O_VEL : lay.O_VEL + 3]),
            mean_angle(*self._headings),
            covariance[:6, :6],
            covariance[6:, 6:],
        )


def pose_part(block: FloatArray) -> FloatArray:
    """Return the (6, 6) position and rotation part of a foot's covariance block.

    The filter's attitude error turns the estimate back to the truth, C_hat = (I - [phi x]) C; the
    rotation by which the estimate exceeds the truth is -phi, hence the signs of the cross part.
    """
    keep = [lay.E_POS, lay.E_POS + 1, lay.E_POS + 2, lay.E_ATT, lay.E_ATT + 1, lay.E_ATT + 2]
    return block[np.ix_(keep, keep)] * np.outer(POSE_SIGNS, POSE_SIGNS)
