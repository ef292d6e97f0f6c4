"""Lower envelope of the delay: offset and skew of a clock from one-way arrivals, online."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from ...core import FloatArray, quantile
from .event_waits import EventWaits
from .line import REACH_S, Line, LinesBelow, fit_between

SCALE_S = 0.005  # mean delay of a bin's fastest arrival above the line: guess worth two bins,
SCALE_LIMITS_S = (2.0e-5, 0.05)  # and what it can be
SHARE = 0.25  # of the bins, the fastest, that tell it: stalls must not


class LowerEnvelope:
    """Keep the fastest arrival of every bin over a sliding horizon, and fit the line below them.

    Memory and time are bounded by the number of bins.  All arguments are seconds relative to an
    origin near the data, so that floats are good to less than a nanosecond over days.

    ``scale_s`` is the mean delay above the line of the fastest arrival of a bin: at first the
    guess it is given, then what is seen.
    """

    def __init__(
        self, bin_s: float, bins: int, skew_scale: float, scale_s: float = SCALE_S
    ) -> None:
        self._bin_s, self._prior = bin_s, skew_scale
        self._fastest: deque[tuple[float, float]] = deque(maxlen=bins)
        self._waits = EventWaits(bin_s, bins)
        self._below: LinesBelow | None = None  # the fastest arrivals, once they are looked at
        self._number: int | None = None
        self._guess_s = self.scale_s = scale_s
        self.line: Line | None = None

    @property
    def points(self) -> list[tuple[float, float]]:
        """The fastest arrivals, (time, offset plus delay) in s, oldest first."""
        return list(self._fastest)

    @property
    def span_s(self) -> float:
        """Time the points span."""
        return self._fastest[-1][0] - self._fastest[0][0] if self._fastest else 0.0

    def fit(self, skew_scale: float) -> Line:
        """Return the line below the arrivals as another prior of the skew has it.

        Only after the first arrival.
        """
        self._below = self._below or LinesBelow(np.array(self._fastest))
        return self._below.fit(self.scale_s, skew_scale)

    def add(self, time_s: float, delayed_s: float) -> bool:
        """Take one arrival; return True when it told something new and the line was refitted.

        ``delayed_s`` is arrival minus device stamp.  Arrivals of older bins are left out.
        """
        number = math.floor(time_s / self._bin_s)
        if self._number is None or number > self._number:
            self._number = number
            self._fastest.append((time_s, delayed_s))
            self._below = None
            self._fit()
            return True
        if number < self._number or not self._improves(time_s, delayed_s):
            return False
        self._fastest[-1] = (time_s, delayed_s)
        self._below = None
        if self.line is None or delayed_s < self.line.at(time_s) or len(self._fastest) < 10:
            self._fit()
            return True
        return False

    def bound(self, time_s: float, delayed_s: float, interval_s: float) -> None:
        """Take a notification that waited for one of some events ``interval_s`` apart."""
        assert self.line is not None
        self._waits.add(time_s, delayed_s, interval_s, self.line)

    def unbound(self) -> None:
        """Learn that there are no such events."""
        self._waits.clear()

    def _improves(self, time_s: float, delayed_s: float) -> bool:
        """Tell whether the arrival is faster than that of its bin, the known skew taken off."""
        then_s, best_s = self._fastest[-1]
        skew = self.line.skew if self.line else 0.0
        return delayed_s - best_s < skew * (time_s - then_s)

    def _fit(self) -> None:
        points = np.array(self._fastest)
        self._below, waits = LinesBelow(points), self._waits
        line = self._below.fit(self.scale_s, self._prior)
        self.scale_s = self._scale(points, line)
        if len(waits):
            points = np.concatenate([points, waits.least])
            self.line = fit_between(points, waits.longest, waits.interval_s, line, self._prior)
        else:
            self.line = self._below.fit(self.scale_s, self._prior)

    def _scale(self, points: FloatArray, line: Line) -> float:
        """Return the mean delay of the points (n, 2) above the line; stalled ones do not count."""
        above = points[:, 1] - line.height_s - line.skew * (points[:, 0] - line.center_s)
        above = above[above < REACH_S]
        count = len(above)
        seen = -quantile(above, SHARE) / math.log(1.0 - SHARE) if count else 0.0
        scale = (2.0 * self._guess_s + count * seen) / (count + 2.0)
        return min(max(scale, SCALE_LIMITS_S[0]), SCALE_LIMITS_S[1])
