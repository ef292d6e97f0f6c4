"""Alignment: what it takes away, and what it must leave."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from dualfoot_ros.core.errors import EvaluationError
from dualfoot_ros.evaluation.frames.yaw_transform import (
    YawTransform,
    first_strides,
    umeyama4,
)

angles = st.floats(-3.1, 3.1)
shifts = st.tuples(*[st.floats(-1000, 1000)] * 3).map(np.array)


def points(seed: int, count: int = 30) -> np.ndarray:
    """Return random points of a walk of some tens of metres."""
    return np.cumsum(np.random.default_rng(seed).normal(size=(count, 3)), axis=0)


@given(angles, shifts, st.integers(0, 99))
def test_umeyama4_recovers_any_turn_and_shift(yaw, shift, seed):
    walk = points(seed)
    found = umeyama4(YawTransform(yaw, shift).position(walk), walk)
    back = found.position(YawTransform(yaw, shift).position(walk))
    np.testing.assert_allclose(back, walk, atol=1e-9)


@given(angles, shifts)
def test_first_strides_recovers_any_turn_and_shift(yaw, shift):
    walk = np.column_stack([np.arange(10) * 1.2, np.zeros(10), np.zeros(10)])
    found = first_strides([YawTransform(yaw, shift).position(walk)], [walk])
    assert np.cos(found.yaw + yaw) == pytest.approx(1.0, abs=1e-12)
    moved = found.position(YawTransform(yaw, shift).position(walk))
    np.testing.assert_allclose(moved, walk, atol=1e-9)


@given(st.integers(0, 99), st.floats(-0.01, 0.01), st.floats(-0.01, 0.01))
def test_no_other_turn_or_shift_fits_better_than_umeyama4(seed, more_yaw, more_shift):
    rng = np.random.default_rng(seed)
    walk = points(seed)
    estimate = walk + rng.normal(scale=0.3, size=walk.shape)
    best = umeyama4(estimate, walk)
    other = YawTransform(best.yaw + more_yaw, best.translation + more_shift)

    def cost(transform):
        return np.sum((transform.position(estimate) - walk) ** 2)

    assert cost(best) <= cost(other) + 1e-9


def test_umeyama4_does_not_take_away_a_tilt():
    walk = points(3)
    tilted = Rotation.from_euler("x", 10, degrees=True).apply(walk)
    error = umeyama4(tilted, walk).position(tilted) - walk
    assert np.abs(error[:, 2]).max() > 0.1


def test_first_strides_looks_only_at_the_first_metres():
    walk = np.column_stack([np.arange(21) * 1.2, np.zeros(21), np.zeros(21)])
    bent = walk.copy()
    bent[5:, 1] += 7.0
    assert first_strides([bent], [walk], 4.8).yaw == 0.0
    assert first_strides([bent], [walk], 6.0).yaw != 0.0


def test_first_strides_of_a_walk_that_comes_back_leaves_out_the_return():
    there = np.arange(6) * 1.2
    x = np.concatenate([there, there[::-1]])
    walk = np.column_stack([x, np.zeros(12), np.zeros(12)])
    bent = walk.copy()
    bent[6:, 1] = 3.0
    assert first_strides([bent], [walk]).yaw == 0.0


def test_first_strides_refuses_a_walk_without_a_stride():
    still = np.zeros((4, 3))
    with pytest.raises(EvaluationError, match="umeyama4"):
        first_strides([still], [still])


def test_first_strides_of_two_feet_joins_the_middle_of_their_starts():
    left = np.column_stack([np.arange(5), np.full(5, 0.1), np.zeros(5)])
    right = left - [0.0, 0.2, 0.0]
    aside = np.array([0.0, 0.5, 0.0])
    found = first_strides([left + aside, right + aside], [left, right])
    np.testing.assert_allclose(found.translation, [0.0, -0.5, 0.0], atol=1e-12)


@given(angles, shifts)
def test_the_transform_turns_attitudes_as_scipy_does(yaw, shift):
    attitude = Rotation.from_euler("zyx", [0.3, -0.7, 1.1])
    turned = YawTransform(yaw, shift).quaternion(attitude.as_quat()[None])[0]
    expected = Rotation.from_euler("z", yaw) * attitude
    assert (Rotation.from_quat(turned) * expected.inv()).magnitude() < 1e-9
