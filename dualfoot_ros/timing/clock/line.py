"""The line of a clock: host minus device as it runs with time, from one-way arrivals.

Arrival minus device stamp is offset + skew x time + delay, and a delay is never negative, so the
clock is the line under all these points.  For delays that are exponentially distributed above
their least value the most likely line maximises the sum of its heights under the constraint to
stay below every point: the linear programme of Moon, Skelly and Towsley, "Estimation and removal
of clock skew from network delay measurements" (INFOCOM 1999), whose solution is an edge of the
lower convex hull (Zhang, Liu and Xia, "Clock synchronization algorithms for network measurements",
INFOCOM 2002).  Here the same likelihood is kept whole and not only its maximum
(:class:`LinesBelow`).

On a link that delivers at certain events only, as Bluetooth Low Energy does, a delay is the wait
for the next event, which is shorter than the interval between events unless one failed.  So the
clock is also *above* all points less an interval, but for a few (:func:`fit_between`).

The least delay itself stays in the offset: no one-way measurement can tell it from an offset
(Cristian 1989 needs the way back for that).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray

STEEPEST = 0.05  # |skew| that is looked for
ROUNDS, NODES, DEPTH = 4, 41, 18.0  # quadrature: refinements, nodes, log density kept
STEPS = np.arange(NODES, dtype=np.float64)
REACH_S = 0.25  # a bin whose fastest arrival is later than this was stalled, and says no more
FAILED = 0.1  # share of the events that fail
EDGES = 16  # of them in a row that are reckoned with
EVENT_STD_S = 1.0e-4  # of the time of an event


def _slopes(first: float, last: float) -> FloatArray:
    """Return even slopes as np.linspace does, which takes as long as all the rest of a round."""
    slopes: FloatArray = STEPS * ((last - first) / (NODES - 1)) + first
    slopes[-1] = last
    return slopes


WIDE = _slopes(-STEEPEST, STEEPEST)


@dataclass(frozen=True)
class Line:
    """Offset of a clock as a straight line in time, with its uncertainty.

    Attributes
    ----------
    center_s : time at which ``height_s`` holds
    height_s, skew : offset in s there, and its slope
    height_var, skew_var, covariance : of the two, s^2, 1, s
    """

    center_s: float
    height_s: float
    skew: float
    height_var: float
    skew_var: float
    covariance: float

    def at(self, time_s: float) -> float:
        """Return the offset in s at ``time_s``."""
        return self.height_s + self.skew * (time_s - self.center_s)

    def std_at(self, time_s: float) -> float:
        """Return the standard deviation of the offset in s at ``time_s``."""
        lever = time_s - self.center_s
        variance = self.height_var + 2.0 * lever * self.covariance + lever**2 * self.skew_var
        return math.sqrt(max(variance, 0.0))


class LinesBelow:
    """The lines below ``points`` (n, 2): time s, offset plus delay s.

    For skew b, with d_i(b) the delays above the highest line of that slope below all points,

        log p(b) = -sum_i min(d_i(b), r) / s - log(1 + (b / b0)^2) + const,

    s the mean delay, b0 the scale of a Cauchy prior, and r a reach beyond which a delay says no
    more: a stall of 20 s would else tilt the line.
    """

    def __init__(self, points: FloatArray) -> None:
        self._center, self._lever, self._low, self._high = _centered(points)
        self._wide = self._delays(WIDE)  # every fit begins with the same slopes

    def fit(self, scale_s: float, skew_scale: float) -> Line:
        """Return mean and spread of the lines for s ``scale_s`` and b0 ``skew_scale``."""
        skew, (height, delays) = WIDE, self._wide
        log_p = -delays / scale_s + _prior(skew, skew_scale)
        for _ in range(ROUNDS - 1):
            skew = _slopes(*_support(skew, log_p))
            height, delays = self._delays(skew)
            log_p = -delays / scale_s + _prior(skew, skew_scale)
        under = scale_s / len(self._lever)  # the height is exponential below the highest line
        spread = np.full(NODES, under**2)
        return _mean(self._center, self._low, skew, log_p, height - under, spread)

    def _delays(self, skew: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return height and sum of the delays (m,) of the highest lines of slopes (m,)."""
        delayed = self._high - skew[:, None] * self._lever
        height = np.minimum.reduce(delayed, axis=1)
        delayed -= height[:, None]
        return height, np.add.reduce(np.minimum(delayed, REACH_S, out=delayed), axis=1)


def fit_between(
    points: FloatArray, waits: FloatArray, interval_s: float, near: Line, skew_scale: float
) -> Line:
    """Return mean and spread of the lines below ``points`` and within an interval of ``waits``.

    Both are (n, 2), time s, offset plus delay s.  A line is as likely as ``FAILED`` to the power
    of the number of ``waits`` that are more than an interval above it, times the Cauchy prior.
    Lines are looked for around ``near``.
    """
    center, lever, low, high = _centered(points)
    wait_lever, least = waits[:, 0] - center, waits[:, 1] - low - interval_s
    wide = 6.0 * math.sqrt(near.skew_var) + 2.0 * interval_s / max(float(np.ptp(lever)), 1.0)
    first, last = near.skew - wide, near.skew + wide
    for _ in range(ROUNDS):
        skew = _slopes(first, last)
        top = (high - skew[:, None] * lever).min(axis=1)
        mass, height, square = _strips(top, least - skew[:, None] * wait_lever)
        log_p = np.log(mass) + _prior(skew, skew_scale)
        first, last = _support(skew, log_p)
    return _mean(center, low, skew, log_p, height, square - height**2 + EVENT_STD_S**2)


def _strips(top: FloatArray, edges: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return integral, mean and mean square over heights below ``top`` (m,), for m slopes.

    The density falls to ``FAILED`` of itself at each of the ``edges`` (m, n) one passes on the way
    down.  That is relative to the slope that passes the fewest edges above its top, and only the
    highest edges are looked at: what is below has no weight.
    """
    fewest = int((edges > top[:, None]).sum(axis=1).min())
    lowest = max(edges.shape[1] - fewest - EDGES, 0)
    edges = np.partition(edges, lowest, axis=1)[:, lowest:]
    edges = -np.sort(-edges, axis=1)
    bounds = np.column_stack([top, np.minimum(edges, top[:, None])])
    passed = np.maximum(np.arange(edges.shape[1]) - fewest, 0)
    strip = -np.diff(bounds, axis=1) * FAILED**passed
    upper, lower = bounds[:, :-1], bounds[:, 1:]
    mass = strip.sum(axis=1) + np.finfo(np.float64).tiny
    height = (strip * (upper + lower)).sum(axis=1) / (2.0 * mass)
    square = (strip * (upper**2 + upper * lower + lower**2)).sum(axis=1) / (3.0 * mass)
    return mass, height, square


def _centered(points: FloatArray) -> tuple[float, FloatArray, float, FloatArray]:
    center, low = float(points[:, 0].mean()), float(points[:, 1].min())
    return center, points[:, 0] - center, low, points[:, 1] - low


def _prior(skew: FloatArray, scale: float) -> FloatArray:
    return -np.log1p((skew / scale) ** 2)


def _support(skew: FloatArray, log_p: FloatArray) -> tuple[float, float]:
    """Return the skews between which the density is not negligible."""
    good = log_p > np.maximum.reduce(log_p) - DEPTH
    first, last = int(good.argmax()), len(good) - 1 - int(good[::-1].argmax())
    return float(skew[max(first - 1, 0)]), float(skew[min(last + 1, len(skew) - 1)])


def _mean(
    center: float,
    low: float,
    skew: FloatArray,
    log_p: FloatArray,
    height: FloatArray,
    height_var: FloatArray,
) -> Line:
    """Return the line that is the mean over the slopes ``skew`` (m,) of the given heights."""
    p = np.exp(log_p - np.maximum.reduce(log_p))
    p /= np.add.reduce(p)
    mean_skew, mean_height = float(p @ skew), float(p @ height)
    d_skew, d_height = skew - mean_skew, height - mean_height
    return Line(
        center_s=center,
        height_s=low + mean_height,
        skew=mean_skew,
        height_var=float(p @ (d_height**2 + height_var)),
        skew_var=float(p @ d_skew**2),
        covariance=float(p @ (d_skew * d_height)),
    )
