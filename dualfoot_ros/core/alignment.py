"""Levelling and gyro bias from a standstill of both feet: checked, refined until the first step.

A person who stands is not still: the standing rate of a foot moves by 0.1-0.3 deg/s.  So a
window slides over the stand, is checked at every step, and counts the more the stiller it is.
Nothing is chosen, so one sample more or less changes the bias by next to nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .config import TrackerConfig
from .config_groups import AlignmentConfig
from .samples.series import FloatArray

MEMORY_S = 30.0  # what is older than that fades: biases drift
SLIDES = 25  # steps in which a window moves on by its length
FIRST = 20  # pairs from which the rate is taken
UPRIGHT = 0.95  # cosine to the vertical, from which an axis has no heading
RATES_HZ = (5.0, 5000.0)  # beyond these the stamps are wrong, and memory must stay bounded


@dataclass(frozen=True)
class FootStandstill:
    """What a standstill tells about one foot.

    Attributes
    ----------
    specific_force : (3,) m/s^2, mean
    angular_rate : (3,) rad/s, mean: the gyro bias
    rate_scatter : rad/s, standard deviation of that mean, from the scatter of the windows' means
    force_scatter : m/s^2, of the windows' means, on each of two axes: how far they tilt
    """

    specific_force: FloatArray
    angular_rate: FloatArray
    rate_scatter: float
    force_scatter: float

    def levelling(self) -> FloatArray:
        """Return R_nb (3, 3) with roll and pitch from gravity and the body x axis heading zero."""
        up = self.specific_force / math.sqrt(float(self.specific_force @ self.specific_force))
        axis = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < UPRIGHT else np.array([0.0, 0.0, -up[0]])
        x = axis - up * float(axis @ up)
        x /= math.sqrt(float(x @ x))
        return np.array([x, np.cross(up, x), up])


@dataclass(frozen=True)
class Window:
    """Mean and scatter of one window of pairs; values as in :class:`ImuPair`."""

    mean: FloatArray
    std: FloatArray

    @classmethod
    def of(cls, samples: FloatArray) -> Window:
        """Return the window of ``samples`` (N, 12)."""
        mean = samples.sum(axis=0) / len(samples)
        off = samples - mean
        return cls(mean, np.sqrt((off * off).sum(axis=0) / len(samples)))

    def complaint(self, config: AlignmentConfig, gravity: float) -> str | None:
        """Return why this window is no standstill, or None."""
        mean, std = self.mean.tolist(), self.std.tolist()
        for foot, name in enumerate(("left", "right")):
            force, rate = slice(6 * foot, 6 * foot + 3), slice(6 * foot + 3, 6 * foot + 6)
            excess = abs(math.hypot(*mean[force]) - gravity)
            checks = (
                ("angular rate scatter", max(std[rate]), config.max_rate_std, "rad/s"),
                ("specific force scatter", max(std[force]), config.max_force_std, "m/s^2"),
                ("mean angular rate", max(map(abs, mean[rate])), config.max_rate, "rad/s"),
                ("gravity error", excess, config.max_gravity_error, "m/s^2"),
            )
            for what, value, limit, unit in checks:
                if value > limit:
                    return f"{name} foot: {what} {value:.3g} {unit}, allowed {limit:g} {unit}"
        return None


def stillness(scatter: FloatArray, floor: float) -> FloatArray:
    """Return how much a window of angular rate ``scatter`` (rad/s) counts.

    The scatter says how far a foot moves, and with it how far the mean of the window is off.
    Below ``floor`` it is noise and quantisation, and says nothing.
    """
    weight: FloatArray = (scatter**2 + floor**2) ** -2.0
    return weight


class Average:
    """Mean of the windows of one foot, weighted by their stillness.

    Updated as in West 1979 (Communications of the ACM 22(9)), with weights that fade.
    """

    def __init__(self, floor: float, keep: float) -> None:
        """Start empty; ``floor`` rad/s, ``keep`` is what is left of a weight one step later."""
        self._floor, self._keep = floor, keep
        self._weight = self._squares = 0.0
        self._mean, self._spread = np.zeros(6), np.zeros(6)

    def add(self, window: Window, at: int) -> None:
        """Take a window; the values of the foot start at index ``at``."""
        mean, scatter = window.mean[at : at + 6], window.std[at + 3 : at + 6].max(keepdims=True)
        weight = float(stillness(scatter, self._floor)[0])
        self._weight = self._keep * self._weight + weight
        self._squares = self._keep**2 * self._squares + weight**2
        step = mean - self._mean
        self._mean = self._mean + (weight / self._weight) * step
        self._spread = self._keep * self._spread + weight * step * (mean - self._mean)

    def result(self, slides: int) -> FootStandstill:
        """Return the mean; windows overlap, so only one in ``slides`` is independent."""
        windows = self._weight**2 / self._squares / slides
        variance = self._spread / self._weight
        rate = math.sqrt(float(variance[3:].max()) / max(1.0, windows - 1.0))
        tilts = 0.5 * float(variance[:3].sum())  # two axes: along gravity next to nothing
        return FootStandstill(self._mean[:3], self._mean[3:], rate, math.sqrt(tilts))


class Standstill:
    """Collects pairs while both feet stand and says what they tell."""

    def __init__(self, config: AlignmentConfig, gravity: float, rate_hz: float) -> None:
        """Start with nothing collected."""
        self._config, self._gravity = config, gravity
        self._size = max(5, round(config.window * rate_hz))
        self._needed = max(1, math.ceil(config.duration * rate_hz / self._size))
        self._step = max(1, self._size // SLIDES)
        self._slides = self._size // self._step
        self._keep = math.exp(-self._step / (MEMORY_S * rate_hz))
        self._samples = np.empty((self._size, 12))  # the newest, in a ring
        self._count = 0
        self.complaint: str | None = None
        self.restarts = 0
        self._clear()

    def _clear(self) -> None:
        floor = self._config.still_rate_std
        self._feet = Average(floor, self._keep), Average(floor, self._keep)
        self._still = 0

    @property
    def ready(self) -> bool:
        """Whether enough standstill has been collected."""
        return self._still > (self._needed - 1) * self._slides

    def add(self, values: FloatArray, *, restart: bool = True) -> bool:
        """Take one pair; return True when one more window's length of standstill is complete.

        Motion discards what was collected, unless ``restart`` is False.
        """
        self._samples[self._count % self._size] = values
        self._count += 1
        if self._count < self._size or self._count % self._step:
            return False
        window = Window.of(self._samples)
        self.complaint = window.complaint(self._config, self._gravity)
        if self.complaint is None:
            self._collect(window)
            return self._still % self._slides == 1
        if restart and self._still:
            self.restarts += 1
            self._clear()
        return False

    def _collect(self, window: Window) -> None:
        self._still += 1
        for foot, average in enumerate(self._feet):
            average.add(window, 6 * foot)

    def result(self) -> tuple[FootStandstill, FootStandstill]:
        """Return what the standstill tells about the left and the right foot."""
        left, right = (average.result(self._slides) for average in self._feet)
        return left, right


class FirstPairs:
    """Collects the pairs from the first one until both feet have stood long enough."""

    def __init__(self, config: TrackerConfig) -> None:
        """Start with nothing collected."""
        self._config = config
        self._first: list[tuple[int, FloatArray]] = []
        self.rate_hz = 0.0
        self.still: Standstill | None = None

    @property
    def complaint(self) -> str | None:
        """Why the last window was no standstill, if it was not."""
        return self.still.complaint if self.still else None

    def add(self, stamp: int, values: FloatArray) -> Standstill | None:
        """Take one pair; return the standstill when there is enough of it."""
        if self.still is not None:
            return self._enough(self.still, [values])
        self._first.append((stamp, values.copy()))
        if len(self._first) < FIRST:
            return None
        interval_ns = float(np.median(np.diff([s for s, _ in self._first])))
        self.rate_hz = float(np.clip(1e9 / max(1.0, interval_ns), *RATES_HZ))
        self.still = Standstill(self._config.alignment, self._config.gravity, self.rate_hz)
        return self._enough(self.still, [v for _, v in self._first])

    def _enough(self, still: Standstill, pairs: list[FloatArray]) -> Standstill | None:
        completed = [still.add(values) for values in pairs]
        return still if any(completed) and still.ready else None
