"""Messages as bytes: to the byte what rclpy makes of a message object, but for its padding."""

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path
from rclpy.serialization import deserialize_message, serialize_message

from dualfoot_ros.nodes.ros.cdr_odometry import OdometryBytes
from dualfoot_ros.nodes.ros.cdr_path import PathBytes, PathPose
from dualfoot_ros.nodes.ros.messages import set_pose, set_time

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
