"""One foot before a track starts: whether it stands, for how long, and what the stand tells."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from ..config import TrackerConfig
from ..samples.series import FloatArray, IntArray
from .foot_stand import FootStand, FootStandstill
from .window import Window, WindowSlider
from .windows_ahead import WindowsAhead

SHORTEST_S = 0.5  # of a stand that is used


Take = Callable[[Window], None]


class FootAhead(NamedTuple):
    """Windows of a foot by the sample with which they end, and how each is taken."""

    windows: dict[int, list[tuple[Take, Window]]]
    sliders: tuple[tuple[WindowSlider, WindowsAhead], ...]


class FootWatch:
    """Watches one foot: windows of it, the stand it is in, and what ended the last one."""

    def __init__(self, config: TrackerConfig) -> None:
        """Start with no sample."""
        self._config = config
        length = config.alignment.window
        self._slider, self._short = WindowSlider(length), WindowSlider(min(SHORTEST_S, length))
        self.stand = FootStand(config.alignment)
        self._still: Window | None = None  # the newest short window, if the foot stands in it
        self.complaint: str | None = None
        self.quiet_s = 0.0
        self._last_ns = 0
        self.restarts = 0
        self.refining = False
        self.seen_ns: int | None = None

    def add(self, stamp_ns: int, values: FloatArray) -> bool:
        """Take a sample (6,); return True when a window ended with it."""
        if not math.isfinite(sum(values.tolist())):
            return False
        self.seen_ns = stamp_ns
        short = None if self.refining else self._short.add(stamp_ns, values)
        if short is not None:
            self._take_short(short)
        window = self._slider.add(stamp_ns, values)
        if window is not None:
            self.take(window)
        return short is not None or window is not None

    def _take_short(self, window: Window) -> None:
        """Let the newest short window stand for a stand that is not longer than that."""
        config = self._config
        still = window.motion(config.alignment, config.gravity) is None
        self._still = window if still else None

    def look_ahead(self, stamps: IntArray, rows: FloatArray) -> FootAhead:
        """Return the windows among finite samples (N, 6) that follow; none is taken."""
        sliders = (self._slider,) if self.refining else (self._short, self._slider)
        aheads = [slider.look_ahead(stamps, rows) for slider in sliders]
        found: dict[int, list[tuple[Take, Window]]] = {}
        takes = (self.take,) if self.refining else (self._take_short, self.take)
        for slider, ahead, take in zip(sliders, aheads, takes, strict=True):
            for row, window in slider.windows(ahead):
                found.setdefault(row, []).append((take, window))
        return FootAhead(found, tuple(zip(sliders, aheads, strict=True)))

    def take_all(self, ahead: FootAhead, stamps: IntArray, count: int) -> None:
        """Take the first ``count`` of samples, whose windows have been taken."""
        for slider, windows in ahead.sliders:
            slider.take(windows, count)
        if count:
            self.seen_ns = int(stamps[count - 1])

    def take(self, window: Window) -> None:
        """Let a window be a part of the stand, or end it."""
        config = self._config
        self.complaint = window.motion(config.alignment, config.gravity)
        if self.complaint is None:
            self.stand.add(window)
        elif not self.refining:
            self.restarts += self.stand.count > 0
            self.stand.clear()
        step = (window.end_ns - self._last_ns) * 1e-9
        self._last_ns = window.end_ns
        quiet = self.complaint is None and window.quiet(config.alignment)
        self.quiet_s = (self.quiet_s + step if self.quiet_s else window.seconds) if quiet else 0.0

    @property
    def standstill(self) -> FootStandstill | None:
        """What the stand that the foot is in tells; None while it moves."""
        if self._still is None:
            return None
        if self.stand.count:
            return self.stand.result()
        short = FootStand(self._config.alignment)
        short.add(self._still)
        return short.result()
