"""The start of a track: from the best standstill that comes, and from what is there if none does.

Two seconds of both feet as still as a person can stand start it at once.  A shorter or restless
stand is kept while a better one may come; ``alignment.patience`` after it the track starts from
it all the same, and the pairs since are run first.  Where nobody ever stands, the first stances of
the walk give the level, and the gyro bias is known as far as sensors of the kind are alike.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..config import TrackerConfig
from ..results.events import FEET
from ..samples.series import FloatArray
from .first_stance import FirstStances
from .foot_stand import FootStand, FootStandstill
from .prior import BiasPrior
from .sampling_rate import SamplingRate
from .window import SLIDES, Window, WindowSlider

SHORTEST_S = 0.5  # of a stand that is used
UNKNOWN_BIAS = BiasPrior(np.zeros(3), 0.03)  # rad/s, of consumer sensors at turn-on
Pair = tuple[int, FloatArray]
Standstills = tuple[FootStandstill, FootStandstill]


class StartKind(StrEnum):
    """What a track starts from."""

    STAND = "stand"
    RESTLESS_STAND = "restless_stand"
    FIRST_STANCE = "first_stance"


@dataclass(frozen=True)
class Start:
    """What a track starts from.

    Attributes
    ----------
    feet : what is known of the left and the right foot
    rate_hz : sampling rate
    waiting : pairs since the stand, the newest included, that are to be run first
    """

    kind: StartKind
    feet: Standstills
    rate_hz: float
    waiting: tuple[Pair, ...] = ()


class FootWatch:
    """Watches one foot: windows of it, the stand it is in, and what ended the last one."""

    def __init__(self, config: TrackerConfig) -> None:
        """Start with no sample."""
        self._config = config
        length = config.alignment.window
        self._slider, self._short = WindowSlider(length), WindowSlider(min(SHORTEST_S, length))
        self.stand, self._short_stand = FootStand(config.alignment), FootStand(config.alignment)
        self.complaint: str | None = None
        self.still = False
        self.quiet_s = 0.0
        self.restarts = 0
        self.refining = False

    def add(self, stamp_ns: int, values: FloatArray) -> bool:
        """Take a sample (6,); return True when a window ended with it."""
        short = self._short.add(stamp_ns, values)
        if short is not None:
            self._take_short(short)
        window = self._slider.add(stamp_ns, values)
        if window is not None:
            self._take(window)
        return short is not None or window is not None

    def _take_short(self, window: Window) -> None:
        """Let the newest short window stand for a stand that is not longer than that."""
        config = self._config
        self.still = window.motion(config.alignment, config.gravity) is None
        self._short_stand.clear()
        if self.still:
            self._short_stand.add(window)

    def _take(self, window: Window) -> None:
        config = self._config
        self.complaint = window.motion(config.alignment, config.gravity)
        if self.complaint is None:
            self.stand.add(window)
        elif not self.refining:
            self.restarts += self.stand.count > 0
            self.stand.clear()
        step = self._slider.step_s
        quiet = self.complaint is None and window.quiet(config.alignment)
        self.quiet_s = (self.quiet_s + step if self.quiet_s else window.seconds) if quiet else 0.0

    @property
    def standstill(self) -> FootStandstill | None:
        """What the stand that the foot is in tells; None while it moves."""
        if not self.still:
            return None
        if self.stand.count:
            return self.stand.result()
        return self._short_stand.result() if self._short_stand.count else None


class Alignment:
    """Collects pairs until a track can start; afterwards refines what a stand tells."""

    def __init__(
        self, config: TrackerConfig, priors: Mapping[str, BiasPrior] | None = None
    ) -> None:
        """Start with no pair; ``priors`` are gyro biases that are known by foot."""
        self._config, self._priors = config, dict(priors or {})
        self.rate = SamplingRate()
        self._watches = tuple(FootWatch(config) for _ in FEET)
        self._first_stances = FirstStances(config)
        self._waiting: deque[Pair] = deque()
        self._candidate: Standstills | None = None
        self._without_stand: Standstills | None = None
        self._since_ns: int | None = None  # of the first candidate, or of the first pair
        self._levelled = 0

    @property
    def complaint(self) -> str | None:
        """Why the feet do not stand, if they do not."""
        for foot, watch in zip(FEET, self._watches, strict=True):
            if watch.complaint is not None:
                return f"{foot} foot: {watch.complaint}"
        return None

    @property
    def restarts(self) -> int:
        """Number of stands that motion has ended."""
        return max(watch.restarts for watch in self._watches)

    def add(self, stamp_ns: int, values: FloatArray) -> Start | None:
        """Take a pair (12,); return the start when there is one."""
        values = values.copy()
        self.rate.add(stamp_ns)
        self._waiting.append((stamp_ns, values))
        if self._since_ns is None:
            self._since_ns = stamp_ns
        if self._candidate is None and self._without_stand is None:
            self._without_stand = self._first_stances.add(stamp_ns, values)
            if self._without_stand is not None:
                self._waiting.clear()
        if self._look(stamp_ns, values):
            self._consider(stamp_ns)
            if min(w.quiet_s for w in self._watches) >= self._config.alignment.duration:
                return self._start(StartKind.STAND, self._candidate)
        if stamp_ns - self._since_ns < self._config.alignment.patience * 1e9:
            return None
        return self.finish()

    def finish(self) -> Start | None:
        """Return a start from what is there, when no more pairs will come."""
        if self._candidate is not None:
            return self._start(StartKind.RESTLESS_STAND, self._candidate)
        return self._start(StartKind.FIRST_STANCE, self._without_stand)

    def refine(self, stamp_ns: int, values: FloatArray) -> bool:
        """Take one more pair of a stand; return True when a window's length more is known."""
        for watch in self._watches:
            watch.refining = True
        self._look(stamp_ns, values)
        length = min(watch.stand.count for watch in self._watches) // SLIDES
        more, self._levelled = length > self._levelled, length
        return more

    def _look(self, stamp_ns: int, values: FloatArray) -> bool:
        """Take a pair; return whether a window of either foot ended with it."""
        parts = values[:6].copy(), values[6:].copy()
        ended = [w.add(stamp_ns, part) for w, part in zip(self._watches, parts, strict=True)]
        return any(ended)

    def _consider(self, stamp_ns: int) -> None:
        """Keep what the feet stand on now, unless something better is kept."""
        left, right = (watch.standstill for watch in self._watches)
        if left is None or right is None:
            return
        kept = self._candidate
        if kept is None:
            self._since_ns = stamp_ns
        elif max(left.rate_std, right.rate_std) > max(foot.rate_std for foot in kept):
            since_ns = stamp_ns - max(foot.end_ns for foot in kept)
            if since_ns > self._config.alignment.window * 1e9:
                return
        self._candidate = left, right
        self._waiting.clear()

    def result(self) -> Standstills:
        """Return what the stand tells, with what was known before it."""
        left, right = (watch.stand.result() for watch in self._watches)
        return self._combined((left, right))

    def _combined(self, feet: Standstills) -> Standstills:
        """Return the standstills with the priors; both biases have the larger uncertainty.

        The scatter of a stand is a bad weight between the feet: the one that happened to be
        stiller would draw the other to its heading.
        """
        known = []
        for name, foot in zip(FEET, feet, strict=True):
            prior = self._priors.get(name, UNKNOWN_BIAS)
            known.append(prior.combined(foot.angular_rate, foot.rate_std))
        largest = max(std for _, std in known)
        left, right = (f.with_bias(b, largest) for f, (b, _) in zip(feet, known, strict=True))
        return left, right

    def _start(self, kind: StartKind, feet: Standstills | None) -> Start | None:
        rate_hz = self.rate.hz
        if rate_hz is None or feet is None:
            return None
        self._levelled = min(watch.stand.count for watch in self._watches) // SLIDES
        return Start(kind, self._combined(feet), rate_hz, tuple(self._waiting))
