"""Bags as other programs leave them: of ROS 1, cut off, without metadata, with split topics."""

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
STORE1 = get_typestore(Stores.ROS1_NOETIC)


def imu_message(types, header, force, rate):
    """Return a sensor_msgs/Imu of the type store ``types``."""
    vector, quaternion = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    return types["sensor_msgs/msg/Imu"](
        header=header,
        orientation=quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
        orientation_covariance=np.zeros(9),
        angular_velocity=vector(*rate),
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector(*force),
        linear_acceleration_covariance=np.zeros(9),
    )


def ros1_bag(path, topics, texts=None):
    """Write a ``.bag`` of ROS 1; ``topics`` is topic -> ImuSeries, ``texts`` topic -> text."""
    time, header = (
        STORE1.types[t] for t in ("builtin_interfaces/msg/Time", "std_msgs/msg/Header")
    )
    kind = "sensor_msgs/msg/Imu"
    with Writer1(path) as writer:
        for topic, series in topics.items():
            connection = writer.add_connection(topic, kind, typestore=STORE1)
            for k, stamp in enumerate(series.stamp_ns.tolist()):
                head = header(seq=k, stamp=time(*divmod(stamp, 10**9)), frame_id="imu")
                message = imu_message(
                    STORE1.types, head, series.specific_force[k], series.angular_rate[k]
                )
                writer.write(connection, stamp, STORE1.serialize_ros1(message, kind))
        for topic, text in (texts or {}).items():
            string = "std_msgs/msg/String"
            connection = writer.add_connection(topic, string, typestore=STORE1)
            message = STORE1.types[string](data=text)
            writer.write(connection, 0, STORE1.serialize_ros1(message, string))
    return path


def ros2_bag(path, topics, *, stamps=None, logged=None, storage="mcap"):
    """Write a bag of ROS 2; ``topics`` is topic -> (stamps (N,) ns, vectors (N, 3)) or ImuSeries.

    ``stamps`` replaces all stamps of headers, ``logged`` gives the log times of a topic.
    """
    types = STORE.types
    time, header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    vector = types["geometry_msgs/msg/Vector3"]
    stamped = types["geometry_msgs/msg/Vector3Stamped"]
    messages = []
    with Writer(path, version=9, storage_plugin=StoragePlugin[storage.upper()]) as writer:
        for topic, series in topics.items():
            split = isinstance(series, tuple)
            kind = (stamped if split else types["sensor_msgs/msg/Imu"]).__msgtype__
            connection = writer.add_connection(topic, kind, typestore=STORE)
            own = series[0] if split else series.stamp_ns
            for k, stamp in enumerate(own.tolist()):
                head_ns = stamp if stamps is None else int(stamps[k])
                head = header(stamp=time(*divmod(head_ns, 10**9)), frame_id="imu")
                if split:
                    message = stamped(header=head, vector=vector(*series[1][k]))
                else:
                    message = imu_message(
                        types, head, series.specific_force[k], series.angular_rate[k]
                    )
                log_ns = stamp if logged is None else int(logged[k])
                messages.append((log_ns, connection, STORE.serialize_cdr(message, kind)))
        for log_ns, connection, data in sorted(messages, key=lambda item: item[0]):
            writer.write(connection, log_ns, data)
    return path


def cut(path, share):
    """Cut the one file of a bag to a share of its size."""
    (file,) = [f for f in path.iterdir() if f.suffix in (".mcap", ".db3")]
    file.write_bytes(file.read_bytes()[: int(file.stat().st_size * share)])
    return path
