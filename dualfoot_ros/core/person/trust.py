"""How far the position can be trusted: the 95 % radius now, and when it will pass a limit.

Dead reckoning errs by its heading.  With the heading variance s(l) along the way l, the heading
error e and the position error p obey dp = e n dl (n to the left of the way), and the covariance of
heading and position is the integral of s n, because a heading error stays.  From there on straight
ahead, at the present pace, the covariance of the position is

    P + l (c n' + n c') + l^2 s n n' + (growth of s) + (what grows with the way otherwise).

It needs no more than positions, their covariances and heading variances, live and of a recording.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..samples.series import FloatArray

# Radius of the circle that holds 95 % of a normal distribution, over its greater standard
# deviation, by the ratio of the smaller to the greater one: 0, 0.1 ... 1.
RADIUS_95 = (1.96, 1.9625, 1.9704, 1.9842, 2.0051, 2.0359, 2.0813, 2.146, 2.2303, 2.3318, 2.4477)
PACE_S = 10.0  # over which the pace is taken
SLOW = 0.2  # m/s; who is slower stands
USUAL_PACE = 1.2  # m/s, before anybody has walked
PRECISION_M = 0.1  # of a way that is foretold
LOST_HEADING_STD = 0.5  # rad, standard deviation of a heading beyond which it is lost
FARTHEST_M = 1.0e5  # beyond this nothing is foretold


@dataclass(frozen=True)
class Trust:
    """What the position is worth.

    Attributes
    ----------
    radius_m : horizontal distance from the truth that is not exceeded with 95 % probability
    limit_m : radius up to which the position is trusted
    heading_known : before that the position is known, but not in which direction the walk goes
    way_left_m : way straight ahead until the radius passes the limit; infinite when it will not
    time_left_s : the same at the present pace; infinite for a person who stands
    pace : m/s
    heading_std : rad
    """

    stamp_ns: int
    radius_m: float
    limit_m: float
    heading_known: bool
    way_left_m: float
    time_left_s: float
    pace: float
    heading_std: float = 0.0

    @property
    def trusted(self) -> bool:
        """Whether the radius is within the limit."""
        return self.radius_m <= self.limit_m

    @property
    def heading_lost(self) -> bool:
        """Whether the heading was known and is so no more."""
        return self.heading_known and self.heading_std > LOST_HEADING_STD


class TrustTracker:
    """Follows a person; asked at any time, it says how long the position can be trusted."""

    def __init__(self, limit_m: float = 3.0) -> None:
        """Trust a position up to a radius of ``limit_m`` m."""
        self.limit_m = limit_m
        self.clear()

    def clear(self) -> None:
        """Forget everything."""
        self._path: list[tuple[float, float]] = []  # time (s), way (m), of the last PACE_S
        self._start_ns: int | None = None
        self._place = self._origin = np.zeros(2)
        self._ahead = np.array([1.0, 0.0])
        self._way_m, self._known_way_m, self._pace = 0.0, 0.0, USUAL_PACE
        self._cross = np.zeros(2)  # covariance of heading and position, rad m
        self._by_heading = np.zeros((2, 2))  # part of the covariance that the heading has made
        self._first_variance: float | None = None

    def add(
        self,
        stamp_ns: int,
        position: FloatArray,
        covariance: FloatArray,
        heading_variance: float,
        *,
        heading_known: bool = True,
    ) -> None:
        """Take the person: position (2,) m, covariance (2, 2) m^2, heading variance rad^2.

        About one a second is enough.
        """
        if self._start_ns is None:
            self._start_ns = stamp_ns
            self._place = self._origin = position.copy()
        step = position - self._place
        length = math.hypot(step[0], step[1])
        self._stamp_ns, self._covariance = stamp_ns, covariance.copy()
        self._variance, self._known = heading_variance, heading_known
        if heading_known:
            self._walk(step, length)
        self._place = position.copy()
        self._way_m += length
        self._note_pace((stamp_ns - self._start_ns) * 1e-9)

    def _walk(self, step: FloatArray, length: float) -> None:
        """Carry on what the heading error does to the position over a ``step`` (2,) m."""
        if self._first_variance is None:
            self._first_variance, self._first_ns = self._variance, self._stamp_ns
            # The first strides, too, were made with the heading error that is left after them.
            step = self._place + step - self._origin
        across = np.array([-step[1], step[0]])
        outer = np.outer(self._cross, across)
        self._by_heading += outer + outer.T + self._variance * np.outer(across, across)
        self._cross += self._variance * across
        self._known_way_m += length
        if length > SLOW:
            self._ahead = step / length

    def _note_pace(self, time_s: float) -> None:
        self._path.append((time_s, self._way_m))
        while len(self._path) > 2 and self._path[1][0] <= time_s - PACE_S:
            del self._path[0]
        passed = time_s - self._path[0][0]
        walked = self._way_m - self._path[0][1]
        self._slow = passed <= 0.0 or walked < SLOW * passed
        if not self._slow:
            self._pace = walked / passed

    def result(self) -> Trust | None:
        """Return what the position is worth now; None before the first estimate."""
        if self._start_ns is None:
            return None
        radius = radius_95(self._covariance)
        way = self._way_left(radius)
        time_s = way / self._pace if way == 0.0 or not self._slow else math.inf
        pace = 0.0 if self._slow else self._pace
        known = self._known
        heading_std = math.sqrt(self._variance)
        return Trust(self._stamp_ns, radius, self.limit_m, known, way, time_s, pace, heading_std)

    def _way_left(self, radius: float) -> float:
        """Return the way (m) straight ahead until the radius passes the limit."""
        if radius > self.limit_m:
            return 0.0
        if not self._known or radius_95(self._after(FARTHEST_M)) <= self.limit_m:
            return math.inf
        near, far = 0.0, FARTHEST_M
        while far - near > PRECISION_M:
            middle = 0.5 * (near + far)
            if radius_95(self._after(middle)) > self.limit_m:
                far = middle
            else:
                near = middle
        return near

    def _after(self, way: float) -> FloatArray:
        """Return the covariance (2, 2) m^2 of the position ``way`` m farther on."""
        across = np.array([-self._ahead[1], self._ahead[0]])
        outer = way * np.outer(self._cross, across)
        noise = max(0.0, float(np.trace(self._covariance - self._by_heading)))
        noise *= 0.5 * way / max(self._known_way_m, 1.0)
        ahead = way * way * (self._variance + self._variance_growth(way / self._pace))
        after: FloatArray = (
            self._covariance
            + outer
            + outer.T
            + ahead * np.outer(across, across)
            + noise * np.eye(2)
        )
        return after

    def _variance_growth(self, time_s: float) -> float:
        """Return what the growing variance of the heading adds over ``time_s`` s, rad^2.

        It has grown by g a second: as that of a noise goes on, and as that of a bias does.
        """
        if self._first_variance is None:
            return 0.0
        since = max(1.0, (self._stamp_ns - self._first_ns) * 1e-9)
        growth = max(0.0, self._variance - self._first_variance) / since
        return growth * time_s + 0.25 * growth * time_s**2 / since


def radius_95(covariance: FloatArray) -> float:
    """Return the radius (m) that holds 95 % of a normal error with ``covariance`` (2, 2) m^2."""
    half = 0.5 * (covariance[0, 0] + covariance[1, 1])
    apart = math.hypot(0.5 * (covariance[0, 0] - covariance[1, 1]), covariance[0, 1])
    greater, smaller = math.sqrt(max(half + apart, 0.0)), math.sqrt(max(half - apart, 0.0))
    ratio = smaller / greater if greater > 0.0 else 0.0
    return greater * float(np.interp(10.0 * ratio, range(11), RADIUS_95))
