"""``nav_msgs/Odometry`` as the bytes that go on the wire, filled in place.

A message object of ROS costs more than all that is computed for it: each of its numbers is checked
and converted, twice.  Strings do not change while a node runs, so that all numbers of a message
have their place in one buffer.  A publisher of rclpy takes the bytes as they are.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

import numpy as np

from ...core import FloatArray

ENCAPSULATION = b"\x00\x01\x00\x00"  # plain CDR, little-endian
STAMP = struct.Struct("<iI")
SECOND = 1_000_000_000
DOUBLES = 85  # pose (3 + 4), its covariance (36), twist (3 + 3), its covariance (36)


def padded(body: bytearray, size: int) -> None:
    """Pad what stands behind the encapsulation to a multiple of ``size``."""
    body += bytes(-len(body) % size)


def add_text(body: bytearray, text: str) -> None:
    """Add a string: its length with the closing zero, then its bytes."""
    padded(body, 4)
    data = text.encode() + b"\0"
    body += struct.pack("<I", len(data)) + data


def stamp_bytes(stamp_ns: int) -> bytes:
    """Return seconds and nanoseconds of a stamp."""
    return STAMP.pack(*divmod(stamp_ns, SECOND))


class OdometryBytes:
    """One message between two frames, which is filled again and again.

    Attributes
    ----------
    frame_id, child_frame_id : of the message
    stamp_ns : ns, set by :meth:`stamp`
    position, quaternion : (3,) m and (4,) x y z w, to be written to
    pose_covariance : (6, 6), to be written to
    linear, angular : (3,) m/s and rad/s in the child frame, to be written to
    twist_covariance : (6, 6), to be written to
    twist_variances : (6,), the diagonal of it
    """

    def __init__(self, frame_id: str, child_frame_id: str) -> None:
        self.frame_id, self.child_frame_id, self.stamp_ns = frame_id, child_frame_id, 0
        body = bytearray(STAMP.size)
        for text in (frame_id, child_frame_id):
            add_text(body, text)
        padded(body, 8)
        # Four bytes in front align the numbers in memory as they are in the message.
        start = len(ENCAPSULATION) + len(body)
        self._buffer = bytearray(4) + ENCAPSULATION + body + bytes(8 * DOUBLES)
        self._message = memoryview(self._buffer)[4:]
        values: FloatArray = np.frombuffer(self._buffer, dtype="<f8", offset=4 + start)
        self.position, self.quaternion = values[:3], values[3:7]
        self.pose_covariance = values[7:43].reshape(6, 6)
        self.linear, self.angular = values[43:46], values[46:49]
        self.twist_covariance, self.twist_variances = values[49:].reshape(6, 6), values[49::7]

    def stamp(self, stamp_ns: int) -> None:
        """Set the stamp."""
        self.stamp_ns = stamp_ns
        STAMP.pack_into(self._message, len(ENCAPSULATION), *divmod(stamp_ns, SECOND))

    def data(self) -> bytes:
        """Return the message as it is now."""
        return bytes(self._message)


class OdometryNumbers:
    """What stands in the bytes of messages that :class:`OdometryBytes` has made, N of them.

    Attributes
    ----------
    stamp_ns : (N,) ns
    position, quaternion : (N, 3) m and (N, 4) x y z w
    pose_covariance, twist_covariance : (N, 6, 6)
    linear : (N, 3) m/s in the child frame
    """

    def __init__(self, messages: Sequence[bytes]) -> None:
        stamps = [STAMP.unpack_from(data, len(ENCAPSULATION)) for data in messages]
        self.stamp_ns = np.array([s * SECOND + ns for s, ns in stamps], dtype=np.int64)
        numbers = b"".join(data[-8 * DOUBLES :] for data in messages)
        values = np.frombuffer(numbers, dtype="<f8").reshape(-1, DOUBLES)
        self.position, self.quaternion = values[:, :3], values[:, 3:7]
        self.pose_covariance = values[:, 7:43].reshape(-1, 6, 6)
        self.linear, self.twist_covariance = values[:, 43:46], values[:, 49:].reshape(-1, 6, 6)
