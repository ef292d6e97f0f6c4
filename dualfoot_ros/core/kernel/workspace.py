"""The arrays of the kernel, filled from a configuration and a standstill."""

from __future__ import annotations

import math

import numpy as np

from ..alignment import FootStandstill
from ..config import TrackerConfig
from ..samples.series import FloatArray
from . import layout as at

GAP_SPEED = 1.5  # m/s, how a person may have moved while no data came
GAP_TURN = 0.3  # rad/s
LEVEL_NOISE = 1e-3  # m/s^2, the least by which gravity in the levelled frame is off


class Workspace:
    """The flat float64 and int64 arrays of one tracker; a snapshot is a copy of ``w[:STATE]``."""

    def __init__(self, config: TrackerConfig, rate_hz: float, memory_s: float) -> None:
        """Size the rings to remember ``memory_s`` seconds at ``rate_hz``."""
        self.rate_hz = rate_hz
        ring = max(16, math.ceil(memory_s * rate_hz) + 2)
        self.w = np.zeros(at.workspace_size(ring))
        self.n = np.zeros(at.integer_size(ring), dtype=np.int64)
        self.stamps = np.zeros(ring, dtype=np.int64)
        self.ring = ring
        self._zupt = config.zupt
        self._up = [np.array([0.0, 0.0, 1.0])] * 2  # in body axes
        self._set_constants(config)

    def _set_constants(self, config: TrackerConfig) -> None:
        w, n, noise, stance = self.w, self.n, config.noise, config.stance
        w[at.C_GRAVITY] = config.gravity
        w[at.C_Q_VEL] = noise.accelerometer**2
        w[at.C_Q_ATT] = noise.gyro**2
        w[at.C_Q_BG] = noise.gyro_bias**2
        w[at.C_Q_BA] = noise.accelerometer_bias**2
        w[at.C_BIAS_RATE] = 1.0 / noise.bias_time
        w[at.C_ZUPT_VAR] = config.zupt.std**2
        w[at.C_ZUPT_STILL_VAR] = config.zupt.still_std**2
        w[at.C_ZUPT_RATE_VAR] = config.zupt.rate_std**2
        w[at.C_GLRT_FORCE] = 1.0 / stance.force_std**2
        w[at.C_GLRT_RATE] = 1.0 / stance.gyro_std**2
        w[at.C_GLRT_THRESHOLD] = stance.threshold
        w[at.C_WATCH] = math.inf
        n[at.N_RING] = self.ring
        n[at.N_EPOCH] = -1
        n[at.N_WINDOW] = min(self.ring, max(2, round(stance.window * self.rate_hz)))
        n[at.N_STILL] = max(1, round(config.zupt.still_after * self.rate_hz))
        n[at.N_MIN_STANCE] = max(1, round(stance.min_stance * self.rate_hz))
        n[at.N_MIN_SWING] = max(1, round(stance.min_swing * self.rate_hz))

    @property
    def epoch(self) -> int:
        """Newest epoch, -1 before the first."""
        return int(self.n[at.N_EPOCH])

    @property
    def oldest(self) -> int:
        """Oldest epoch to which the filter can be rolled back."""
        return int(self.n[at.N_OLDEST])

    def foot(self, foot: int, item: str) -> int:
        """Return an integer of the phase machine of ``foot``: N_PHASE, N_START or N_LEAVE."""
        return int(self.n[at.N_FOOT + foot * at.N_STRIDE + getattr(at, item)])

    def snapshot(self, epoch: int) -> FloatArray:
        """Return the state (STATE,) before ``epoch`` as a view."""
        start = at.RINGS + at.SAMPLE * self.ring + at.STATE * (epoch % self.ring)
        return self.w[start : start + at.STATE]

    def states(self) -> list[int]:
        """Return the index of the present state and of every valid snapshot."""
        first = at.RINGS + at.SAMPLE * self.ring
        epochs = range(self.oldest, self.epoch + 1)
        return [0, *(first + at.STATE * (epoch % self.ring) for epoch in epochs)]

    def level(
        self,
        config: TrackerConfig,
        stills: tuple[FootStandstill, FootStandstill],
        origin: FloatArray,
        forward: float,
    ) -> None:
        """Start both feet from a standstill, side by side about ``origin`` (3,); forget the past.

        ``forward`` is the heading (rad) that the feet stand across and the body x axes are given.
        """
        w = self.w
        w[: at.STATE] = 0.0
        c, s = math.cos(forward), math.sin(forward)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        for foot, still in enumerate(stills):
            o = foot * at.FOOT
            aside = config.initial.spacing * (0.5 - foot)
            w[o + at.POS : o + at.POS + 3] = origin + np.array([-s * aside, c * aside, 0.0])
            rotation = turn @ still.levelling()
            w[o + at.ROT : o + at.ROT + 9] = rotation.ravel()
            w[o + at.BG : o + at.BG + 3] = still.angular_rate
            norm = math.sqrt(float(still.specific_force @ still.specific_force))
            w[o + at.BA : o + at.BA + 3] = rotation[2] * (norm - config.gravity)
            constants = at.C_FOOT + foot * at.C_STRIDE
            self._up[foot] = rotation[2]
            self.aim(foot, rotation.T @ np.array([c, s, 0.0]))
            rate = constants + at.C_STILL_RATE
            w[rate : rate + 3] = still.angular_rate
            w[constants + at.C_STILL_NORM] = norm
            self._initial_covariance(config, foot, still, rotation)
        self.n[at.N_OLDEST] = self.n[at.N_EPOCH] + 1

    def aim(self, foot: int, forward: FloatArray) -> None:
        """Put the pivot of a foot below and behind its sensor; ``forward`` (3,) in body axes."""
        up = self._up[foot]
        ahead = forward - up * float(up @ forward)
        ahead /= math.sqrt(float(ahead @ ahead))
        lever = at.C_FOOT + foot * at.C_STRIDE + at.C_LEVER
        self.w[lever : lever + 3] = -self._zupt.lever_arm * up - self._zupt.lever_back * ahead

    def _initial_covariance(
        self, config: TrackerConfig, foot: int, still: FootStandstill, rotation: FloatArray
    ) -> None:
        p0 = config.initial
        stds = [p0.position] * 3 + [p0.velocity] * 3 + [p0.tilt, p0.tilt, p0.yaw]
        stds += [max(p0.gyro_bias, still.rate_scatter)] * 3 + [p0.accelerometer_bias] * 3
        block = at.PLL if foot == 0 else at.PRR
        rows = self.w[block : block + at.BLOCK].reshape(15, at.ROW)[:, :15]
        np.fill_diagonal(rows, np.square(stds))
        _know_level(rows, rotation, config.gravity, max(LEVEL_NOISE, still.force_scatter))

    def bridge(self, gap_s: float) -> None:
        """Get over ``gap_s`` s without data: unknown velocity, a position that may have moved."""
        for foot in range(2):
            o, block = foot * at.FOOT, at.PLL if foot == 0 else at.PRR
            for item, size in ((at.VEL, 3), (at.ALPHA, 3), (at.GAMMA, 3)):
                self.w[o + item : o + item + size] = 0.0
            rows = self.w[block : block + at.BLOCK].reshape(15, at.ROW)
            cross = self.w[at.PLR : at.PLR + at.BLOCK].reshape(15, at.ROW)
            velocity = slice(at.E_VEL, at.E_VEL + 3)
            rows[velocity] = rows[:, velocity] = 0.0
            if foot == 0:
                cross[velocity] = 0.0
            else:
                cross[:, velocity] = 0.0
            for i in range(3):
                rows[at.E_VEL + i, at.E_VEL + i] = GAP_SPEED**2
                rows[at.E_POS + i, at.E_POS + i] += (GAP_SPEED * gap_s) ** 2
                rows[at.E_ATT + i, at.E_ATT + i] += (GAP_TURN * min(gap_s, 10.0)) ** 2
            self.n[at.N_FOOT + foot * at.N_STRIDE + at.N_PHASE] = at.SWING
        self.n[at.N_OLDEST] = self.n[at.N_EPOCH] + 1

    def blocks(self) -> FloatArray:
        """Return a copy of the covariance blocks (3 BLOCK,): left, right, cross."""
        return self.w[at.PLL : at.STATE].copy()

    def covariance(self) -> FloatArray:
        """Return the full covariance (30, 30): left foot's error state, then the right foot's."""
        return joint_covariance(self.w[at.PLL : at.STATE])


def _know_level(rows: FloatArray, rotation: FloatArray, gravity: float, std: float) -> None:
    """Put into P0 ``rows`` (15, 15) that a levelled foot at rest feels gravity only, to ``std``.

    Tilt and accelerometer bias are off by what cancels: the Kalman update of P0 by the error of
    the acceleration, (-g phi_y + b_x, g phi_x + b_y, b_z) with the bias b in navigation axes.
    """
    att, bias = slice(at.E_ATT, at.E_ATT + 3), slice(at.E_BA, at.E_BA + 3)
    tilt, b = float(rows[at.E_ATT, at.E_ATT]), float(rows[at.E_BA, at.E_BA])
    total = gravity**2 * tilt + b + std**2
    for axis in (at.E_ATT, at.E_ATT + 1):
        rows[axis, axis] = tilt * (b + std**2) / total
    level, up = b * (total - b) / total, b * std**2 / (b + std**2)
    block = rotation.T @ np.diag([level, level, up]) @ rotation
    rows[bias, bias] = 0.5 * (block + block.T)
    common = gravity * tilt * b / total
    rows[att, bias] = np.array([-common * rotation[1], common * rotation[0], np.zeros(3)])
    rows[bias, att] = rows[att, bias].T


def joint_covariance(blocks: FloatArray) -> FloatArray:
    """Return the full covariance (30, 30) of the blocks (3 BLOCK,) left, right, cross."""
    ll, rr, lr = blocks.reshape(3, 15, at.ROW)[:, :, :15]
    return np.block([[ll, lr], [lr.T, rr]])
