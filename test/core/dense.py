"""The filter of Liu et al. 2023 in dense matrices, written from the paper alone, as an oracle.

Errors as the paper has them: estimate minus truth for position and velocity, C_hat =
(I - [phi x]) C for the attitude, and what is left of the biases, truth minus estimate.  That last
sign follows from eq. (6): with phi' = -C b_g and C_hat driven by the measured minus the estimated
rate, b_g must be what has not been taken off yet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.kernel import layout as lay

from .harness import cross_matrix

AS_THE_PAPER = {"zupt.heading_correction": "full", "zupt.std_rate": 0.0}
POS, VEL, ATT, BG, BA = (slice(3 * i, 3 * i + 3) for i in range(5))


def transition(C: np.ndarray, f_n: np.ndarray, tau: float, dt: float) -> np.ndarray:
    """Return Phi (15, 15) of eqs (6) and (8)."""
    F = np.zeros((15, 15))
    F[POS, VEL] = np.eye(3)
    F[VEL, ATT], F[VEL, BA] = cross_matrix(f_n), C
    F[ATT, BG] = -C
    F[BG, BG] = F[BA, BA] = -np.eye(3) / tau
    return np.eye(15) + F * dt


def noise_powers(config: TrackerConfig) -> np.ndarray:
    """Return the diagonal of Q_s (15,)."""
    n = config.noise
    stds = [0.0] * 3 + [n.accelerometer] * 3 + [n.gyro] * 3
    stds += [n.gyro_bias] * 3 + [n.accelerometer_bias] * 3
    return np.square(stds)


def propagated(P: np.ndarray, Phi: np.ndarray, Q: np.ndarray, dt: float) -> np.ndarray:
    """Return the covariance after one epoch, eqs (8) and (10)."""
    return Phi @ P @ Phi.T + 0.5 * (Phi @ Q @ Phi.T + Q) * dt


def joseph(P, H, R, y) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Return (error, P, S, NIS) of a Kalman update with innovation ``y``."""
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    J = np.eye(len(P)) - K @ H
    return K @ y, J @ P @ J.T + K @ R @ K.T, S, float(y @ np.linalg.solve(S, y))


def considering(P, H, R, y, T) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Return (error, P, K, NIS) of an update that takes the combinations ``T`` (n, c) as known.

    The gain is that of a filter without the uncertainty that T explains; P is carried in Joseph's
    form, which holds for any gain.
    """
    known = P @ T
    left = P - known @ np.linalg.solve(T.T @ P @ T, known.T)
    K = np.linalg.solve(H @ left @ H.T + R, H @ left).T
    J = np.eye(len(P)) - K @ H
    nis = float(y @ np.linalg.solve(H @ left @ H.T + R, y))
    return K @ y, J @ P @ J.T + K @ R @ K.T, K, nis


@dataclass
class DenseFoot:
    """One foot's 15-state filter."""

    config: TrackerConfig
    r: np.ndarray
    v: np.ndarray
    C: np.ndarray
    bg: np.ndarray
    ba: np.ndarray
    lever: np.ndarray
    P: np.ndarray
    alpha: np.ndarray
    gamma: np.ndarray
    rate: np.ndarray

    @classmethod
    def start(cls, config: TrackerConfig, w: np.ndarray, foot: int) -> DenseFoot:
        """Start as the foot of a workspace stands."""
        o, block = foot * lay.FOOT, lay.PRR if foot else lay.PLL
        lever = lay.C_FOOT + foot * lay.C_STRIDE + lay.C_LEVER
        three = [w[i : i + 3].copy() for i in (o + lay.POS, o + lay.VEL, o + lay.BG, o + lay.BA)]
        P = w[block : block + lay.BLOCK].reshape(15, lay.ROW)[:, :15].copy()
        C = w[o + lay.ROT : o + lay.ROT + 9].reshape(3, 3).copy()
        before = [w[o + i : o + i + 3].copy() for i in (lay.ALPHA, lay.GAMMA, lay.RATE)]
        return cls(config, three[0], three[1], C, *three[2:], w[lever : lever + 3], P, *before)

    def propagate(self, dt: float, sample: np.ndarray) -> None:
        """Run eqs (1)-(3), (8) and (10) over one sample (6,)."""
        self.rate = sample[3:] - self.bg
        gamma, alpha = (sample[:3] - self.ba) * dt, self.rate * dt
        sculling = np.cross(self.alpha, gamma) + np.cross(self.gamma, alpha)
        push = self.C @ (gamma + np.cross(alpha, gamma) / 2.0 + sculling / 12.0)
        Phi = transition(self.C, push / dt, self.config.noise.bias_time, dt)
        self.P = propagated(self.P, Phi, np.diag(noise_powers(self.config)), dt)
        after = self.v + push + np.array([0.0, 0.0, -self.config.gravity]) * dt
        self.r = self.r + 0.5 * (self.v + after) * dt
        self.v = after
        turn = alpha + np.cross(self.alpha, alpha) / 12.0
        self.C = self.C @ Rotation.from_rotvec(turn).as_matrix()
        self.alpha, self.gamma = alpha, gamma

    def zupt(self) -> None:
        """Set the velocity of the pivot to zero, eq. (12) with a lever arm."""
        z = self.config.zupt
        level = np.diag([1.0, 1.0, 0.0])  # a turn about the vertical sweeps nothing
        rate, lever = self.C @ self.rate, self.C @ self.lever
        swept = np.cross(level @ rate, lever)
        H = np.zeros((3, 15))
        H[:, VEL] = np.eye(3)
        H[:, ATT] = cross_matrix(level @ rate) @ cross_matrix(lever)
        H[:, ATT] -= cross_matrix(lever) @ level @ cross_matrix(rate)
        H[:, BG] = -cross_matrix(lever) @ level @ self.C
        R = np.eye(3) * (z.std**2 + z.rate_std**2 * float(self.rate @ self.rate))
        error, self.P, _, _ = joseph(self.P, H, R, self.v + swept)
        self.r, self.v = self.r - error[POS], self.v - error[VEL]
        self.C = Rotation.from_rotvec(error[ATT]).as_matrix() @ self.C
        self.bg, self.ba = self.bg + error[BG], self.ba + error[BA]
