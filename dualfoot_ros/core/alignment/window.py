"""Windows over the newest samples of one foot: their mean, their scatter, and motion in them."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..groups import AlignmentConfig
from ..samples.row_window import RowWindow
from ..samples.series import FloatArray, IntArray
from .windows_ahead import FEWEST_SAMPLES, WindowsAhead, window_begins, window_ends

SLIDES = 25  # steps in which a window moves on by its length
CORRELATION_S = 0.15  # time over which the angular rate of a standing foot is alike


class Window(NamedTuple):
    """Mean and scatter of the samples (6,) of one foot: specific force, then angular rate.

    Attributes
    ----------
    end_ns : stamp of its last sample
    seconds : its length
    """

    mean: list[float]
    std: list[float]
    end_ns: int
    seconds: float

    @classmethod
    def of(cls, samples: FloatArray, end_ns: int, seconds: float) -> Window:
        """Return the window of ``samples`` (N, 6)."""
        mean = np.add.reduce(samples) / len(samples)
        off = samples - mean
        std = np.sqrt(np.add.reduce(off * off) / len(samples))
        return cls(mean.tolist(), std.tolist(), end_ns, seconds)

    @property
    def rate_std(self) -> float:
        """Largest scatter of the angular rate about an axis, rad/s."""
        return max(self.std[3:])

    @property
    def force_std(self) -> float:
        """Largest scatter of the specific force along an axis, m/s^2."""
        return max(self.std[:3])

    @property
    def largest_rate(self) -> float:
        """Largest mean angular rate about an axis, rad/s."""
        return max(map(abs, self.mean[3:]))

    @property
    def mean_rate_std(self) -> float:
        """Standard deviation of the mean angular rate by what happens within the window, rad/s."""
        return self.rate_std * math.sqrt(CORRELATION_S / max(self.seconds, CORRELATION_S))

    @property
    def mean_force_std(self) -> float:
        """Standard deviation of the mean specific force across gravity, m/s^2, in the same way."""
        x, y, z = self.std[:3]
        across = math.sqrt(0.5 * (x * x + y * y + z * z))
        return across * math.sqrt(CORRELATION_S / max(self.seconds, CORRELATION_S))

    def gravity_error(self, gravity: float) -> float:
        """Return by how much the norm of the mean specific force differs from gravity, m/s^2."""
        return abs(math.hypot(*self.mean[:3]) - gravity)

    def motion(self, config: AlignmentConfig, gravity: float) -> str | None:
        """Return why this window is no standstill, or None."""
        checks = (
            ("angular rate scatter", self.rate_std, config.max_rate_std, "rad/s"),
            ("specific force scatter", self.force_std, config.max_force_std, "m/s^2"),
            ("mean angular rate", self.largest_rate, config.max_rate, "rad/s"),
            ("gravity error", self.gravity_error(gravity), config.max_gravity_error, "m/s^2"),
        )
        for what, value, limit, unit in checks:
            if value > limit:
                return f"{what} {value:.3g} {unit}, allowed {limit:g} {unit}"
        return None

    def quiet(self, config: AlignmentConfig) -> bool:
        """Return whether the foot is so still that the start need not wait for better."""
        quiet = self.rate_std <= config.quiet_rate_std
        return quiet and self.force_std <= config.quiet_force_std


def slide_ns(length_ns: int) -> int:
    """Return by how much a window of a length moves on, ns."""
    return max(1, length_ns // SLIDES)


class WindowSlider:
    """Slides a window of some seconds over the samples of one foot."""

    def __init__(self, seconds: float) -> None:
        """Start with no sample."""
        self._length_ns = round(seconds * 1e9)
        self._step_ns = slide_ns(self._length_ns)
        self._stamps: deque[int] = deque()
        self._rows = RowWindow(6)  # the samples
        self._due_ns: int | None = None

    def add(self, stamp_ns: int, values: FloatArray) -> Window | None:
        """Take a sample (6,); return the window that ends with it, when one is due."""
        stamps = self._stamps
        self._rows.append(values)
        stamps.append(stamp_ns)
        begin_ns = stamp_ns - self._length_ns
        full = stamps[0] <= begin_ns
        while stamps[0] <= begin_ns:
            stamps.popleft()
            self._rows.drop_first()
        if not full or len(stamps) < FEWEST_SAMPLES:
            return None
        if not self._is_due(stamp_ns):
            return None
        return Window.of(self._rows.rows(), stamp_ns, self._length_ns * 1e-9)

    def look_ahead(self, stamps: IntArray, rows: FloatArray) -> WindowsAhead:
        """Return what would come of samples (N, 6) with rising stamps (N,); none is taken."""
        held = len(self._stamps)
        whole_ns = np.concatenate([np.array(self._stamps, dtype=np.int64), stamps])
        whole = np.concatenate([self._rows.rows(), rows])
        begins, full = window_begins(whole_ns, self._length_ns)
        full[:held] = False
        ends, dues_ns = window_ends(whole_ns, full, self._step_ns, self._due_ns)
        return WindowsAhead(held, whole_ns, whole, begins, ends, dues_ns)

    def windows(self, ahead: WindowsAhead) -> Iterator[tuple[int, Window]]:
        """Yield the windows that end among samples, and which of them is their last."""
        seconds = self._length_ns * 1e-9
        means, stds = (each.tolist() for each in ahead.moments())
        ends_ns = ahead.stamp_ns[ahead.ends].tolist()
        for k, mean, std, end_ns in zip(ahead.ends, means, stds, ends_ns, strict=True):
            yield k - ahead.held, Window(mean, std, end_ns, seconds)

    def take(self, ahead: WindowsAhead, count: int) -> None:
        """Take the first ``count`` of samples, as if they had come one by one."""
        if count == 0:
            return
        stop = ahead.held + count
        begin = ahead.begins[stop - 1]
        self._stamps = deque(ahead.stamp_ns[begin:stop].tolist())
        self._rows.hold(ahead.rows[begin:stop])
        ended = bisect_left(ahead.ends, stop)
        self._due_ns = ahead.dues_ns[ended - 1] if ended else self._due_ns

    def _is_due(self, stamp_ns: int) -> bool:
        """Return whether a window that ends now is wanted, and when the next one will be."""
        if self._due_ns is not None and stamp_ns < self._due_ns:
            return False
        self._due_ns = max(self._due_ns or stamp_ns, stamp_ns - self._step_ns) + self._step_ns
        return True

    def clear(self) -> None:
        """Forget the samples."""
        self._stamps.clear()
        self._rows.clear()
        self._due_ns = None
