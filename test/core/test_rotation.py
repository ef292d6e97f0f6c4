"""Rotations off the hot path against those of scipy."""

import numpy as np
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import quaternion_matrices, quaternion_matrix, rotate_each


def test_many_quaternions_rotate_as_in_scipy_to_the_bit():
    rng = np.random.default_rng(0)
    quaternions, vectors = rng.normal(size=(5000, 4)), rng.normal(size=(5000, 3))
    matrices, rotation = quaternion_matrices(quaternions), Rotation.from_quat(quaternions)
    assert np.array_equal(matrices, rotation.as_matrix())
    assert np.array_equal(rotate_each(vectors, matrices), rotation.apply(vectors))


def test_one_quaternion_gives_the_matrix_of_many():
    quaternion = np.array([0.1, -0.7, 0.5, 0.5])
    assert np.allclose(quaternion_matrix(quaternion), quaternion_matrices(quaternion[None])[0])
