"""The filter of the spacing in plain numbers against the same one in matrices."""

import math

import numpy as np
import pytest

from dualfoot_ros.core import StancePassing
from dualfoot_ros.core.results.passings import StanceEpochs
from dualfoot_ros.inspection.spacing_filter import (
    A_X,
    A_Y,
    ACROSS_STD_M,
    ALONG_STD_M,
    DELTA,
    EPSILON,
    HEADING_PER_TURN,
    HEADING_WANDER,
    JUMP_NIS,
    PLACE_PER_TURN,
    PLACEMENT_STD_M,
    SCALE_WANDER,
    STATES,
    WANDER_STD_M,
    SpacingFilter,
)

HERE = StanceEpochs(0, 1)


def some_passings(count: int = 60) -> list[StancePassing]:
    """Return passings round a bend, with a jump of the tracks in the middle."""
    rng = np.random.default_rng(5)
    made, middle = [], np.zeros(2)
    for k in range(count):
        heading = 0.1 * k + 0.05 * rng.normal()
        forward = np.array([math.cos(heading), math.sin(heading)])
        middle = middle + 0.7 * forward
        apart = 0.2 * np.array([-forward[1], forward[0]]) + 0.02 * rng.normal(size=2)
        apart += [3.0, 1.0] if k >= count // 2 else [0.0, 0.0]
        made.append(StancePassing(k, k % 2, HERE, (0, 1), apart, forward, middle))
    return made


class InMatrices:
    """The filter of the module's docstring as it is written."""

    def __init__(self) -> None:
        plain = SpacingFilter()
        self.x, self.p = np.array(plain.x), np.array(plain.p)
        self.way = self.jumps = 0.0
        self.last = None

    def add(self, passing: StancePassing) -> None:
        if self.last is not None:
            self.advance(passing)
        self.last = passing
        forward, sign = passing.forward, 1.0 if passing.standing == 1 else -1.0
        left = np.array([-forward[1], forward[0]])
        h = np.column_stack([left, np.eye(2), np.zeros((2, 2)), sign * forward])
        noise = ACROSS_STD_M**2 * np.outer(left, left) + ALONG_STD_M**2 * np.outer(
            forward, forward
        )
        y = passing.separation - h @ self.x
        if y @ np.linalg.solve(h @ self.p @ h.T + noise, y) > JUMP_NIS:
            self.jumps += 1
            self.p[1:3, :] = self.p[:, 1:3] = 0.0
            self.p[1:3, 1:3] = (4.0 * PLACEMENT_STD_M**2 + y @ y) * np.eye(2)
        gain = self.p @ h.T @ np.linalg.inv(h @ self.p @ h.T + noise)
        self.x = self.x + gain @ y
        self.p = (np.eye(STATES) - gain @ h) @ self.p

    def advance(self, passing: StancePassing) -> None:
        way = passing.middle - self.last.middle
        self.way += np.linalg.norm(way)
        (a, b), (c, d) = self.last.forward, passing.forward
        turned = abs(math.atan2(a * d - b * c, a * c + b * d))
        f = np.eye(STATES)
        f[1:3, DELTA], f[1:3, EPSILON] = [-way[1], way[0]], way
        self.x, self.p = f @ self.x, f @ self.p @ f.T
        for state in (A_X, A_Y):
            self.p[state, state] += WANDER_STD_M**2 + (PLACE_PER_TURN * self.way * turned) ** 2
        self.p[DELTA, DELTA] += HEADING_WANDER**2 + (HEADING_PER_TURN * turned) ** 2
        self.p[EPSILON, EPSILON] += SCALE_WANDER**2


def test_plain_numbers_give_what_the_matrices_give():
    """State and covariance agree after every passing, also after the tracks were placed anew."""
    plain, matrices = SpacingFilter(), InMatrices()
    for passing in some_passings():
        plain.add(passing)
        matrices.add(passing)
        assert plain.x == pytest.approx(matrices.x, rel=1e-9, abs=1e-12)
        assert np.array(plain.p) == pytest.approx(matrices.p, rel=1e-9, abs=1e-12)
    assert plain.jumps == matrices.jumps == 1


def test_a_copy_goes_on_by_itself():
    """What the copy learns is not known to the filter it was taken from."""
    first, *others = some_passings(10)
    filter_ = SpacingFilter()
    filter_.add(first)
    known = list(filter_.x), [list(row) for row in filter_.p]
    own = filter_.copy()
    for passing in others:
        own.add(passing)
    assert (filter_.x, filter_.p) == known and own.x != filter_.x
