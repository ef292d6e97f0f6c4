"""A distance as one entry of the kernel: both forms, and the stationarity of its cost."""

import numpy as np
import pytest

from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay

from ..states import random_workspace
from .forms import both_forms, numbers

SELECTOR = np.hstack([np.eye(3), np.zeros((3, 12)), -np.eye(3), np.zeros((3, 12))])
HERE = (0, 0.0, 0.0, 0.0)  # the separation is that of now


def separated(seed: int, distance: float):
    """Return a random state whose feet are ``distance`` m apart, and their separation (3,)."""
    space, r = random_workspace(seed), np.random.default_rng(seed).normal(size=3)
    r *= distance / np.linalg.norm(r)
    space.w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3] = space.w[lay.POS : lay.POS + 3] - r
    return space, r


def part(x: np.ndarray, at: int) -> np.ndarray:
    """Return the vector (3,) at ``at``."""
    return x[at : at + 3]


@pytest.mark.parametrize("std", (0.0, 0.1))
@pytest.mark.parametrize("solves", (0, 1))
@pytest.mark.parametrize("place", (HERE, (1, 0.5, -0.2, 0.1)))
def test_both_forms_have_the_same_bits(std, solves, place):
    space, _ = separated(1, 0.6)
    given = (0.15, std, solves, *place)
    exceeds, (w, x) = both_forms("constrain_distance", space.w, numbers(), given=given)
    assert exceeds == 1.0
    assert np.array_equal(w[: lay.STATE], space.w[: lay.STATE]) == (not solves)
    if place is not HERE:
        assert part(x, lay.X_BEFORE).tolist() == list(place[1:])


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("std", (0.05, 0.1))
def test_what_it_finds_and_where_it_goes(seed, std):
    """The slope of both costs, of eq. (14) and of the scatter of the distance, is zero there."""
    space, r = separated(seed, 0.6)
    P, x, c0 = SELECTOR @ space.covariance() @ SELECTOR.T, numbers(), 0.15
    assert interpreted().constrain_distance(space.w, x, c0, std, 1, *HERE)
    unit = r / 0.6
    assert x[lay.X_DISTANCE] == pytest.approx(0.6)
    assert x[lay.X_Y] == pytest.approx(0.6 - c0)
    assert x[lay.X_S] == pytest.approx(unit @ P @ unit + std**2)
    after = part(x, lay.X_AFTER)
    size = np.linalg.norm(after)
    pull, cost = (size - c0) / std**2 * after / size, np.linalg.solve(P, after - r)
    assert np.allclose(pull, -cost, rtol=1e-6, atol=1e-6 * np.abs(cost).max())


def test_feet_within_the_distance_are_left_alone():
    space, r = separated(2, 0.14)
    before, x = space.w.copy(), numbers()
    assert not interpreted().constrain_distance(space.w, x, 0.15, 0.1, 1, *HERE)
    assert np.array_equal(space.w, before)
    assert np.allclose(part(x, lay.X_BEFORE), r, atol=1e-15)
