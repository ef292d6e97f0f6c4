"""One passing of the filter that learns the spacing: both forms, and its matrices."""

import math

import numpy as np
import pytest

from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.at_stances.spacing_learner import ACROSS, ALONG, WANDER

from .forms import both_forms


def learnt(seed: int, *, begun: bool = True) -> np.ndarray:
    """Return the array of a learner under way."""
    rng, x = np.random.default_rng(seed), np.zeros(lay.L_SIZE)
    x[lay.L_STATE : lay.L_COVARIANCE] = [0.15, *rng.normal(size=2), 0.01]
    root = 0.1 * rng.normal(size=(4, 6))
    x[lay.L_COVARIANCE : lay.L_BEGUN] = (root @ root.T).ravel()
    x[lay.L_BEGUN :] = [float(begun), *rng.normal(size=4)]
    return x


def passing(seed: int) -> tuple[float, ...]:
    """Return separations before and after, and the direction of the walk."""
    rng, heading = np.random.default_rng(seed), 0.3 + seed
    return (*rng.normal(size=4).tolist(), math.cos(heading), math.sin(heading))


@pytest.mark.parametrize("begun", (False, True))
def test_both_forms_have_the_same_bits(begun):
    _, (x,) = both_forms("learn_spacing", learnt(1, begun=begun), given=passing(2))
    assert x[lay.L_BEGUN] == 1.0


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("begun", (False, True))
def test_it_is_the_kalman_filter_of_its_matrices(seed, begun):
    x, given = learnt(seed, begun=begun), passing(seed)
    state, P = x[:4].copy(), x[lay.L_COVARIANCE : lay.L_BEGUN].reshape(4, 4).copy()
    *separations, c, s = given
    before, after = np.array(separations[:2]), np.array(separations[2:])
    free = before.copy()
    if begun:
        free += x[lay.L_FREE : lay.L_FREE + 2] - x[lay.L_AFTER : lay.L_AFTER + 2]
    step = np.eye(4)
    step[1:3, 3] = c, s
    state, P = step @ state, step @ P @ step.T + np.diag([0.0, WANDER, WANDER, 0.0])
    for row, noise in (([1.0, -s, c, 0.0], ACROSS), ([0.0, c, s, 0.0], ALONG)):
        H = np.array([row])
        across = np.array([-s, c]) if row[0] else np.array([c, s])
        gain = P @ H.T / (H @ P @ H.T + noise)
        state = state + gain[:, 0] * (free @ across - H[0] @ state)
        P = (np.eye(4) - gain @ H) @ P
    interpreted().learn_spacing(x, *given)
    found = x[lay.L_COVARIANCE : lay.L_BEGUN].reshape(4, 4)
    assert np.allclose(x[:4], state, atol=1e-12)
    assert np.allclose(found, P, atol=1e-13)
    assert np.array_equal(found, found.T)
    assert np.allclose(x[lay.L_FREE : lay.L_FREE + 2], free, atol=1e-14)
    assert x[lay.L_AFTER : lay.L_AFTER + 2].tolist() == after.tolist()
