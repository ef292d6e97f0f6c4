"""Bags whose clock, that of the stamps and of the log, was set back by a second in the middle."""

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from dualfoot_ros.recording import cdr, read_logged
from dualfoot_ros.recording.topics import IMU_TYPE

from .foreign import STORE, STORE1, imu_message

TOPIC = "/left/imu/data_raw"
COUNT, AT = 300, 200


def log_times():
    """Return the log times (N,) ns in the order of the recording."""
    log_ns = 10**18 + np.arange(COUNT) * 10_000_000
    log_ns[AT:] -= 1_000_000_000
    return log_ns


def ros2(path, storage, *, compressed=False):
    """Write a bag of ROS 2."""
    writer = Writer(path, version=9, storage_plugin=StoragePlugin[storage.upper()])
    if compressed:
        writer.set_compression(CompressionMode.MESSAGE, CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection(TOPIC, IMU_TYPE, typestore=STORE)
        for k, log_ns in enumerate(log_times().tolist()):
            row = cdr.encode(np.array([log_ns]), np.full((1, 37), float(k)), ("imu",))
            writer.write(connection, log_ns, row.tobytes())
    return path


def ros1(path):
    """Write a bag of ROS 1 with several chunks, and two publishers that take turns."""
    types = STORE1.types
    time, header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    writer = Writer1(path)
    writer.chunk_threshold = 1 << 14
    with writer:
        publishers = [
            writer.add_connection(TOPIC, IMU_TYPE, typestore=STORE1, callerid=name)
            for name in ("/one", "/other")
        ]
        for k, log_ns in enumerate(log_times().tolist()):
            head = header(seq=k, stamp=time(*divmod(log_ns, 10**9)), frame_id="imu")
            message = imu_message(types, head, [float(k)] * 3, [float(k)] * 3)
            data = STORE1.serialize_ros1(message, IMU_TYPE)
            writer.write(publishers[k % 2], log_ns, data)
    return path


def assert_in_order(path):
    """Assert that a bag is read in the order of its recording."""
    recording, times = read_logged(path)
    assert recording.left.angular_rate[:, 0].tolist() == [float(k) for k in range(COUNT)]
    assert np.array_equal(recording.left.stamp_ns, log_times())
    assert np.array_equal(times["left"], log_times())
