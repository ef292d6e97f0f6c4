"""Messages and samples that tests hand to nodes."""

import numpy as np
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.ros.messages import new_imu, set_imu_values, set_time

GRAVITY = 9.80665
STANDING = np.array([0.0, 0.0, GRAVITY, 0.0, 0.0, 0.0])
STEP_NS = 10_000_000


def imu(stamp_ns: int, values=STANDING, frame_id: str = "sensor") -> Imu:
    """Return one sample as a message."""
    message = new_imu(frame_id)
    set_time(message.header.stamp, stamp_ns)
    set_imu_values(message, np.asarray(values, dtype=np.float64))
    return message


def imu_bytes(stamp_ns: int, values=STANDING) -> bytes:
    """Return one sample as the bytes of its message."""
    return serialize_message(imu(stamp_ns, values))


def status_values(message) -> dict[str, str]:
    """Return the values of the first status of a diagnostic message."""
    return {each.key: each.value for each in message.status[0].values}
