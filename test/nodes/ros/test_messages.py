import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import quaternion_matrix, yaw_quaternion
from dualfoot_ros.nodes.ros.messages import (
    imu_values,
    new_imu,
    pose_of,
    pose_yaw,
    set_imu_values,
    set_pose,
    set_time,
    to_ns,
)

angles = st.floats(-3.1, 3.1)
numbers = st.floats(-1e3, 1e3)


@given(st.integers(0, 2**31 * 10**9 - 1))
def test_a_stamp_survives_the_message_to_the_nanosecond(stamp_ns):
    time = Time()
    set_time(time, stamp_ns)
    assert to_ns(time) == stamp_ns


@given(arrays(np.float64, 6, elements=numbers))
def test_a_sample_survives_the_message_to_the_bit(values):
    message = new_imu("sensor")
    set_imu_values(message, values)
    np.testing.assert_array_equal(imu_values(message), values)


def test_a_sample_without_orientation_says_so_as_in_rep_145():
    assert new_imu("sensor").orientation_covariance[0] == -1.0
    assert not np.any(new_imu("sensor").angular_velocity_covariance)


@given(angles, angles, angles)
def test_rotation_matrix_is_that_of_scipy(a, b, c):
    rotation = Rotation.from_euler("xyz", [a, b, c])
    np.testing.assert_allclose(
        quaternion_matrix(rotation.as_quat()), rotation.as_matrix(), atol=1e-14
    )


@given(arrays(np.float64, 3, elements=numbers), angles)
def test_position_and_heading_of_a_pose_are_read_back(position, yaw):
    pose = Pose()
    set_pose(pose, position, yaw_quaternion(yaw))
    np.testing.assert_array_equal(pose_of(pose)[0], position)
    found = pose_yaw(pose)
    assert found is not None
    np.testing.assert_allclose(found[1], yaw, atol=1e-12)


def test_a_pose_that_is_no_number_or_has_no_orientation_is_none():
    pose = Pose()
    pose.position.x = float("nan")
    assert pose_yaw(pose) is None
    empty = Pose()
    empty.orientation.w = 0.0
    assert pose_yaw(empty) is None
