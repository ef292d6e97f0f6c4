"""Path of one foot: one pose a stance and the newest, turned when the heading is."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

from nav_msgs.msg import Path

from ...core import Event, EventKind, FloatArray, FootEstimate
from ..ros.messages import pose_stamped, set_time


class _Pose(NamedTuple):
    stamp_ns: int
    position: FloatArray
    quaternion: FloatArray

    def turned(self, event: Event) -> _Pose:
        """Return the pose turned and moved as a HEADING event says."""
        position = event.turn.positions(self.position[None])[0]
        quaternion = event.turn.quaternions(self.quaternion[None])[0]
        return _Pose(self.stamp_ns, position, quaternion)


class FootPath:
    """Poses of a foot, of which :meth:`message` makes a path.

    ``length`` is the number of poses kept, ``period_s`` the least time between two messages.
    """

    def __init__(self, foot: str, frame_id: str, length: int, period_s: float) -> None:
        self._foot, self._frame_id = foot, frame_id
        self._stances: deque[_Pose] = deque(maxlen=length - 1)
        self._period_ns = round(period_s * 1e9)
        self.clear()

    def clear(self) -> None:
        """Forget every pose."""
        self._stances.clear()
        self._newest: _Pose | None = None
        self._standing: _Pose | None = None
        self._due_ns = 0

    def add(self, stamp_ns: int, estimate: FootEstimate, events: tuple[Event, ...]) -> None:
        """Take the estimate and the events of one epoch."""
        for event in events:
            if event.foot == self._foot:
                self._add_event(event)
        self._newest = _Pose(stamp_ns, estimate.position.copy(), estimate.quaternion.copy())
        if estimate.stance:
            self._standing = self._newest

    def _add_event(self, event: Event) -> None:
        if event.kind is EventKind.HEADING:
            turned = [pose.turned(event) for pose in self._stances]
            self._stances.clear()
            self._stances.extend(turned)
            self._standing = self._standing and self._standing.turned(event)
        elif event.kind is EventKind.STANCE_END and self._standing is not None:
            self._stances.append(self._standing)
            self._standing = None

    def due(self, stamp_ns: int) -> bool:
        """Return whether a message is due, at most once in the period."""
        if stamp_ns < self._due_ns:
            return False
        self._due_ns = stamp_ns + self._period_ns
        return True

    def message(self) -> Path:
        """Return the path: a pose for each stance that is over, and the newest."""
        poses = [*self._stances, *([self._newest] if self._newest else [])]
        message = Path()
        message.header.frame_id = self._frame_id
        if poses:
            set_time(message.header.stamp, poses[-1].stamp_ns)
        message.poses = [pose_stamped(self._frame_id, *pose) for pose in poses]
        return message
