"""Attitudes and positions between poses: as scipy has them."""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation, Slerp

from dualfoot_ros.core import EvaluationError, PoseSeries
from dualfoot_ros.evaluation.frames.association import truth_at
from dualfoot_ros.evaluation.frames.between_poses import GreatCircles, HermiteSpline, turns_between

KNOWN = np.cumsum(np.random.default_rng(1).uniform(0.1, 2.0, 40))
WANTED = np.sort([*np.random.default_rng(2).uniform(KNOWN[0], KNOWN[-1], 500), *KNOWN])


@pytest.mark.parametrize("size", [3.0, 1e-3, 1e-5])
def test_attitudes_are_those_of_scipy(size):
    """For turns of any size, at the poses themselves too, and for quaternions of any length."""
    turns = Rotation.from_rotvec(np.random.default_rng(3).normal(0.0, size, (len(KNOWN), 3)))
    quaternions = -3.0 * turns.as_quat()
    expected = Slerp(KNOWN, Rotation.from_quat(quaternions))(WANTED).as_quat()
    found = GreatCircles(KNOWN, quaternions).at(WANTED)
    assert found == pytest.approx(expected, rel=0.0, abs=5e-16)  # sines of numpy and of libm


def test_a_pose_that_does_not_turn_keeps_its_attitude():
    quaternions = np.tile([0.0, 0.6, 0.0, 0.8], (len(KNOWN), 1))
    assert GreatCircles(KNOWN, quaternions).at(WANTED) == pytest.approx(
        np.tile(quaternions[0], (len(WANTED), 1)), abs=1e-15
    )


def test_turns_between_attitudes_are_those_of_scipy():
    """In the axes of the navigation frame, of half a turn at most, and for none at all."""
    before, after = np.random.default_rng(5).normal(size=(2, 50, 4))
    before[0] = after[0]
    expected = (Rotation.from_quat(after) * Rotation.from_quat(before).inv()).as_rotvec()
    assert turns_between(before, after) == pytest.approx(expected, rel=1e-14, abs=1e-15)


def test_positions_and_velocities_are_those_of_scipy_to_the_bit():
    position, velocity = np.random.default_rng(4).normal(size=(2, len(KNOWN), 3))
    expected = CubicHermiteSpline(KNOWN, position, velocity)
    found = HermiteSpline(KNOWN, position, velocity).at(WANTED)
    assert np.array_equal(found[0], expected(WANTED))
    assert np.array_equal(found[1], expected(WANTED, 1))


@pytest.mark.parametrize(
    ("stamps", "w", "words"),
    [([0, 10, 10], 1.0, "do not increase"), ([0, 10, 20], 0.0, "length 0")],
)
def test_a_truth_that_cannot_be_interpolated_is_refused(stamps, w, words):
    quaternion = np.array([[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, w]])
    truth = PoseSeries(np.array(stamps), np.zeros((3, 3)), quaternion)
    with pytest.raises(EvaluationError, match=words):
        truth_at(np.array([5]), truth)
