"""The distance of the feet side by side: given, or learnt from the walk.

A stand does not show it, and neither does a straight line: the lateral offset of two tracks that
each start anywhere is a gauge.  A turn does.  Let u be the separation of the feet (left minus
right) in passing, as it would be without any constraint.  With n the unit vector to the left of
the walk, s the spacing and a the error of where the feet were placed at the start,

    u = s n + a + noise,

so as soon as n has turned, s and a part.  Heading drift makes a wander slowly.  Strides of one
foot that are measured too long make it run along the walk, by d a passing: in circles one way
round that looks like a spacing (0.1 % of the way is 0.06 m on laps of 400 m), the other way round
it has the other sign.  A Kalman filter of (s, a, d) is all it takes; until the walk has turned,
and where it turns one way only, it stays near its prior and says so.
"""

from __future__ import annotations

import math

import numpy as np

from ..joint_estimate import Outcome
from ..results.payloads import Passing
from ..samples.series import FloatArray

PRIOR_M = 0.15  # feet side by side, both sensors on the insteps
PRIOR_STD_M = 0.04
PLACEMENT_STD_M = 0.1  # how far off the feet may have been placed
STRIDE_STD_M = 0.003  # by which one foot runs ahead of the other from passing to passing
WANDER_STD_M = 0.03  # by which that wanders from one passing to the next
ACROSS_STD_M = 0.04  # from passing to passing, across and along the walk
ALONG_STD_M = 0.1


class SpacingLearner:
    """Estimates the spacing from the separations in passing."""

    def __init__(self) -> None:
        """Start from the prior."""
        self._x = np.array([PRIOR_M, 0.0, 0.0, 0.0])
        self._p = np.diag([PRIOR_STD_M, PLACEMENT_STD_M, PLACEMENT_STD_M, STRIDE_STD_M]) ** 2
        self._free: FloatArray | None = None  # the separation without constraints
        self._after = np.zeros(2)

    @property
    def spacing_m(self) -> float:
        """The spacing."""
        return float(self._x[0])

    @property
    def std_m(self) -> float:
        """Its standard deviation."""
        return math.sqrt(float(self._p[0, 0]))

    def add(self, before: FloatArray, after: FloatArray, heading: float) -> None:
        """Take one passing: separations (2,) m before and after its constraint, heading in rad."""
        self._free = before.copy() if self._free is None else self._free + before - self._after
        self._after = after.copy()
        c, s = math.cos(heading), math.sin(heading)
        x, y = float(self._free[0]), float(self._free[1])
        self._go_on(c, s)
        self._observe(np.array([1.0, -s, c, 0.0]), c * y - s * x, ACROSS_STD_M**2)
        self._observe(np.array([0.0, c, s, 0.0]), c * x + s * y, ALONG_STD_M**2)

    def _go_on(self, c: float, s: float) -> None:
        """Let the placement run along the walk, whose direction is (c, s), and wander."""
        step = np.eye(4)
        step[1:3, 3] = c, s
        self._x = step @ self._x
        self._p = step @ self._p @ step.T
        self._p[1, 1] += WANDER_STD_M**2
        self._p[2, 2] += WANDER_STD_M**2

    def _observe(self, row: FloatArray, value: float, variance: float) -> None:
        cross = self._p @ row
        gain = cross / (float(row @ cross) + variance)
        self._x += gain * (value - float(row @ self._x))
        self._p -= np.outer(gain, cross)

    def restart(self) -> None:
        """Keep the spacing but forget the placement: the track was turned or moved."""
        self._free = None
        self._x[1:3] = 0.0
        self._p[1:3, :] = self._p[:, 1:3] = 0.0
        self._p[1, 1] = self._p[2, 2] = PLACEMENT_STD_M**2


class Spacing:
    """The spacing a method constrains to: as given, or as learnt so far."""

    def __init__(self, given_m: float) -> None:
        """Use ``given_m``, or learn when it is zero."""
        self._given = given_m
        self.learner = SpacingLearner() if given_m == 0.0 else None

    @property
    def std_m(self) -> float:
        """Standard deviation of what has been learnt; zero when it was given."""
        return self.learner.std_m if self.learner else 0.0

    @property
    def value_m(self) -> float:
        """The spacing to constrain to now."""
        return self.learner.spacing_m if self.learner else self._given

    def note(self, outcome: Outcome) -> None:
        """Learn from a constraint that was applied, or found not to be needed."""
        passing = outcome.payload
        if self.learner is not None and isinstance(passing, Passing):
            before, after = np.array(passing.before[:2]), np.array(passing.after[:2])
            self.learner.add(before, after, passing.heading)

    def moved(self) -> None:
        """Take note that the tracks were turned or moved."""
        if self.learner is not None:
            self.learner.restart()
