"""Messages as bytes: to the byte what rclpy makes of a message object, but for its padding."""

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path
from rclpy.serialization import deserialize_message, serialize_message

from dualfoot_ros.nodes.ros.cdr_imu import FilledImu, ImuBytes, encoded
from dualfoot_ros.nodes.ros.cdr_odometry import OdometryBytes, OdometryNumbers
from dualfoot_ros.nodes.ros.cdr_path import PathBytes, PathPose
from dualfoot_ros.nodes.ros.messages import new_imu, set_imu_values, set_pose, set_time

STAMP = 1_795_912_595_012_154_974
FRAMES = [("odom", "left_foot"), ("o", "b"), ("", ""), ("längs/odom", "base_footprint")]


def assert_same(made, message):
    """Assert that the bytes are those of the message; the padding of rclpy is what was there."""
    theirs = serialize_message(message)
    assert deserialize_message(made, type(message)) == message
    assert len(made) == len(theirs)
    different = [a for a, b in zip(made, theirs, strict=True) if a != b]
    assert not any(different)


def numbers(count, seed=0):
    return np.random.default_rng(seed).normal(size=count)


@pytest.mark.parametrize(("frame", "child"), FRAMES)
def test_odometry_is_the_message_of_rclpy(frame, child):
    made, message = OdometryBytes(frame, child), Odometry(child_frame_id=child)
    message.header.frame_id = frame
    for seed in range(2):  # the second time over what is there
        position, quaternion, rest = numbers(3, seed), numbers(4, seed), numbers(6, seed)
        pose, twist = numbers((6, 6), seed), numbers((6, 6), seed + 9)
        made.stamp(STAMP + seed)
        made.position[:], made.quaternion[:] = position, quaternion
        made.linear[:], made.angular[:] = rest[:3], rest[3:]
        made.pose_covariance[:], made.twist_covariance[:] = pose, twist
        set_time(message.header.stamp, STAMP + seed)
        set_pose(message.pose.pose, position, quaternion)
        linear, angular = message.twist.twist.linear, message.twist.twist.angular
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z = rest.tolist()
        message.pose.covariance, message.twist.covariance = pose.ravel(), twist.ravel()
        assert_same(made.data(), message)
        read = OdometryNumbers([serialize_message(message), made.data()])
        assert read.stamp_ns.tolist() == [STAMP + seed] * 2
        for k in range(2):
            assert read.position[k].tolist() == position.tolist()
            assert read.quaternion[k].tolist() == quaternion.tolist()
            assert read.linear[k].tolist() == rest[:3].tolist()
            assert read.pose_covariance[k].tolist() == pose.tolist()
            assert read.twist_covariance[k].tolist() == twist.tolist()


def path_message(frame, poses):
    """Return the path of these poses as an object."""
    message = Path()
    message.header.frame_id = frame
    if poses:
        set_time(message.header.stamp, poses[-1].stamp_ns)
    for pose in poses:
        each = PoseStamped()
        each.header.frame_id = frame
        set_time(each.header.stamp, pose.stamp_ns)
        set_pose(each.pose, pose.position, pose.quaternion)
        message.poses.append(each)
    return message


@pytest.mark.parametrize("frame", ["odom", "", "o", "a/longer/odom", "seven__"])
def test_a_path_is_the_message_of_rclpy(frame):
    poses = [PathPose(STAMP + k, numbers(3, k), numbers(4, k)) for k in range(6)]
    path = PathBytes(frame, 3)
    assert_same(path.data(None), path_message(frame, []))
    assert_same(path.data(poses[0]), path_message(frame, poses[:1]))
    for k, pose in enumerate(poses[:-1]):
        path.append(pose)
        kept = poses[max(0, k - 2) : k + 1]
        assert_same(path.data(None), path_message(frame, kept))
        assert_same(path.data(poses[5]), path_message(frame, [*kept, poses[5]]))
    path.replace(poses[:2])
    assert_same(path.data(None), path_message(frame, poses[:2]))


def swapped(data):
    """Return an Imu message with the order of the bytes of the other kind of processor."""
    body, out, at = data[4:], bytearray(b"\0\0\0\0"), 0
    length = int.from_bytes(body[8:12], "little")
    while at < len(body):
        if at == 12:
            out += body[12 : 12 + length]
            at += length
            out += bytes(-at % 8)
            at += -at % 8
        size = 4 if at < 12 else 8
        out += body[at : at + size][::-1]
        at += size
    return bytes(out)


@pytest.mark.parametrize("other_order", [False, True])
@pytest.mark.parametrize("frame", ["", "i", "imu", "imu1", "left_imu", "längs/imu", 99 * "x"])
def test_a_sample_is_read_from_bytes_as_from_the_message_of_rclpy(frame, other_order):
    message = new_imu(frame)
    set_time(message.header.stamp, STAMP)
    message.orientation_covariance = numbers(9, 1)
    message.angular_velocity_covariance = numbers(9, 2)
    message.linear_acceleration_covariance = numbers(9, 3)
    values = np.array([1.0, -2.0, np.nan, -np.inf, -0.0, 5e-324])
    set_imu_values(message, values)
    data = serialize_message(message)
    read = ImuBytes(swapped(data) if other_order else data)
    assert read.stamp_ns == STAMP
    assert read.values.tobytes() == values.tobytes()
    assert read.message.header == message.header
    np.testing.assert_array_equal(
        read.message.linear_acceleration_covariance, message.linear_acceleration_covariance
    )


def sensed(frame, seed):
    """Return a message with everything in it."""
    message = new_imu(frame)
    set_time(message.header.stamp, STAMP + seed)
    turn = message.orientation
    turn.x, turn.y, turn.z, turn.w = numbers(4, seed).tolist()
    message.orientation_covariance = numbers(9, seed + 1)
    message.angular_velocity_covariance = numbers(9, seed + 2)
    message.linear_acceleration_covariance = numbers(9, seed + 3)
    set_imu_values(message, numbers(6, seed + 4))
    return message


@pytest.mark.parametrize("frame", ["", "i", "imu1", "left_imu", "längs/imu"])
def test_a_message_is_encoded_as_by_rclpy(frame):
    assert_same(encoded(sensed(frame, 1)), sensed(frame, 1))


@pytest.mark.parametrize("frames", [("left_imu",) * 3, ("", "i", "längs/imu"), ("imu1", "", "x")])
def test_a_filled_sample_has_frame_and_covariances_of_the_newest_that_it_follows(frames):
    filled = FilledImu("before")
    assert_same(filled.data(STAMP, np.zeros(6)), filled_message(new_imu("before"), np.zeros(6)))
    for seed, frame in enumerate(frames):
        came = sensed(frame, seed)
        filled.follow(ImuBytes(serialize_message(came)))
        for k in range(2):
            values = numbers(6, k)
            assert_same(filled.data(STAMP, values), filled_message(came, values))


def filled_message(came, values):
    """Return what a message without orientation takes of one that came, as an object."""
    message = new_imu(came.header.frame_id)
    set_time(message.header.stamp, STAMP)
    message.angular_velocity_covariance = came.angular_velocity_covariance
    message.linear_acceleration_covariance = came.linear_acceleration_covariance
    set_imu_values(message, values)
    return message
