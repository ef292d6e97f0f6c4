"""The state a track starts from: constants, levelled attitude, biases and P0 of both feet."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..alignment import FootStandstill
from ..config import TrackerConfig
from ..kernel import Workspace
from ..kernel import layout as lay
from ..results.events import FEET
from ..rotation import about_z
from ..samples.increments import Increments
from ..samples.series import FloatArray

KINDS = {
    Increments.COMPENSATED: lay.COMPENSATED,
    Increments.AVERAGED: lay.AVERAGED,
    Increments.SAMPLED: lay.SAMPLED,
}
LEVEL_NOISE = 1e-3  # m/s^2, the least by which gravity in the levelled frame is off
LONGEST_STANCE_S = 0.8  # of a stance that is not one of a stop
MOVING_STD = 2.0  # m/s, velocity of a foot that may be swinging at the start


class InitialState:
    """Fills a workspace from a configuration and a standstill."""

    def __init__(
        self,
        config: TrackerConfig,
        space: Workspace,
        sources: Sequence[Increments | None] = (None, None),
    ) -> None:
        """Write the constants of ``config`` to ``space``.

        ``sources`` is what the sources of the left and the right foot say that their samples are.
        """
        self._config, self._space = config, space
        self._up = [np.array([0.0, 0.0, 1.0])] * 2  # in body axes
        self._set_constants()
        for foot, source in enumerate(sources):
            kind = config.increments.of(FEET[foot], source)
            space.w[lay.C_FOOT + foot * lay.C_STRIDE + lay.C_INCREMENTS] = KINDS[kind]

    def _set_constants(self) -> None:
        config, space = self._config, self._space
        w, n, noise, stance = space.w, space.n, config.noise, config.stance
        w[lay.C_GRAVITY] = config.gravity
        w[lay.C_Q_VEL] = noise.accelerometer**2
        w[lay.C_Q_ATT] = noise.gyro**2
        w[lay.C_Q_BG] = noise.gyro_bias**2
        w[lay.C_Q_BA] = noise.accelerometer_bias**2
        w[lay.C_BIAS_RATE] = 1.0 / noise.bias_time
        w[lay.C_ZUPT_CONSIDERS] = 1.0 if config.zupt.heading_correction == "none" else 0.0
        w[lay.C_BIAS_KNOWN_VAR] = config.zupt.bias_known**2
        self._set_weights()
        w[lay.C_WATCH] = math.inf
        w[lay.C_ADAPTS] = 1.0 if stance.detector == "adaptive" else 0.0
        w[lay.D_EDGES : lay.D_EDGES + lay.BINS] = 10.0 ** (0.05 * np.arange(20, 20 + lay.BINS))
        for foot in range(2):
            w[lay.D_FOOT + foot * lay.D_STRIDE + lay.D_THRESHOLD] = stance.threshold
        n[lay.N_SHORT_STANCE] = max(1, round(0.05 * space.rate_hz))
        n[lay.N_DECIMATE] = max(1, round(space.rate_hz / 60.0))
        n[lay.N_STANDS] = max(1, round(LONGEST_STANCE_S * space.rate_hz))
        n[lay.N_WALKING] = round(2.0 * space.rate_hz)
        n[lay.N_SETTLED] = round(0.3 * space.rate_hz)
        n[lay.N_WINDOW] = min(space.ring, max(2, round(stance.window * space.rate_hz)))
        n[lay.N_STILL] = max(1, round(config.zupt.still_after * space.rate_hz))
        n[lay.N_MIN_STANCE] = max(1, round(stance.min_stance * space.rate_hz))
        n[lay.N_MIN_SWING] = max(1, round(stance.min_swing * space.rate_hz))

    def _set_weights(self) -> None:
        config, w = self._config, self._space.w
        zupt, stance = config.zupt, config.stance
        growth = self._space.rate_hz / zupt.std_rate if zupt.std_rate > 0.0 else 1.0
        w[lay.C_ZUPT_VAR] = zupt.std**2 * growth
        w[lay.C_HEIGHT_DRIFT] = zupt.height_drift**2
        w[lay.C_ZUPT_STILL_VAR] = zupt.still_std**2
        w[lay.C_ZUPT_RATE_VAR] = zupt.rate_std**2 * growth
        w[lay.C_GLRT_FORCE] = 1.0 / stance.force_std**2
        w[lay.C_GLRT_RATE] = 1.0 / stance.gyro_std**2
        w[lay.C_GLRT_THRESHOLD] = stance.threshold

    def retune(self, config: TrackerConfig) -> None:
        """Go on with the weights and the threshold of ``config``."""
        self._config = config
        self._set_weights()

    def level(self, stills: Sequence[FootStandstill], origin: FloatArray, forward: float) -> None:
        """Start both feet from a standstill, side by side about ``origin`` (3,); forget the past.

        ``forward`` is the heading (rad) that the feet stand across and the body x axes are given.
        """
        self._space.w[: lay.STATE] = 0.0
        for foot, still in enumerate(stills):
            self._level_foot(foot, still, origin, forward)
        self._space.forget()

    def _level_foot(
        self, foot: int, still: FootStandstill, origin: FloatArray, forward: float
    ) -> None:
        w, config = self._space.w, self._config
        o, ahead, left = foot * lay.FOOT, math.cos(forward), math.sin(forward)
        aside = config.initial.spacing * (0.5 - foot)
        w[o + lay.POS : o + lay.POS + 3] = origin + np.array([-left * aside, ahead * aside, 0.0])
        rotation = about_z(forward) @ still.levelling()
        w[o + lay.ROT : o + lay.ROT + 9] = rotation.ravel()
        w[o + lay.BG : o + lay.BG + 3] = still.angular_rate
        norm = math.sqrt(float(still.specific_force @ still.specific_force))
        w[o + lay.BA : o + lay.BA + 3] = rotation[2] * (norm - config.gravity)
        self._up[foot] = rotation[2]
        self.aim(foot, rotation.T @ np.array([ahead, left, 0.0]))
        constants = lay.C_FOOT + foot * lay.C_STRIDE
        rate = constants + lay.C_STILL_RATE
        w[rate : rate + 3] = still.angular_rate
        w[constants + lay.C_STILL_NORM] = norm
        self._set_covariance(foot, still, rotation)

    def aim(self, foot: int, forward: FloatArray) -> None:
        """Put the pivot of a foot below and behind its sensor; ``forward`` (3,) in body axes."""
        up, zupt = self._up[foot], self._config.zupt
        ahead = forward - up * float(up @ forward)
        ahead /= math.sqrt(float(ahead @ ahead))
        lever = lay.C_FOOT + foot * lay.C_STRIDE + lay.C_LEVER
        self._space.w[lever : lever + 3] = -zupt.lever_arm * up - zupt.lever_back * ahead

    def _set_covariance(self, foot: int, still: FootStandstill, rotation: FloatArray) -> None:
        p0 = self._config.initial
        velocity = MOVING_STD if still.moving else p0.velocity
        stds = [p0.position] * 3 + [velocity] * 3 + [p0.tilt, p0.tilt, p0.yaw]
        stds += [max(p0.gyro_bias, still.rate_std)] * 3 + [p0.accelerometer_bias] * 3
        rows = self._space.own_block(foot)
        np.fill_diagonal(rows, np.square(stds))
        know_level(rows, rotation, self._config.gravity, max(LEVEL_NOISE, still.force_std))


def know_level(rows: FloatArray, rotation: FloatArray, gravity: float, std: float) -> None:
    """Put into P0 ``rows`` (15, 15) that a levelled foot at rest feels gravity only, to ``std``.

    Tilt and accelerometer bias are off by what cancels: the Kalman update of P0 by the error of
    the acceleration, (-g phi_y + b_x, g phi_x + b_y, b_z) with the bias b in navigation axes.
    """
    att, bias = slice(lay.E_ATT, lay.E_ATT + 3), slice(lay.E_BA, lay.E_BA + 3)
    tilt, b = float(rows[lay.E_ATT, lay.E_ATT]), float(rows[lay.E_BA, lay.E_BA])
    total = gravity**2 * tilt + b + std**2
    for axis in (lay.E_ATT, lay.E_ATT + 1):
        rows[axis, axis] = tilt * (b + std**2) / total
    level, up = b * (total - b) / total, b * std**2 / (b + std**2)
    block = rotation.T @ np.diag([level, level, up]) @ rotation
    rows[bias, bias] = 0.5 * (block + block.T)
    common = gravity * tilt * b / total
    rows[att, bias] = np.array([-common * rotation[1], common * rotation[0], np.zeros(3)])
    rows[bias, att] = rows[att, bias].T
