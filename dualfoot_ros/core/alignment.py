"""Levelling and gyro bias from a standstill of both feet: checked, refined until the first step.

A person who stands is not still: the standing rate of a foot moves by 0.1-0.3 deg/s.  So the
stand is cut into windows, each is checked, and only the stillest share of them is averaged.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .config import Alignment
from .series import FloatArray

WINDOWS = 80  # the newest that are kept, a minute of standing


@dataclass(frozen=True)
class FootStandstill:
    """What a standstill tells about one foot.

    Attributes
    ----------
    specific_force : (3,) m/s^2, mean
    angular_rate : (3,) rad/s, mean: the gyro bias
    rate_scatter : rad/s, standard deviation of that mean, from the scatter of the windows
    """

    specific_force: FloatArray
    angular_rate: FloatArray
    rate_scatter: float

    def levelling(self) -> FloatArray:
        """Return R_nb (3, 3) with roll and pitch from gravity and the body x axis heading zero."""
        up = self.specific_force / math.sqrt(float(self.specific_force @ self.specific_force))
        axis = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.95 else np.array([0.0, 0.0, -up[0]])
        x = axis - up * float(axis @ up)
        x /= math.sqrt(float(x @ x))
        return np.array([x, np.cross(up, x), up])


@dataclass(frozen=True)
class Window:
    """Mean and scatter of one window of pairs; values as in :class:`ImuPair`."""

    mean: FloatArray
    std: FloatArray

    def complaint(self, config: Alignment, gravity: float) -> str | None:
        """Return why this window is no standstill, or None."""
        for foot, name in enumerate(("left", "right")):
            force, rate = slice(6 * foot, 6 * foot + 3), slice(6 * foot + 3, 6 * foot + 6)
            norm = math.sqrt(float(self.mean[force] @ self.mean[force]))
            checks = (
                ("angular rate scatter", self.std[rate].max(), config.max_rate_std, "rad/s"),
                ("specific force scatter", self.std[force].max(), config.max_force_std, "m/s^2"),
                ("mean angular rate", np.abs(self.mean[rate]).max(), config.max_rate, "rad/s"),
                ("gravity error", abs(norm - gravity), config.max_gravity_error, "m/s^2"),
            )
            for what, value, limit, unit in checks:
                if value > limit:
                    return f"{name} foot: {what} {value:.3g} {unit}, allowed {limit:g} {unit}"
        return None


class Standstill:
    """Collects pairs while both feet stand and says what they tell."""

    def __init__(self, config: Alignment, gravity: float, rate_hz: float) -> None:
        """Start with nothing collected."""
        self._config, self._gravity = config, gravity
        self._size = max(5, round(config.window * rate_hz))
        self._needed = max(1, math.ceil(config.duration * rate_hz / self._size))
        self._buffer = np.empty((self._size, 12))
        self._count = 0
        self._windows: list[Window] = []
        self.complaint: str | None = None
        self.restarts = 0

    @property
    def ready(self) -> bool:
        """Whether enough standstill has been collected."""
        return len(self._windows) >= self._needed

    def add(self, values: FloatArray, *, restart: bool = True) -> bool:
        """Take one pair; return True when it completed a still window.

        A window with motion discards what was collected, unless ``restart`` is False.
        """
        self._buffer[self._count] = values
        self._count += 1
        if self._count < self._size:
            return False
        self._count = 0
        window = Window(self._buffer.mean(axis=0), self._buffer.std(axis=0))
        self.complaint = window.complaint(self._config, self._gravity)
        if self.complaint is None:
            self._windows.append(window)
            del self._windows[:-WINDOWS]
            return True
        if restart:
            self.restarts += bool(self._windows)
            self._windows.clear()
        return False

    def result(self) -> tuple[FootStandstill, FootStandstill]:
        """Return what the stillest windows tell about the left and the right foot."""
        left, right = (self._foot(6 * foot) for foot in range(2))
        return left, right

    def _foot(self, at: int) -> FootStandstill:
        keep = max(2, math.ceil(self._config.still_fraction * len(self._windows)))
        ranked = sorted(self._windows, key=lambda w: float(w.std[at + 3 : at + 6].max()))[:keep]
        means = np.array([w.mean[at : at + 6] for w in ranked])
        spread = means[:, 3:].std(axis=0, ddof=1).max() if len(ranked) > 1 else 0.0
        scatter = spread / math.sqrt(len(ranked))
        mean = means.mean(axis=0)
        return FootStandstill(mean[:3], mean[3:], float(scatter))
