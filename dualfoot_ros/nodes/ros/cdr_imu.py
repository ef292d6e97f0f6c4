"""``sensor_msgs/Imu`` as bytes: read as they came, and filled in place.

rclpy makes an object of every part of a message and checks each number of it.  In the bytes all
numbers stand behind the one string of the message: orientation (4) and its covariance (9), rate
(3), covariance, force (3), covariance.
"""

from __future__ import annotations

import struct

import numpy as np
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu

from ...core import FloatArray
from .cdr_odometry import ENCAPSULATION, SECOND, STAMP, add_text, padded, stamp_bytes
from .messages import new_imu, to_ns

HEAD = struct.Struct("<4siII")  # encapsulation, seconds, nanoseconds, length of the frame's name
NAME = HEAD.size - 4  # where the frame's name begins, with its length
RATE, FORCE = 104, 200  # where they begin in the numbers; the covariance of each is behind it
SENSED = struct.Struct("<104x3d72x3d72x")
VECTOR = struct.Struct("<3d")
COVARIANCE = 72


class ImuBytes:
    """One message.

    Attributes
    ----------
    stamp_ns : stamp of the header, ns
    values : specific force m/s^2 and angular rate rad/s, (6,)
    """

    __slots__ = ("_data", "_name_end", "stamp_ns", "values")

    def __init__(self, data: bytes) -> None:
        """Read ``data``, which is a message of the type in any encoding that rclpy knows."""
        if not data.startswith(ENCAPSULATION):
            data = encoded(deserialize_message(data, Imu))
        self._data = data
        _, seconds, nanoseconds, length = HEAD.unpack_from(data)
        self.stamp_ns: int = seconds * SECOND + nanoseconds
        self._name_end = HEAD.size + length
        *rate, x, y, z = SENSED.unpack_from(data, numbers_behind(self._name_end))
        self.values: FloatArray = np.array([x, y, z, *rate])

    def origin(self) -> tuple[bytes, bytes, bytes]:
        """Return the name of the frame and the covariances of rate and force, as they came."""
        data, start = self._data, numbers_behind(self._name_end)
        rate, force = (start + each + VECTOR.size for each in (RATE, FORCE))
        name = data[NAME : self._name_end]
        return name, data[rate : rate + COVARIANCE], data[force : force + COVARIANCE]

    @property
    def message(self) -> Imu:
        """The whole message, as an object of its own."""
        return deserialize_message(self._data, Imu)


class FilledImu:
    """One message without orientation, with frame and covariances of the samples it follows."""

    def __init__(self, frame_id: str) -> None:
        self._take(ImuBytes(encoded(new_imu(frame_id))).origin())

    def follow(self, sample: ImuBytes) -> None:
        """Take frame and covariances of a sample."""
        origin = sample.origin()
        if origin != self._origin:
            self._take(origin)

    def data(self, stamp_ns: int, values: FloatArray) -> bytes:
        """Return the message with a stamp, and specific force and angular rate (6,)."""
        x, y, z, *rate = values.tolist()
        STAMP.pack_into(self._buffer, len(ENCAPSULATION), *divmod(stamp_ns, SECOND))
        VECTOR.pack_into(self._buffer, self._start + RATE, *rate)
        VECTOR.pack_into(self._buffer, self._start + FORCE, x, y, z)
        return bytes(self._buffer)

    def _take(self, origin: tuple[bytes, bytes, bytes]) -> None:
        self._origin = name, rate, force = origin
        unknown = np.array([0.0, 0.0, 0.0, 1.0, -1.0, *8 * [0.0]], dtype="<f8").tobytes()
        vector = bytes(VECTOR.size)
        body = bytearray(STAMP.size) + name
        padded(body, 8)
        self._start = len(ENCAPSULATION) + len(body)
        numbers = b"".join([unknown, vector, rate, vector, force])
        self._buffer = bytearray(ENCAPSULATION) + body + numbers


def numbers_behind(name_end: int) -> int:
    """Return where the numbers begin: at a multiple of eight bytes behind the encapsulation."""
    return name_end + -(name_end - len(ENCAPSULATION)) % 8


def encoded(message: Imu) -> bytes:
    """Return the bytes of a message in the encoding that is read here, on any processor."""
    body = bytearray(stamp_bytes(to_ns(message.header.stamp)))
    add_text(body, message.header.frame_id)
    padded(body, 8)
    turn, rate, force = (
        message.orientation,
        message.angular_velocity,
        message.linear_acceleration,
    )
    numbers = [
        *(turn.x, turn.y, turn.z, turn.w, *message.orientation_covariance),
        *(rate.x, rate.y, rate.z, *message.angular_velocity_covariance),
        *(force.x, force.y, force.z, *message.linear_acceleration_covariance),
    ]
    return ENCAPSULATION + bytes(body) + np.array(numbers, dtype="<f8").tobytes()
