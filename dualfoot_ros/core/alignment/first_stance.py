"""A start without any stand: level from the first stances of the walk, gyro bias unknown."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..config import TrackerConfig
from ..results.events import FEET
from ..rotation import exact_rotation
from ..samples.series import FloatArray
from .foot_stand import FootStandstill, absent_foot
from .window import Window, WindowSlider

LENGTH_S = 0.2  # of the window in which a foot counts as standing
CALM_RATE_STD, CALM_FORCE_STD = 0.3, 1.0  # rad/s and m/s^2, scatter within it
CALM_RATE, CALM_GRAVITY = 0.5, 1.0  # rad/s and m/s^2, of its means
APART_S = 1.0  # at most, since the stance of a foot
BIAS_STD = 10.0  # rad/s: a stance tells nothing of the gyro bias
TILT_STD = 0.5  # m/s^2, of the mean force of a foot that only just stands


class FirstStances:
    """Looks for a stance of one foot, and for one of the other foot soon after it."""

    def __init__(self, config: TrackerConfig) -> None:
        """Start with no sample."""
        self._gravity = config.gravity
        self._sliders = tuple(WindowSlider(LENGTH_S) for _ in FEET)
        self._stances: list[FootStandstill | None] = [None, None]
        self._turned = [np.eye(3), np.eye(3)]  # of each body since its stance
        self._last_ns: int | None = None

    def add(
        self, stamp_ns: int, values: FloatArray, absent: Sequence[bool]
    ) -> tuple[FootStandstill, FootStandstill] | None:
        """Take a pair (12,); return what both stances tell when the second one has come.

        A foot that is ``absent`` (2,) is not waited for.
        """
        dt = 0.0 if self._last_ns is None else (stamp_ns - self._last_ns) * 1e-9
        self._last_ns = stamp_ns
        for foot, slider in enumerate(self._sliders):
            sample = values[6 * foot : 6 * foot + 6]
            if self._stances[foot] is not None:
                self._turned[foot] = self._turned[foot] @ exact_rotation(sample[3:] * dt)
            window = slider.add(stamp_ns, sample.copy())
            if window is not None and self._calm(window):
                self._stances[foot] = standstill_of(window)
                self._turned[foot] = np.eye(3)
        left, right = (
            absent_foot(self._gravity, stamp_ns) if gone else self._now(foot, stamp_ns)
            for foot, gone in enumerate(absent)
        )
        if left is None or right is None or (left.absent and right.absent):
            return None
        return left, right

    def _calm(self, window: Window) -> bool:
        return (
            window.rate_std < CALM_RATE_STD
            and window.force_std < CALM_FORCE_STD
            and window.largest_rate < CALM_RATE
            and window.gravity_error(self._gravity) < CALM_GRAVITY
        )

    def _now(self, foot: int, stamp_ns: int) -> FootStandstill | None:
        """Return what a stance tells of a foot that has turned since; None if it is long ago."""
        stance = self._stances[foot]
        if stance is None or stamp_ns - stance.end_ns > APART_S * 1e9:
            return None
        force = self._turned[foot].T @ stance.specific_force
        moving = stamp_ns > stance.end_ns
        return stance._replace(specific_force=force, moving=moving, end_ns=stamp_ns)


def standstill_of(window: Window) -> FootStandstill:
    """Return what a window of a foot that only just stands tells: the level."""
    force, nothing = np.array(window.mean[:3]), np.zeros(3)
    return FootStandstill(force, nothing, BIAS_STD, TILT_STD, window.seconds, window.end_ns)
