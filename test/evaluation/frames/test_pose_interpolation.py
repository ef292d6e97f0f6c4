"""Poses between stamps and turns between attitudes: as SciPy has them, which is not loaded."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation, Slerp

from dualfoot_ros.core import PoseSeries
from dualfoot_ros.evaluation.frames.association import truth_at
from dualfoot_ros.evaluation.frames.pose_interpolation import rotation_vectors, turns_between

KNOWN = np.array([0, 10, 15, 40, 41, 90]) * 10**6
WANTED = np.array([0, 3, 10, 12, 27, 40, 41, 60, 90]) * 10**6


@pytest.fixture(scope="module")
def poses():
    """Return poses at uneven stamps, with turns from none to nearly half a circle."""
    rng = np.random.default_rng(3)
    turns = rng.normal(size=(6, 3)) * np.array([0.0, 1e-9, 1e-3, 0.3, 2.0, 1.0])[:, None]
    quaternions = Rotation.from_rotvec(np.cumsum(turns, axis=0)).as_quat()
    signs = np.array([1.0, 1.0, -1.0, 1.0, -1.0, -1.0])[:, None]
    return PoseSeries(KNOWN, rng.normal(size=(6, 3)), quaternions * signs, rng.normal(size=(6, 3)))


def test_positions_and_velocities_are_on_the_cubic_of_both(poses):
    spline = CubicHermiteSpline(KNOWN * 1e-9, poses.position, poses.velocity)
    found = truth_at(WANTED, poses)
    np.testing.assert_allclose(found.position, spline(WANTED * 1e-9), atol=1e-13)
    np.testing.assert_allclose(found.velocity, spline(WANTED * 1e-9, 1), rtol=1e-12, atol=1e-11)
    at_once = np.isin(WANTED, KNOWN)
    np.testing.assert_allclose(
        found.position[at_once], poses.position[np.isin(KNOWN, WANTED)], atol=1e-15
    )


def test_attitudes_are_on_the_great_circles(poses):
    slerp = Slerp(KNOWN * 1e-9, Rotation.from_quat(poses.quaternion))
    found = truth_at(WANTED, poses).quaternion
    assert np.linalg.norm(found, axis=1) == pytest.approx(1.0, abs=1e-15)
    between = Rotation.from_quat(found) * slerp(WANTED * 1e-9).inv()
    assert between.magnitude().max() < 1e-14


@pytest.mark.parametrize("angle", [0.0, 1e-200, 1e-9, 1e-3, 1.0, 3.1, np.pi])
@pytest.mark.parametrize("length", [1.0, -2.0])
def test_a_rotation_vector_has_the_axis_and_the_angle_of_its_quaternion(angle, length):
    sine, cosine = math.sin(angle / 2), math.cos(angle / 2)
    quaternion = length * np.array([[0.6 * sine, 0.0, 0.8 * sine, cosine]])
    expected = [[0.6 * angle, 0.0, 0.8 * angle]]
    np.testing.assert_allclose(np.abs(rotation_vectors(quaternion)), expected, rtol=1e-12)


def test_the_turn_between_attitudes_is_about_fixed_axes():
    rng = np.random.default_rng(5)
    before, after = Rotation.random(20, rng=rng), Rotation.random(20, rng=rng)
    found = turns_between(before.as_quat(), after.as_quat())
    np.testing.assert_allclose(found, (after * before.inv()).as_rotvec(), atol=1e-13)
    from_one = turns_between(before.as_quat()[:1], after.as_quat())
    np.testing.assert_allclose(from_one, (after * before[0].inv()).as_rotvec(), atol=1e-13)
