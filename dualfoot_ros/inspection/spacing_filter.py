"""The Kalman filter of :mod:`.lateral_spacing`, in plain numbers.

Its matrices are so small that numpy would need ten times the time of their arithmetic.
"""

from __future__ import annotations

import math
from copy import copy
from typing import NamedTuple

from ..core import StancePassing

SPACING_STD_M = 0.3  # of either sign
PLACEMENT_STD_M = 0.3
HEADING_STD = 0.1  # rad; first strides are that unlike
SCALE_STD = 0.03
MOMENT_STD_M = 0.1
WANDER_STD_M = 0.02  # from passing to passing
HEADING_WANDER = 0.003  # rad from passing to passing
HEADING_PER_TURN = 0.02  # rad per rad: scale factors of the gyros
PLACE_PER_TURN = 0.003  # of the way so far, per rad
SCALE_WANDER = 0.001
ACROSS_STD_M = 0.04
ALONG_STD_M = 0.08
JUMP_NIS = 20.0

S, A_X, A_Y, DELTA, EPSILON, D = range(6)
STATES = 6


class _Innovation(NamedTuple):
    """What a passing says beyond what is expected: along the walk given what it says across.

    Attributes
    ----------
    across, along : m
    of_across, of_along : their covariances with the states
    across_variance, along_variance : their own
    square_m2 : of all that was not expected, in both directions
    """

    across: float
    along: float
    of_across: list[float]
    of_along: list[float]
    across_variance: float
    along_variance: float
    square_m2: float

    @property
    def nis(self) -> float:
        """Normalised innovation squared, two degrees of freedom."""
        return self.across**2 / self.across_variance + self.along**2 / self.along_variance


class SpacingFilter:
    """Kalman filter of spacing, placement (2), heading and scale difference, moment."""

    def __init__(self) -> None:
        self.x = [0.0] * STATES
        place, moment = PLACEMENT_STD_M**2, MOMENT_STD_M**2
        first = [SPACING_STD_M**2, place, place, HEADING_STD**2, SCALE_STD**2, moment]
        self.p = [[v if i == j else 0.0 for j in range(STATES)] for i, v in enumerate(first)]
        self.jumps = 0
        self.nis = 0.0  # sum over the passings, two degrees of freedom each
        self.taken = 0
        self._last: StancePassing | None = None
        self._way_m = 0.0

    def copy(self) -> SpacingFilter:
        """Return the same filter, which goes on by itself."""
        own = copy(self)
        own.x, own.p = list(self.x), [list(row) for row in self.p]
        return own

    def add(self, passing: StancePassing) -> None:
        """Go on to ``passing`` and take it."""
        if self._last is not None:
            self._advance(passing, self._last)
        self._last = passing
        found = self._innovation(passing)
        if found.nis > JUMP_NIS:
            self._place_anew(found.square_m2)
            found = self._innovation(passing)
        self._update(found)
        self.nis += found.nis
        self.taken += 1

    @property
    def std_m(self) -> float:
        """Standard deviation of the spacing, larger where the tracks scatter more than due."""
        excess = self.nis / (2.0 * self.taken) if self.taken else 1.0
        return math.sqrt(self.p[S][S] * max(1.0, excess))

    def _advance(self, passing: StancePassing, last: StancePassing) -> None:
        x, p = self.x, self.p
        way_x, way_y = (passing.middle - last.middle).tolist()
        self._way_m += math.hypot(way_x, way_y)
        turned = _angle(last.forward.tolist(), passing.forward.tolist())
        x[A_X] += way_x * x[EPSILON] - way_y * x[DELTA]
        x[A_Y] += way_y * x[EPSILON] + way_x * x[DELTA]
        of_scale, of_heading = p[EPSILON], p[DELTA]
        pairs = list(zip(of_scale, of_heading, strict=True))
        p[A_X] = [a + way_x * e - way_y * d for a, (e, d) in zip(p[A_X], pairs, strict=True)]
        p[A_Y] = [a + way_y * e + way_x * d for a, (e, d) in zip(p[A_Y], pairs, strict=True)]
        for row in p:
            scale, heading = row[EPSILON], row[DELTA]
            row[A_X] += way_x * scale - way_y * heading
            row[A_Y] += way_y * scale + way_x * heading
        place = WANDER_STD_M**2 + (PLACE_PER_TURN * self._way_m * turned) ** 2
        p[A_X][A_X] += place
        p[A_Y][A_Y] += place
        p[DELTA][DELTA] += HEADING_WANDER**2 + (HEADING_PER_TURN * turned) ** 2
        p[EPSILON][EPSILON] += SCALE_WANDER**2

    def _innovation(self, passing: StancePassing) -> _Innovation:
        x, p = self.x, self.p
        forward_x, forward_y = passing.forward.tolist()
        apart_x, apart_y = passing.separation.tolist()
        sign = 1.0 if passing.standing == 1 else -1.0
        left_x, left_y = apart_x - x[A_X], apart_y - x[A_Y]  # to be explained by spacing, moment
        across = left_y * forward_x - left_x * forward_y - x[S]
        along = left_x * forward_x + left_y * forward_y - sign * x[D]
        of_across = [row[S] + row[A_Y] * forward_x - row[A_X] * forward_y for row in p]
        of_along = [row[A_X] * forward_x + row[A_Y] * forward_y + sign * row[D] for row in p]
        variance = of_across[S] + of_across[A_Y] * forward_x - of_across[A_X] * forward_y
        variance += ACROSS_STD_M**2
        both = of_along[S] + of_along[A_Y] * forward_x - of_along[A_X] * forward_y
        its_own = of_along[A_X] * forward_x + of_along[A_Y] * forward_y + sign * of_along[D]
        share = both / variance
        return _Innovation(
            across,
            along - share * across,
            of_across,
            [one - share * other for one, other in zip(of_along, of_across, strict=True)],
            variance,
            its_own + ALONG_STD_M**2 - share * both,
            across**2 + along**2,
        )

    def _update(self, found: _Innovation) -> None:
        across = [c / found.across_variance for c in found.of_across]
        along = [c / found.along_variance for c in found.of_along]
        for i, (u, v) in enumerate(zip(across, along, strict=True)):
            self.x[i] += u * found.across + v * found.along
            columns = zip(self.p[i], found.of_across, found.of_along, strict=True)
            self.p[i] = [p - u * one - v * other for p, one, other in columns]

    def _place_anew(self, square_m2: float) -> None:
        self.jumps += 1
        for row in self.p:
            row[A_X] = row[A_Y] = 0.0
        variance = 4.0 * PLACEMENT_STD_M**2 + square_m2
        for state in (A_X, A_Y):
            self.p[state] = [variance if k == state else 0.0 for k in range(STATES)]


def _angle(before: list[float], after: list[float]) -> float:
    """Return by how much a direction has turned, rad, not negative."""
    (a, b), (c, d) = before, after
    return abs(math.atan2(a * d - b * c, a * c + b * d))
