"""Pieces of the filter of a walk: rotations, increments of each kind, columns of the matrix."""

from copy import deepcopy

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.calibration.walk.filter_pass import FilterPass, M, inverse
from dualfoot_ros.calibration.walk.filter_terms import (
    FilterNoise,
    increments,
    rate_columns,
    rotations,
    symmetric,
)
from dualfoot_ros.calibration.walk.matrix_filter import filter_walk
from dualfoot_ros.core import Increments

from .simulated import PIVOT, walks

RNG = np.random.default_rng(0)
AT = np.array([0.0] * 6 + list(PIVOT))


def test_rotation_vectors_become_their_rotations():
    vectors = np.vstack([np.zeros(3), 1e-9 * np.ones(3), RNG.standard_normal((20, 3))])
    assert np.allclose(rotations(vectors), Rotation.from_rotvec(vectors).as_matrix(), atol=1e-12)


def test_columns_times_elements_are_the_matrix_times_the_rate():
    rate, elements = RNG.standard_normal((5, 3)), RNG.standard_normal(6)
    assert np.allclose(rate_columns(rate) @ elements, rate @ symmetric(elements))


@pytest.mark.parametrize("kind", list(Increments))
def test_constant_rate_and_force_give_the_same_increments_whatever_the_samples_are(kind):
    rate, force = np.tile([0.0, 3.0, 0.0], (50, 1)), np.tile([1.0, 0.0, 9.0], (50, 1))
    turn, push = increments(force, rate, np.full(50, 1e-3), kind)
    half = Rotation.from_rotvec([0.0, 1.5e-3, 0.0]).as_matrix()
    assert np.allclose(turn[1:], [0.0, 3e-3, 0.0], atol=1e-12)
    assert np.allclose(push[2:], half @ [1e-3, 0.0, 9e-3], atol=1e-8)


def test_only_samples_that_are_not_compensated_are_given_the_coning_term():
    t = np.arange(200)[:, None] * 0.01
    rate = np.hstack([np.cos(20 * t), np.sin(20 * t), np.zeros_like(t)])
    args = np.ones((200, 3)), rate, np.full(200, 0.01)
    compensated, averaged = (
        increments(*args, kind)[0][:, 2].sum()
        for kind in (Increments.COMPENSATED, Increments.AVERAGED)
    )
    assert compensated == 0.0
    assert averaged > 0.0


def test_a_swing_in_one_step_is_that_of_its_samples():
    walk = walks(0)["left"]
    steps = [[*range(first, end)] for first, end in FilterPass(walk, AT, FilterNoise())._steps()]
    at = np.argmax([len(step) for step in steps])
    begun = FilterPass(walk, AT, FilterNoise())
    for step in steps[:at]:
        for k in step:
            begun._propagate(k)
        begun._stand(step[-1])
    begun._x[M] = 0.01 * RNG.standard_normal(6)
    one, other = begun, deepcopy(begun)
    one._swing(slice(steps[at][0], steps[at][-1] + 1))
    for k in steps[at]:
        other._propagate(k)
    assert len(steps[at]) > 20
    assert np.allclose(one._r, other._r, rtol=0, atol=1e-13)
    assert np.allclose(one._v, other._v, rtol=0, atol=1e-13)
    std = np.sqrt(np.diag(other._p))
    assert np.allclose(one._p / std / std[:, None], other._p / std / std[:, None], atol=1e-12)


def test_the_inverse_by_minors_is_the_inverse():
    for matrix in RNG.standard_normal((20, 3, 3)):
        square = matrix @ matrix.T + 0.1 * np.eye(3)
        assert np.allclose(inverse(square) @ square, np.eye(3), atol=1e-11)


def test_a_walk_tells_nothing_negative_and_tells_most_about_pitch():
    told = filter_walk(walks(0)["left"], AT, FilterNoise()).matrix
    assert np.linalg.eigvalsh(told).min() > -1e-6 * np.linalg.eigvalsh(told).max()
    assert np.argmax(np.diag(told)[:3]) == 1
