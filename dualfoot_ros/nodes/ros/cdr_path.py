"""``nav_msgs/Path`` as the bytes that go on the wire: each pose is written once.

A long path differs from the one a second before by a pose or two, so the poses are kept as bytes.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ...core import FloatArray
from .cdr_odometry import ENCAPSULATION, STAMP, add_text, padded, stamp_bytes

DOUBLES = 7  # position and quaternion


class PathPose(NamedTuple):
    """A pose of a path: stamp ns, position (3,) m, quaternion (4,) x y z w."""

    stamp_ns: int
    position: FloatArray
    quaternion: FloatArray


class PathBytes:
    """Poses of a path, as bytes; at most ``length``, beyond which the oldest is dropped."""

    def __init__(self, frame_id: str, length: int) -> None:
        self._frame_id, self._length = frame_id, length
        head = self._head(0, 0)
        # Poses end with doubles, so that all but the first one begin at a multiple of eight.
        self._first = _Layout(frame_id, len(head) - len(ENCAPSULATION))
        self._other = _Layout(frame_id, 0)
        self._poses: list[PathPose] = []
        self._rows = bytearray()  # of all poses, laid out as those behind the first

    def __len__(self) -> int:
        """Return the number of poses."""
        return len(self._poses)

    def replace(self, poses: Iterable[PathPose]) -> None:
        """Have these poses in place of those that are there."""
        self._poses.clear()
        self._rows.clear()
        for pose in poses:
            self.append(pose)

    @property
    def poses(self) -> tuple[PathPose, ...]:
        """The poses, oldest first."""
        return tuple(self._poses)

    def append(self, pose: PathPose) -> None:
        """Add a pose."""
        self._poses.append(pose)
        self._rows += self._other.pose(pose)
        if len(self._poses) > self._length:
            del self._poses[0]
            del self._rows[: self._other.size]

    def data(self, newest: PathPose | None) -> bytes:
        """Return the message of all poses and the ``newest``, whose stamp it has."""
        poses = len(self._poses) + (newest is not None)
        if not poses:
            return self._head(0, 0)
        last = newest or self._poses[-1]
        oldest = self._poses[0] if self._poses else last
        parts = [self._head(last.stamp_ns, poses), self._first.pose(oldest)]
        parts.append(bytes(memoryview(self._rows)[self._other.size :]))
        if newest is not None and self._poses:
            parts.append(self._other.pose(newest))
        return b"".join(parts)

    def _head(self, stamp_ns: int, poses: int) -> bytes:
        body = bytearray(stamp_bytes(stamp_ns))
        add_text(body, self._frame_id)
        padded(body, 4)
        return ENCAPSULATION + bytes(body) + struct.pack("<I", poses)


class _Layout:
    """Bytes of a pose that begins at a place with a given remainder by eight."""

    def __init__(self, frame_id: str, start: int) -> None:
        body = bytearray(start % 8) + bytes(STAMP.size)
        add_text(body, frame_id)
        padded(body, 8)
        self._texts = bytes(body[start % 8 + STAMP.size :])
        self.size = STAMP.size + len(self._texts) + 8 * DOUBLES

    def pose(self, pose: PathPose) -> bytes:
        numbers = np.concatenate([pose.position, pose.quaternion]).astype("<f8").tobytes()
        return stamp_bytes(pose.stamp_ns) + self._texts + numbers
