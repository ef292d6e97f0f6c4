"""The yardstick: the same 30-state filter in dense numpy, as one writes it from the paper.

Liu et al. 2023, eqs (1)-(12), without structure, cleverness or compiler.  It stands for the speed
of the machine, so that figures of two machines (or two hours of one) can be compared as ratios.
"""

from __future__ import annotations

import math

import numpy as np

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.samples.series import FloatArray


class DenseFilter:
    """Both feet's navigation states and their joint covariance (30, 30)."""

    def __init__(self, config: TrackerConfig) -> None:
        """Start level and at rest."""
        noise = config.noise
        self.gravity = np.array([0.0, 0.0, -config.gravity])
        self.tau = noise.bias_time
        self.R = np.eye(3) * config.zupt.std**2
        stds = [0.0] * 3 + [noise.accelerometer] * 3 + [noise.gyro] * 3
        stds += [noise.gyro_bias] * 3 + [noise.accelerometer_bias] * 3
        self.Q = np.diag(np.square(stds * 2))
        self.P = np.eye(30) * 1e-4
        self.r, self.v = np.zeros((2, 3)), np.zeros((2, 3))
        self.C = np.tile(np.eye(3), (2, 1, 1))
        self.bg, self.ba = np.zeros((2, 3)), np.zeros((2, 3))
        self.alpha, self.gamma = np.zeros((2, 3)), np.zeros((2, 3))

    def epoch(self, dt: float, sample: FloatArray, stance: tuple[bool, bool]) -> None:
        """Run one epoch over a sample (12,)."""
        Phi = np.eye(30)
        for foot in range(2):
            own = 15 * foot
            f_n = self._mechanize(foot, dt, sample[6 * foot : 6 * foot + 6])
            F = np.zeros((15, 15))
            F[0:3, 3:6] = np.eye(3)
            F[3:6, 6:9], F[3:6, 12:15] = cross(f_n), self.C[foot]
            F[6:9, 9:12] = -self.C[foot]
            F[9:15, 9:15] = -np.eye(6) / self.tau
            Phi[own : own + 15, own : own + 15] += F * dt
        self.P = Phi @ self.P @ Phi.T + 0.5 * (Phi @ self.Q @ Phi.T + self.Q) * dt
        for foot in range(2):
            if stance[foot]:
                self._zupt(foot)

    def _mechanize(self, foot: int, dt: float, sample: FloatArray) -> FloatArray:
        gamma = (sample[:3] - self.ba[foot]) * dt
        alpha = (sample[3:] - self.bg[foot]) * dt
        sculling = np.cross(self.alpha[foot], gamma) + np.cross(self.gamma[foot], alpha)
        push = self.C[foot] @ (gamma + 0.5 * np.cross(alpha, gamma) + sculling / 12.0)
        after = self.v[foot] + push + self.gravity * dt
        self.r[foot] += 0.5 * (self.v[foot] + after) * dt
        self.v[foot] = after
        self.C[foot] = self.C[foot] @ rotation(alpha + np.cross(self.alpha[foot], alpha) / 12.0)
        self.alpha[foot], self.gamma[foot] = alpha, gamma
        return push / dt

    def _zupt(self, foot: int) -> None:
        H = np.zeros((3, 30))
        H[:, 15 * foot + 3 : 15 * foot + 6] = np.eye(3)
        K = self.P @ H.T @ np.linalg.inv(H @ self.P @ H.T + self.R)
        error = K @ self.v[foot]
        J = np.eye(30) - K @ H
        self.P = J @ self.P @ J.T + K @ self.R @ K.T
        for f in range(2):
            part = error[15 * f : 15 * f + 15]
            self.r[f] -= part[0:3]
            self.v[f] -= part[3:6]
            self.C[f] = rotation(part[6:9]) @ self.C[f]
            self.bg[f] += part[9:12]
            self.ba[f] += part[12:15]


def cross(v: FloatArray) -> FloatArray:
    """Return [v x]."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def rotation(v: FloatArray) -> FloatArray:
    """Return exp([v x])."""
    angle, skew = math.sqrt(v @ v), cross(v)
    if angle < 1e-9:
        return np.eye(3) + skew
    a, b = math.sin(angle) / angle, (1.0 - math.cos(angle)) / angle**2
    return np.eye(3) + a * skew + b * skew @ skew
