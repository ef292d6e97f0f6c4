"""Weighted standstill of one foot: level and gyro bias, with the uncertainty that they deserve.

A standing person sways at 0.1-0.3 deg/s.  So a window slides over the stand and counts the more
the stiller it is.  Nothing is chosen, so one sample more or less changes the bias by next to
nothing; only motion ends a stand.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeVar

import numpy as np

from ..groups import AlignmentConfig
from ..samples.series import FloatArray
from .window import Window

MEMORY_S = 30.0  # what is older than that fades: biases drift
UPRIGHT = 0.95  # cosine to the vertical, from which an axis has no heading
UNKNOWN_BIAS_STD = 0.03  # rad/s, of consumer sensors at turn-on
FEWEST = 3.0  # independent windows below which their scatter alone says too little
Scatter = TypeVar("Scatter", float, FloatArray)


class FootStandstill(NamedTuple):
    """What a standstill tells about one foot.

    Attributes
    ----------
    specific_force : (3,) m/s^2, mean
    angular_rate : (3,) rad/s, mean: the gyro bias
    rate_std : rad/s, standard deviation of that mean
    force_std : m/s^2, standard deviation of the mean force across gravity: how far it tilts
    seconds : length of the stand, as far as it was still
    end_ns : stamp of its last sample
    moving : whether the foot may be moving at that stamp
    absent : whether the foot has had no samples, so that nothing is known of it
    """

    specific_force: FloatArray
    angular_rate: FloatArray
    rate_std: float
    force_std: float
    seconds: float
    end_ns: int
    moving: bool = False
    absent: bool = False

    def levelling(self) -> FloatArray:
        """Return R_nb (3, 3) with roll and pitch from gravity and the body x axis heading zero."""
        up = self.specific_force / math.sqrt(float(self.specific_force @ self.specific_force))
        axis = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < UPRIGHT else np.array([0.0, 0.0, -up[0]])
        x = axis - up * float(axis @ up)
        x /= math.sqrt(float(x @ x))
        return np.array([x, np.cross(up, x), up])

    def with_bias(self, bias: FloatArray, std: float) -> FootStandstill:
        """Return the same with another gyro bias (3,) and its standard deviation, rad/s."""
        return self._replace(angular_rate=bias, rate_std=std)


def absent_foot(gravity: float, stamp_ns: int) -> FootStandstill:
    """Return what is known of a foot without samples: nothing."""
    force = np.array([0.0, 0.0, gravity])
    return FootStandstill(force, np.zeros(3), UNKNOWN_BIAS_STD, 1.0, 0.0, stamp_ns, absent=True)


def stillness(scatter: Scatter, floor: float) -> Scatter:
    """Return how much a window of angular rate ``scatter`` (rad/s) counts.

    The scatter says how far a foot moves, and with it how far the mean of the window is off.
    Below ``floor`` it is noise and quantisation, and says nothing.
    """
    weight: Scatter = (scatter * scatter + floor**2) ** -2.0
    return weight


class FootStand:
    """Mean of the windows of one standing foot, weighted by their stillness.

    Updated as in West 1979 (Communications of the ACM 22(9)), with weights that fade.
    """

    def __init__(self, config: AlignmentConfig) -> None:
        """Start empty."""
        self._floor = config.still_rate_std
        self.clear()

    def clear(self) -> None:
        """Forget the windows."""
        self.count = 0
        self._after_first_s = 0.0
        self._weight = self._squares = 0.0
        self._mean, self._spread = [0.0] * 6, [0.0] * 6
        # variance of the windows' means (rate, force) by what happens within them
        self._within = [0.0] * 2
        self._newest: Window | None = None
        self._result: FootStandstill | None = None  # until another window comes

    def add(self, window: Window) -> None:
        """Take a window."""
        step_s = self._step_s(window)
        self._after_first_s += step_s
        keep = math.exp(-step_s / MEMORY_S)
        weight = stillness(window.rate_std, self._floor)
        self._weight = keep * self._weight + weight
        self._squares = keep**2 * self._squares + weight**2
        share = weight / self._weight
        for k, value in enumerate(window.mean):
            step = value - self._mean[k]
            self._mean[k] += share * step
            self._spread[k] = keep * self._spread[k] + weight * step * (value - self._mean[k])
        for k, within in enumerate((window.mean_rate_std, window.mean_force_std)):
            self._within[k] = keep * self._within[k] + weight * (within * within)
        self._newest, self._result = window, None
        self.count += 1

    def _step_s(self, window: Window) -> float:
        """Return by how much the stand grows with ``window``, s."""
        if self._newest is None:
            return 0.0
        return min(window.seconds, (window.end_ns - self._newest.end_ns) * 1e-9)

    @property
    def seconds(self) -> float:
        """Length of the stand, as far as it was still, s."""
        return 0.0 if self._newest is None else self._newest.seconds + self._after_first_s

    def result(self) -> FootStandstill:
        """Return what the stand tells."""
        if self._result is None:
            self._result = self._worked_out()
        return self._result

    def _worked_out(self) -> FootStandstill:
        """Work out what the stand tells; windows overlap, so not all are independent.

        The scatter of the windows' means says how far off their mean is; where there are few of
        them, what happens within the windows says it.
        """
        assert self._newest is not None
        alike = self._weight**2 / self._squares  # windows of equal weight that would say as much
        windows = max(1.0, alike * self.seconds / (self.count * self._newest.seconds))
        variance = [spread / self._weight for spread in self._spread]
        between = max(variance[3:]) / max(1.0, windows - 1.0)
        # two axes: along gravity next to nothing
        tilts = 0.5 * (variance[0] + variance[1] + variance[2])
        trust = min(1.0, (windows - 1.0) / FEWEST)
        rate_std, force_std = (
            math.sqrt(trust * b + (1.0 - trust) * max(b, w / self._weight / windows))
            for b, w in zip((between, tilts), self._within, strict=True)
        )
        force, rate = np.array(self._mean[:3]), np.array(self._mean[3:])
        return FootStandstill(force, rate, rate_std, force_std, self.seconds, self._newest.end_ns)
