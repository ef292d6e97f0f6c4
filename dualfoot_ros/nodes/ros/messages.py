"""Conversion of messages to arrays and back."""

from __future__ import annotations

import math

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose, PoseStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from ...core import (
    FloatArray,
    FootEstimate,
    PersonEstimate,
    SmoothedPerson,
    quaternion_matrix,
    quaternion_yaw,
    yaw_quaternion,
)

SECOND = 1_000_000_000
LEAST_NORM = 1e-6  # of a quaternion; a smaller one is none
ROLLING_VARIANCE = 1.0e3  # (rad/s)^2; how the person rolls and pitches is not estimated


def to_ns(time: Time) -> int:
    """Return a stamp in ns."""
    return int(time.sec) * SECOND + int(time.nanosec)


def set_time(time: Time, stamp_ns: int) -> None:
    """Put ``stamp_ns`` into ``time``."""
    time.sec, time.nanosec = divmod(stamp_ns, SECOND)


def imu_values(message: Imu) -> FloatArray:
    """Return specific force and angular rate (6,) of a message."""
    force, rate = message.linear_acceleration, message.angular_velocity
    return np.array([force.x, force.y, force.z, rate.x, rate.y, rate.z])


def set_imu_values(message: Imu, values: FloatArray) -> None:
    """Put specific force and angular rate (6,) into a message."""
    force, rate = message.linear_acceleration, message.angular_velocity
    force.x, force.y, force.z, rate.x, rate.y, rate.z = values.tolist()


def new_imu(frame_id: str) -> Imu:
    """Return a message without orientation and of unknown covariance, as in REP 145."""
    message = Imu()
    message.header.frame_id = frame_id
    message.orientation_covariance[0] = -1.0
    return message


def set_pose(pose: Pose, position: FloatArray, quaternion: FloatArray) -> None:
    """Put position (3,) m and quaternion (x, y, z, w) into ``pose``."""
    p, q = pose.position, pose.orientation
    p.x, p.y, p.z = position.tolist()
    q.x, q.y, q.z, q.w = quaternion.tolist()


def new_odometry(frame_id: str, child_frame_id: str) -> Odometry:
    """Return an empty message between two frames."""
    message = Odometry(child_frame_id=child_frame_id)
    message.header.frame_id = frame_id
    return message


def fill_foot(message: Odometry, stamp_ns: int, foot: FootEstimate, rate_variance: float) -> None:
    """Put a foot's estimate into ``message``; the twist in the child frame.

    ``rate_variance`` (rad/s)^2 is the noise of one angular rate.
    """
    set_time(message.header.stamp, stamp_ns)
    set_pose(message.pose.pose, foot.position, foot.quaternion)
    message.pose.covariance = foot.pose_covariance().ravel()
    to_body = quaternion_matrix(foot.quaternion).T
    linear, angular = message.twist.twist.linear, message.twist.twist.angular
    linear.x, linear.y, linear.z = (to_body @ foot.velocity).tolist()
    angular.x, angular.y, angular.z = foot.angular_rate.tolist()
    covariance = to_body @ foot.twist_covariance() @ to_body.T
    message.twist.covariance = _twist_covariance(covariance, rate_variance)


def fill_person(message: Odometry, person: PersonEstimate) -> None:
    """Put the person's estimate into ``message``; the twist in the child frame."""
    quaternion = yaw_quaternion(person.heading)
    to_body = quaternion_matrix(quaternion).T
    set_time(message.header.stamp, person.stamp_ns)
    set_pose(message.pose.pose, person.position, quaternion)
    message.pose.covariance = person.pose_covariance.ravel()
    _set_twist(message, to_body @ person.velocity, person.yaw_rate)
    covariance = to_body @ person.velocity_covariance @ to_body.T
    message.twist.covariance = _level_twist_covariance(covariance, person.yaw_rate_variance)


def fill_smoothed(message: Odometry, person: SmoothedPerson) -> None:
    """Put the smoothed person into ``message``; the twist in the child frame."""
    set_time(message.header.stamp, person.stamp_ns)
    set_pose(message.pose.pose, person.position, yaw_quaternion(person.heading))
    message.pose.covariance = person.pose_covariance.ravel()
    _set_twist(message, person.velocity, person.yaw_rate)
    message.twist.covariance = _level_twist_covariance(
        person.velocity_covariance, person.yaw_rate_variance
    )


def _set_twist(message: Odometry, velocity: FloatArray, yaw_rate: float) -> None:
    """Put velocity (3,) m/s in the child frame and yaw rate (rad/s) into ``message``."""
    linear = message.twist.twist.linear
    linear.x, linear.y, linear.z = velocity.tolist()
    message.twist.twist.angular.z = yaw_rate


def pose_stamped(frame_id: str, stamp_ns: int, position: FloatArray, q: FloatArray) -> PoseStamped:
    """Return a pose with its stamp."""
    message = PoseStamped()
    message.header.frame_id = frame_id
    set_time(message.header.stamp, stamp_ns)
    set_pose(message.pose, position, q)
    return message


def pose_of(pose: Pose) -> tuple[FloatArray, FloatArray]:
    """Return position (3,) and quaternion (x, y, z, w) of ``pose``."""
    p, q = pose.position, pose.orientation
    return np.array([p.x, p.y, p.z]), np.array([q.x, q.y, q.z, q.w])


def pose_yaw(pose: Pose) -> tuple[FloatArray, float] | None:
    """Return position (3,) m and yaw (rad) of ``pose``, or None when they are not finite."""
    position, quaternion = pose_of(pose)
    norm = float(np.linalg.norm(quaternion))
    if not (np.isfinite(position).all() and LEAST_NORM < norm < math.inf):
        return None
    return position, quaternion_yaw(quaternion / norm)


def pose_covariance(values: FloatArray) -> FloatArray | None:
    """Return the covariance (4, 4) of x, y, z and yaw in that (36,) of a message.

    None where it is all zero, which says that it is not known.
    """
    known = np.array(values, dtype=np.float64).reshape(6, 6)[np.ix_(*[[0, 1, 2, 5]] * 2)]
    return known if known.any() else None


def _twist_covariance(linear: FloatArray, rate_variance: float) -> FloatArray:
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = linear
    covariance[[3, 4, 5], [3, 4, 5]] = rate_variance
    return covariance.ravel()


def _level_twist_covariance(linear: FloatArray, yaw_rate_variance: float) -> FloatArray:
    """Return the covariance (36,) of a twist of which roll and pitch rate are not known."""
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = linear
    covariance[[3, 4], [3, 4]] = ROLLING_VARIANCE
    covariance[5, 5] = yaw_rate_variance
    return covariance.ravel()
