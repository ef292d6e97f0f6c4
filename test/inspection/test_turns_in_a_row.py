"""Steps made two at a time are the steps one by one; quaternions are those of scipy."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.inspection.turns_in_a_row import (
    one_after_another,
    products,
    quaternions_of,
    turned,
)

RNG = np.random.default_rng(4)


def vectors(*shape):
    return RNG.standard_normal((3, *shape))


def as_scipy(quaternions):
    return Rotation.from_quat(quaternions.reshape(4, -1).T)


def test_rotation_vectors_products_and_turned_vectors_are_those_of_scipy():
    turns, other, moved = vectors(7), vectors(7), vectors(7)
    turns[:, 0] = 0.0
    one, two = quaternions_of(turns), quaternions_of(other)
    scipys = Rotation.from_rotvec(turns.T), Rotation.from_rotvec(other.T)
    assert (as_scipy(one) * scipys[0].inv()).magnitude().max() < 1e-12
    assert (as_scipy(products(one, two)) * (scipys[0] * scipys[1]).inv()).magnitude().max() < 1e-12
    assert np.abs(turned(one, moved) - scipys[0].apply(moved.T).T).max() < 1e-12


@pytest.mark.parametrize("count", [1, 2, 3, 8, 13])
def test_all_steps_at_once_are_the_steps_one_by_one(count):
    steps, pushes = quaternions_of(vectors(count, 2, 5)), vectors(count, 2, 5)
    attitude, velocity = one_after_another(steps, pushes)
    one, sum_ = quaternions_of(np.zeros((3, 2, 5))), np.zeros((3, 2, 5))
    for k in range(count):
        sum_ = sum_ + turned(one, pushes[:, k])
        one = products(one, steps[:, k])
    assert np.abs(attitude - one).max() < 1e-13
    assert np.abs(velocity - sum_).max() < 1e-12
