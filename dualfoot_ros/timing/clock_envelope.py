"""Lower envelope of the delay: offset and skew of a clock from one-way arrivals.

Arrival minus device stamp is offset + skew x time + delay, and a delay is never negative, so the
clock is the line under all these points.  For delays that are exponentially distributed above
their least value the most likely line maximises the sum of its heights under the constraint to
stay below every point: the linear programme of Moon, Skelly and Towsley, "Estimation and removal
of clock skew from network delay measurements" (INFOCOM 1999), whose solution is an edge of the
lower convex hull (Zhang, Liu and Xia, "Clock synchronization algorithms for network measurements",
INFOCOM 2002).  Here the same likelihood is kept whole rather than only its maximum: for skew b,
with d_i(b) the delays above the highest line of that slope that is below all points,

    log p(b) = -sum_i min(d_i(b), r) / s - log(1 + (b / b0)^2) + const,

s the mean delay, b0 the scale of a Cauchy prior, and r a reach beyond which a delay says no more:
a stall of 20 s would else tilt the line.  Its mean is the estimate, its spread the uncertainty.
The least delay itself stays in the offset: no one-way measurement can tell it from an offset
(Cristian 1989 needs the way back for that).
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from ..core.series import FloatArray

STEEPEST = 0.05  # |skew| that is looked for
ROUNDS, NODES, DEPTH = 5, 41, 18.0  # quadrature: refinements, nodes, log density kept
SCALE_S = 0.005  # mean delay of a bin's fastest arrival above the line: guess worth two bins,
SCALE_LIMITS_S = (2.0e-5, 0.05)  # and what it can be
REACH_S = 0.25  # a bin whose fastest arrival is later than this was stalled, and says no more
SHARE = 0.25  # of the bins, the fastest, that tell it: stalls must not


@dataclass(frozen=True)
class Line:
    """Offset of a clock as a straight line in time, with its uncertainty.

    Attributes
    ----------
    center_s : time at which ``height_s`` holds
    height_s, skew : offset in s there, and its slope
    height_var, skew_var, covariance : of the two, s^2, 1, s
    scale_s : mean delay above the line of the fastest arrival of a bin
    points : number of bins it rests on
    """

    center_s: float
    height_s: float
    skew: float
    height_var: float
    skew_var: float
    covariance: float
    scale_s: float
    points: int

    def at(self, time_s: float) -> float:
        """Return the offset in s at ``time_s``."""
        return self.height_s + self.skew * (time_s - self.center_s)

    def std_at(self, time_s: float) -> float:
        """Return the standard deviation of the offset in s at ``time_s``."""
        lever = time_s - self.center_s
        variance = self.height_var + 2.0 * lever * self.covariance + lever**2 * self.skew_var
        return math.sqrt(max(variance, 0.0))


class LowerEnvelope:
    """Keep the fastest arrival of every bin over a sliding horizon, and fit the line below them.

    Memory and time are bounded by the number of bins.  All arguments are seconds relative to an
    origin near the data, so that floats are good to less than a nanosecond over days.
    """

    def __init__(self, bin_s: float, bins: int, skew_scale: float) -> None:
        self._bin_s, self._prior = bin_s, skew_scale
        self._fastest: deque[tuple[float, float]] = deque(maxlen=bins)
        self._number: int | None = None
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
        """Return the line as another prior of the skew has it; only after the first arrival."""
        assert self.line is not None
        return posterior(np.array(self._fastest), self.line.scale_s, skew_scale)

    def add(self, time_s: float, delayed_s: float) -> bool:
        """Take one arrival; return True when it told something new and the line was refitted.

        ``delayed_s`` is arrival minus device stamp.  Arrivals of older bins are left out.
        """
        number = math.floor(time_s / self._bin_s)
        if self._number is None or number > self._number:
            self._number = number
            self._fastest.append((time_s, delayed_s))
            self._fit()
            return True
        if number < self._number or not self._improves(time_s, delayed_s):
            return False
        self._fastest[-1] = (time_s, delayed_s)
        if self.line is None or delayed_s < self.line.at(time_s) or len(self._fastest) < 10:
            self._fit()
            return True
        return False

    def _improves(self, time_s: float, delayed_s: float) -> bool:
        """Tell whether the arrival is faster than that of its bin, the known skew taken off."""
        then_s, best_s = self._fastest[-1]
        skew = self.line.skew if self.line else 0.0
        return delayed_s - best_s < skew * (time_s - then_s)

    def _fit(self) -> None:
        points = np.array(self._fastest)
        scale = self.line.scale_s if self.line else SCALE_S
        line = posterior(points, scale, self._prior)
        above = points[:, 1] - line.height_s - line.skew * (points[:, 0] - line.center_s)
        above = above[above < REACH_S]
        count = len(above)
        seen = -float(np.quantile(above, SHARE)) / math.log(1.0 - SHARE) if count else 0.0
        scale = (2.0 * SCALE_S + count * seen) / (count + 2.0)
        scale = min(max(scale, SCALE_LIMITS_S[0]), SCALE_LIMITS_S[1])
        self.line = posterior(points, scale, self._prior)


def posterior(points: FloatArray, scale_s: float, skew_scale: float) -> Line:
    """Return mean and spread of the lines below ``points`` (n, 2): time s, offset plus delay s."""
    count = len(points)
    center = float(points[:, 0].mean())
    lever, low = points[:, 0] - center, float(points[:, 1].min())
    high = points[:, 1] - low
    first, last = -STEEPEST, STEEPEST
    for _ in range(ROUNDS):
        skew = np.linspace(first, last, NODES)
        delayed = high - skew[:, None] * lever
        height = delayed.min(axis=1)
        delay = np.minimum(delayed - height[:, None], REACH_S)
        log_p = -delay.sum(axis=1) / scale_s - np.log1p((skew / skew_scale) ** 2)
        log_p -= log_p.max()
        good = np.flatnonzero(log_p > -DEPTH)
        first, last = skew[max(good[0] - 1, 0)], skew[min(good[-1] + 1, NODES - 1)]
    p = np.exp(log_p)
    p /= p.sum()
    mean_skew, mean_height = float(p @ skew), float(p @ height)
    d_skew, d_height = skew - mean_skew, height - mean_height
    below = scale_s / count  # the height itself is exponential below the highest line
    return Line(
        center_s=center,
        height_s=low + mean_height - below,
        skew=mean_skew,
        height_var=float(p @ d_height**2) + below**2,
        skew_var=float(p @ d_skew**2),
        covariance=float(p @ (d_skew * d_height)),
        scale_s=scale_s,
        points=count,
    )
