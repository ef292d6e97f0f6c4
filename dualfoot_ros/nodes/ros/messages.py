"""Conversion of messages to arrays and back."""

from __future__ import annotations

import math

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose
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
from .cdr_odometry import OdometryBytes

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


def fill_foot(
    message: OdometryBytes, stamp_ns: int, foot: FootEstimate, rate_variance: float
) -> None:
    """Put a foot's estimate into ``message``; the twist in the child frame.

    ``rate_variance`` (rad/s)^2 is the noise of one angular rate.
    """
    message.stamp(stamp_ns)
    message.position[:] = foot.position
    message.quaternion[:] = foot.quaternion
    message.pose_covariance[:] = foot.pose_covariance()
    to_body = quaternion_matrix(foot.quaternion).T
    message.linear[:] = to_body @ foot.velocity
    message.angular[:] = foot.angular_rate
    message.twist_covariance[:3, :3] = to_body @ foot.twist_covariance() @ to_body.T
    message.twist_variances[3:] = rate_variance


def fill_person(message: OdometryBytes, person: PersonEstimate) -> None:
    """Put the person's estimate into ``message``; the twist in the child frame."""
    quaternion = yaw_quaternion(person.heading)
    to_body = quaternion_matrix(quaternion).T
    message.stamp(person.stamp_ns)
    message.position[:], message.quaternion[:] = person.position, quaternion
    message.pose_covariance[:] = person.pose_covariance
    message.linear[:] = to_body @ person.velocity
    covariance = to_body @ person.velocity_covariance @ to_body.T
    _set_level_twist(message, covariance, person.yaw_rate, person.yaw_rate_variance)


def fill_smoothed(message: OdometryBytes, person: SmoothedPerson) -> None:
    """Put the smoothed person into ``message``; the twist in the child frame."""
    message.stamp(person.stamp_ns)
    message.position[:], message.quaternion[:] = person.position, yaw_quaternion(person.heading)
    message.pose_covariance[:] = person.pose_covariance
    message.linear[:] = person.velocity
    variance = person.yaw_rate_variance
    _set_level_twist(message, person.velocity_covariance, person.yaw_rate, variance)


def _set_level_twist(
    message: OdometryBytes, covariance: FloatArray, yaw_rate: float, variance: float
) -> None:
    """Put what is known of a twist into it: of roll and pitch rate, nothing."""
    message.angular[2] = yaw_rate
    message.twist_covariance[:3, :3] = covariance
    message.twist_variances[3:5] = ROLLING_VARIANCE
    message.twist_variances[5] = variance


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
