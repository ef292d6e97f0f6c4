"""Path of one foot: one pose a stance and the newest, turned when the heading is."""

from __future__ import annotations

from ...core import Event, EventKind, FootEstimate
from ..ros.cdr_path import PathBytes, PathPose


def turned(pose: PathPose, event: Event) -> PathPose:
    """Return the pose turned and moved as a HEADING event says."""
    position = event.turn.positions(pose.position[None])[0]
    quaternion = event.turn.quaternions(pose.quaternion[None])[0]
    return PathPose(pose.stamp_ns, position, quaternion)


class FootPath:
    """Poses of a foot, of which :meth:`message` makes a path.

    ``length`` is the number of poses kept, ``period_s`` the least time between two messages.
    """

    def __init__(self, foot: str, frame_id: str, length: int, period_s: float) -> None:
        self._foot = foot
        self._stances = PathBytes(frame_id, length - 1)
        self._period_ns = round(period_s * 1e9)
        self.clear()

    def clear(self) -> None:
        """Forget every pose."""
        self._stances.replace(())
        self._newest: PathPose | None = None
        self._standing: PathPose | None = None
        self._due_ns = 0

    def add(self, stamp_ns: int, estimate: FootEstimate, events: tuple[Event, ...]) -> None:
        """Take the estimate and the events of one epoch."""
        for event in events:
            if event.foot == self._foot:
                self._add_event(event)
        self._newest = PathPose(stamp_ns, estimate.position.copy(), estimate.quaternion.copy())
        if estimate.stance:
            self._standing = self._newest

    def _add_event(self, event: Event) -> None:
        if event.kind is EventKind.HEADING:
            self._stances.replace([turned(pose, event) for pose in self._stances.poses])
            self._standing = self._standing and turned(self._standing, event)
        elif event.kind is EventKind.STANCE_END and self._standing is not None:
            self._stances.append(self._standing)
            self._standing = None

    def due(self, stamp_ns: int) -> bool:
        """Return whether a message is due, at most once in the period."""
        if stamp_ns < self._due_ns:
            return False
        self._due_ns = stamp_ns + self._period_ns
        return True

    def message(self) -> bytes:
        """Return the path as a message: a pose for each stance that is over, and the newest."""
        return self._stances.data(self._newest)
