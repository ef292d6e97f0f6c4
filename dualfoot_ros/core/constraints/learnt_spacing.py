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
from collections.abc import Sequence

import numpy as np

from ..joint_estimate import Outcome
from ..kernel import Engine, interpreted
from ..kernel import layout as lay
from ..results.payloads import Passing
from ..samples.series import FloatArray

PRIOR_M = 0.15  # feet side by side, both sensors on the insteps
PRIOR_STD_M = 0.04
PLACEMENT_STD_M = 0.1  # how far off the feet may have been placed
STRIDE_STD_M = 0.003  # by which one foot runs ahead of the other from passing to passing


class SpacingLearner:
    """Estimates the spacing from the separations in passing; `learn_spacing` does the sums."""

    def __init__(self) -> None:
        """Start from the prior."""
        x = self.numbers = np.zeros(lay.L_SIZE)
        x[lay.L_STATE] = PRIOR_M
        stds = (PRIOR_STD_M, PLACEMENT_STD_M, PLACEMENT_STD_M, STRIDE_STD_M)
        np.fill_diagonal(self._covariance(), np.square(stds))
        self._engine: Engine | None = None

    def _covariance(self) -> FloatArray:
        """Return the covariance (4, 4) m^2 as a view."""
        return self.numbers[lay.L_COVARIANCE : lay.L_BEGUN].reshape(4, 4)

    def use(self, engine: Engine) -> None:
        """Go on with another form of the kernel; it is interpreted unless one is given."""
        self._engine = engine

    @property
    def spacing_m(self) -> float:
        """The spacing."""
        return self.numbers.item(lay.L_STATE)

    @property
    def std_m(self) -> float:
        """Its standard deviation."""
        return math.sqrt(self.numbers.item(lay.L_COVARIANCE))

    def add(self, before: Sequence[float], after: Sequence[float], heading: float) -> None:
        """Take one passing: separations m before and after its constraint, heading in rad.

        What they have beyond their two level components does not count.
        """
        engine = self._engine or interpreted()
        ahead = math.cos(heading), math.sin(heading)
        engine.learn_spacing(self.numbers, before[0], before[1], after[0], after[1], *ahead)

    def restart(self) -> None:
        """Keep the spacing but forget the placement: the track was turned or moved."""
        x, P = self.numbers, self._covariance()
        x[lay.L_BEGUN] = 0.0
        x[lay.L_STATE + 1 : lay.L_STATE + 3] = 0.0
        P[1:3, :] = P[:, 1:3] = 0.0
        P[1, 1] = P[2, 2] = PLACEMENT_STD_M**2


class Spacing:
    """The spacing a method constrains to: as given, or as learnt so far.

    Attributes
    ----------
    learner : what learns it, None where it was given
    numbers : (L_SIZE,) the array of the learner; the spacing alone where it was given
    """

    def __init__(self, given_m: float) -> None:
        """Use ``given_m``, or learn when it is zero."""
        self.learner = SpacingLearner() if given_m == 0.0 else None
        self.numbers = np.zeros(lay.L_SIZE) if self.learner is None else self.learner.numbers
        if given_m != 0.0:
            self.numbers[lay.L_STATE] = given_m

    def use(self, engine: Engine) -> None:
        """Learn with another form of the kernel."""
        if self.learner is not None:
            self.learner.use(engine)

    @property
    def std_m(self) -> float:
        """Standard deviation of what has been learnt; zero when it was given."""
        return self.learner.std_m if self.learner else 0.0

    @property
    def value_m(self) -> float:
        """The spacing to constrain to now."""
        return self.numbers.item(lay.L_STATE)

    def note(self, outcome: Outcome) -> None:
        """Learn from a constraint that was applied, or found not to be needed."""
        passing = outcome.payload
        if self.learner is not None and isinstance(passing, Passing):
            self.learner.add(passing.before, passing.after, passing.heading)

    def moved(self) -> None:
        """Take note that the tracks were turned or moved."""
        if self.learner is not None:
            self.learner.restart()
