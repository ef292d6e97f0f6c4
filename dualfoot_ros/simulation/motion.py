"""The rough motion of one shoe: footprints, templates, ringing and wobble at control points."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..core import FloatArray
from . import gait
from .footprints import HEEL_STRIKE, Footprints
from .noise import smooth_noise, smooth_rate_noise
from .routes import Route
from .shoe import ShoeMotion
from .walk_config import WalkConfig

KNOT_S = 0.01
MARGIN_S = 0.5
LEAST_RISE_M = 0.05  # of a stair


class Walker:
    """Makes the motion of one shoe from its footprints; step-wise tunable.

    ``skew`` and ``bulge`` (one a landing of the foot) let the swinging foot pass its neighbour
    earlier or later, and farther out (m).
    """

    def __init__(
        self,
        config: WalkConfig,
        route: Route,
        prints: Footprints,
        side: int,
        rng: np.random.Generator,
    ) -> None:
        self.config = config
        self.route = route
        self.side = side
        self.rows = prints.rows_of(side)
        self.prints = prints
        count = len(self.rows)
        self.skew = np.zeros(count)
        self.bulge = np.zeros(count)
        self.scatter = np.clip(rng.standard_normal((count, 8)), -2.5, 2.5)
        self.knots, self.time_s = _knots(prints.end_s)
        self._rest = self._wobble_and_sway(rng)
        self._phase()

    def motion(self) -> ShoeMotion:
        """Return the motion with the present ``skew`` and ``bulge``."""
        from scipy.interpolate import BSpline

        spline = BSpline(self.knots, self._control_points(), 5)
        return ShoeMotion(spline, self.config.gravity)

    def _phase(self) -> None:
        """Find, for every control point, the landing it belongs to and the phase of its swing."""
        prints, rows = self.prints, self.rows
        flat, heel_off = prints.flat_s[rows], prints.heel_off_s[rows]
        now = np.searchsorted(heel_off[1:], self.time_s, side="right")
        self.now, self.before = now, np.maximum(now - 1, 0)
        window = np.where(now > 0, flat[now] - heel_off[now], 1.0)
        moving = (self.time_s - heel_off[now]) / window
        self.q = np.where(now > 0, np.clip(moving, 0.0, 1.0), 1.0)
        strike = heel_off[now] + HEEL_STRIKE * window
        self.since_strike = np.where(now > 0, self.time_s - strike, 1.0)
        self.since_flat = np.where(now > 0, self.time_s - flat[now], 1e3)
        self.scale = self._scale()

    def _scale(self) -> FloatArray:
        """Return the size (K,) of each swing: 1 for a full stride, less on stairs."""
        progress = self.prints.progress[self.rows]
        stride = np.diff(progress, prepend=progress[0]) / (2.0 * self.config.step_length)
        scale = np.clip(stride, 0.3, 1.15)
        return np.where(self.prints.stair[self.rows], 0.7, scale)

    def _control_points(self) -> FloatArray:
        ring, height, angles, back = self._untuned
        prints, rows, now, before, q = self.prints, self.rows, self.now, self.before, self.q
        progress, lateral = prints.progress[rows], prints.lateral[rows]
        share, bump = gait.advance(q, self.skew[now])
        along = progress[before] + (progress[now] - progress[before]) * share
        across = lateral[before] + (lateral[now] - lateral[before]) * share
        across = across + self.side * self.bulge[now] * bump
        along = along - back
        ground = self.route.point(along + ring[:, 0], across + ring[:, 1])
        return np.column_stack([ground, height, angles])

    @cached_property
    def _untuned(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """What no tuning changes: ringing (N, 3), height (N,), angles (N, 3), and (N,) m back.

        The last is how far the ball is drawn back as the shoe stands on its heel.
        """
        pitch, ring = self._pitch(), self._ring()
        back = gait.FOOT_LENGTH_M * (1.0 - np.cos(np.minimum(pitch, 0.0)))
        slow = self._roll_over() + self._rest[:, 1]
        height = self._height() + gait.sole_height(pitch) - gait.give(pitch, slow) + ring[:, 2]
        return ring, height, self._angles(self.prints.progress[self.rows], pitch), back

    def _pitch(self) -> FloatArray:
        """Return the (N,) pitch of the stride itself in rad, zero while the foot is flat."""
        scatter = 1.0 + self.config.gait.shape_std * self.scatter[self.now, 2]
        pitch: FloatArray = gait.shape("pitch", self.q) * scatter * self.scale[self.now]
        return pitch

    def _angles(self, progress: FloatArray, pitch: FloatArray) -> FloatArray:
        """Return (N, 3) yaw, pitch, roll of the shoe in rad."""
        config, now, q = self.config.gait, self.now, self.q
        scatter = 1.0 + config.shape_std * self.scatter[now]
        size = self.scale[now]
        turn = gait.shape("turn", q)
        looked = progress[self.before] + (progress[now] - progress[self.before]) * turn
        yaw = gait.turned("yaw", q, config.coning) * scatter[:, 0] * size
        roll = -gait.turned("roll", q, config.coning) * (1.0 + 3.0 * (scatter[:, 1] - 1.0)) * size
        heading = self.route.heading(looked) + self.side * (config.toe_out + yaw)
        rolled = np.column_stack([heading, pitch + self._roll_over(), self.side * roll])
        return rolled + self._rest

    def _roll_over(self) -> FloatArray:
        """Return the slow forward rotation of the stance, taken back during the swing."""
        gait_, cycle = self.config.gait, self.config.cycle_s
        stance = np.clip(self.since_flat / (gait_.stance_share * cycle), 0.0, 1.0)
        return gait_.roll_over * np.where(self.q < 1.0, 0.5 - self.q, stance - 0.5)

    def _height(self) -> FloatArray:
        floor = self.prints.floor[self.rows]
        rise = (floor[self.now] - floor[self.before]) * (self.now > 0)
        lift = gait.shape("lift", self.q) * self.config.gait.clearance
        lift = lift * (1.0 + 3.0 * self.config.gait.shape_std * self.scatter[self.now, 3])
        lift = lift + 0.08 * gait.shape("lift", self.q) * (np.abs(rise) > LEAST_RISE_M)
        height: FloatArray = floor[self.now] - rise * (1.0 - gait.climb(self.q, rise)) + lift
        return height

    def _ring(self) -> FloatArray:
        """Return (N, 3) m: the ringing after heel strike along, across and up."""
        scatter = self.scatter[self.now]
        size = np.array([-0.8, 0.3, 1.0]) + 0.35 * scatter[:, 4:7]
        wave = gait.ringing(self.since_strike) * self.config.gait.impact * self.scale[self.now]
        return size * wave[:, None]

    def _wobble_and_sway(self, rng: np.random.Generator) -> FloatArray:
        """Return (N, 3) rad: wobble of the walking foot, tremor and sway of the standing one."""
        config, time_s = self.config.gait, self.time_s
        wobble = smooth_rate_noise(time_s, 0.12, rng) * config.wobble
        tremor = smooth_rate_noise(time_s, 0.06, rng) * config.tremor
        sway = smooth_noise(time_s, 2.0, rng) * config.sway
        return wobble * self._activity()[:, None] + tremor + sway

    def _activity(self) -> FloatArray:
        """Return (N,) 1 while the walker walks, 0 while the feet stand together, with ramps."""
        start, end = self.prints.heel_off_s[2:], self.prints.flat_s[2:]
        begun = np.searchsorted(start, self.time_s, side="right")
        landed = np.append(-np.inf, np.maximum.accumulate(end))[begun]
        ramp = round(0.3 / KNOT_S)
        return np.convolve(self.time_s < landed, np.full(ramp, 1.0 / ramp), mode="same")


def _knots(end_s: float) -> tuple[FloatArray, FloatArray]:
    """Return the knots, and the abscissae of the control points (Greville), both in s."""
    count = int(np.ceil((end_s + 2.0 * MARGIN_S) / KNOT_S)) + 6
    knots: FloatArray = -MARGIN_S + KNOT_S * (np.arange(count + 6, dtype=np.float64) - 3.0)
    return knots, knots[3 : count + 3]
