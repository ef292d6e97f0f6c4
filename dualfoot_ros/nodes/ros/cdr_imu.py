"""``sensor_msgs/Imu`` read from the bytes that came: its stamp and the numbers of its sensors.

rclpy makes an object of every part of a message and checks each number of it.  In the bytes all
numbers stand behind the one string of the message.
"""

from __future__ import annotations

import struct

import numpy as np
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu

from ...core import FloatArray
from .cdr_odometry import ENCAPSULATION, SECOND
from .messages import imu_values, to_ns

HEAD = struct.Struct("<4siII")  # encapsulation, seconds, nanoseconds, length of the frame's name
# Behind orientation (4) and its covariance (9): rate (3), covariance (9), force (3), covariance.
SENSED = struct.Struct("<104x3d72x3d72x")


class ImuBytes:
    """One message.

    Attributes
    ----------
    stamp_ns : stamp of the header, ns
    values : specific force m/s^2 and angular rate rad/s, (6,)
    """

    __slots__ = ("_data", "stamp_ns", "values")

    def __init__(self, data: bytes) -> None:
        """Read ``data``, which is a message of the type in any encoding that rclpy knows."""
        self._data = data
        encapsulation, seconds, nanoseconds, length = HEAD.unpack_from(data)
        if encapsulation != ENCAPSULATION:
            self._read_message()
            return
        self.stamp_ns: int = seconds * SECOND + nanoseconds
        names_end = HEAD.size - len(ENCAPSULATION) + length
        start = len(ENCAPSULATION) + names_end + -names_end % 8
        *rate, x, y, z = SENSED.unpack_from(data, start)
        self.values: FloatArray = np.array([x, y, z, *rate])

    def _read_message(self) -> None:
        message = self.message
        self.stamp_ns, self.values = to_ns(message.header.stamp), imu_values(message)

    @property
    def message(self) -> Imu:
        """The whole message, as an object of its own."""
        return deserialize_message(self._data, Imu)
