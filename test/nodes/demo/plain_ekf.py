"""A plain Kalman filter that reads Odometry by the rules of robot_localization, in the plane.

It is written from the documentation of ``ekf_node`` with ``two_d_mode``, to try our messages where
that package cannot be installed: state x, y, yaw in the world frame, velocities and accelerations
in the body's; ``odomN_config`` chooses what of a message is used; frames must agree, or /tf would
be needed; a variance below 1e-9 is not believed; process noise grows with time.  In differential
mode the change between two poses is taken as a velocity, with the sum of both covariances times
the time between.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

X, Y, YAW, VX, VY, VYAW, AX, AY = range(8)
POSE, TWIST = (X, Y, YAW), (VX, VY, VYAW)
IN_SIX = np.ix_([0, 1, 5], [0, 1, 5])
NOISE = np.diag([0.05, 0.05, 0.06, 0.025, 0.025, 0.02, 0.01, 0.01])
"""Process noise a second, as in the template that robot_localization ships."""

LEAST_VARIANCE = 1e-9


class PlainEkf:
    """Extended Kalman filter; ``used`` names the entries of the state that a message measures."""

    def __init__(
        self,
        used: Iterable[int],
        *,
        world_frame: str = "odom",
        base_link_frame: str = "base_footprint",
        differential: bool = False,
        noise: np.ndarray = NOISE,
    ) -> None:
        self.used = list(used)
        self.frames = world_frame, base_link_frame
        self.differential = differential
        self.noise = noise
        self.state = np.zeros(8)
        self.covariance = np.eye(8) * LEAST_VARIANCE
        self.stamp_s: float | None = None
        self._before: tuple[float, np.ndarray, np.ndarray] | None = None

    def add(self, message) -> np.ndarray:
        """Predict to the stamp of an Odometry, correct by it and return the state (8,)."""
        assert (message.header.frame_id, message.child_frame_id) == self.frames
        stamp = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
        if self.stamp_s is not None:
            self._predict(stamp - self.stamp_s)
        self.stamp_s = stamp
        pose = [entry for entry in self.used if entry in POSE]
        twist = [entry for entry in self.used if entry in TWIST]
        if pose and self.differential:
            self._add_difference(pose, stamp, *_pose(message))
        elif pose:
            self._correct(pose, *_pose(message), POSE)
        if twist:
            self._correct(twist, *_twist(message), TWIST)
        return self.state.copy()

    def _predict(self, dt: float) -> None:
        _, _, yaw, vx, vy, _, ax, ay = self.state
        c, s = math.cos(yaw), math.sin(yaw)
        along, across = vx * dt + ax * dt**2 / 2, vy * dt + ay * dt**2 / 2
        step = np.eye(8)
        step[X, [VX, VY, AX, AY]] = c * dt, -s * dt, c * dt**2 / 2, -s * dt**2 / 2
        step[Y, [VX, VY, AX, AY]] = s * dt, c * dt, s * dt**2 / 2, c * dt**2 / 2
        step[[YAW, VX, VY], [VYAW, AX, AY]] = dt
        jacobian = step.copy()
        jacobian[X, YAW] = -s * along - c * across
        jacobian[Y, YAW] = c * along - s * across
        self.state = step @ self.state
        self.state[YAW] = math.remainder(self.state[YAW], math.tau)
        self.covariance = jacobian @ self.covariance @ jacobian.T + self.noise * dt

    def _add_difference(
        self, pose: list[int], stamp: float, measured: np.ndarray, variance: np.ndarray
    ) -> None:
        before, self._before = self._before, (stamp, measured, variance)
        if before is None:
            return
        dt, change = stamp - before[0], measured - before[1]
        c, s = math.cos(before[1][YAW]), math.sin(before[1][YAW])
        turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        change[YAW] = math.remainder(change[YAW], math.tau)
        noise = turn @ (variance + before[2]) @ turn.T * dt
        self._correct([TWIST[entry] for entry in pose], turn @ change / dt, noise, TWIST)

    def _correct(
        self, entries: list[int], measured: np.ndarray, variance: np.ndarray, of: tuple[int, ...]
    ) -> None:
        rows = [of.index(entry) for entry in entries]
        noise = variance[np.ix_(rows, rows)]
        noise[np.diag_indices(len(rows))] = np.maximum(np.diag(noise), LEAST_VARIANCE)
        innovation = measured[rows] - self.state[entries]
        if YAW in entries:
            k = entries.index(YAW)
            innovation[k] = math.remainder(innovation[k], math.tau)
        cross = self.covariance[:, entries]
        gain = np.linalg.solve((cross[entries] + noise).T, cross.T).T
        rest = np.eye(8)
        rest[:, entries] -= gain
        self.state = self.state + gain @ innovation
        self.state[YAW] = math.remainder(self.state[YAW], math.tau)
        self.covariance = rest @ self.covariance @ rest.T + gain @ noise @ gain.T


def _pose(message) -> tuple[np.ndarray, np.ndarray]:
    p, q = message.pose.pose.position, message.pose.pose.orientation
    yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y**2 + q.z**2))
    return np.array([p.x, p.y, yaw]), np.reshape(message.pose.covariance, (6, 6))[IN_SIX]


def _twist(message) -> tuple[np.ndarray, np.ndarray]:
    linear, angular = message.twist.twist.linear, message.twist.twist.angular
    values = np.array([linear.x, linear.y, angular.z])
    return values, np.reshape(message.twist.covariance, (6, 6))[IN_SIX]
