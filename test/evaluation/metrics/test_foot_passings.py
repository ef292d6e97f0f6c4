"""Crossings and the distance between the feet."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.evaluation.frames.yaw_transform import YawTransform
from dualfoot_ros.evaluation.metrics.foot_passings import feet_report, passings

from ..walks import SPACING, along, foot, rectangle, straight


def test_feet_side_by_side_never_cross_and_pass_at_their_spacing():
    left, right, stance = straight(strides=10)
    found = passings(left.position, right.position, *stance)
    assert len(found.index) == 21
    assert found.crossed_percent == 0.0
    np.testing.assert_allclose(found.lateral_m, SPACING, atol=1e-12)
    np.testing.assert_allclose(found.distance_m[1:-1], SPACING, atol=1e-3)


def test_exchanged_feet_are_crossed_at_every_passing():
    left, right, stance = straight()
    found = passings(right.position, left.position, stance[1], stance[0])
    assert found.crossed_percent == 100.0


def test_feet_that_drift_over_one_another_half_way_are_crossed_half_of_the_time():
    left, right, stance = straight(strides=40)
    drift = np.zeros_like(left.position)
    drift[:, 1] = -2 * SPACING * left.position[:, 0] / left.position[-1, 0]
    found = passings(left.position + drift, right.position, *stance)
    assert found.crossed_percent == pytest.approx(50.0, abs=3.0)


def test_the_corners_of_a_rectangle_cross_nothing_either_way_round():
    for points in (rectangle(), rectangle() * [-1, 1]):
        left, right, stance = along(points)
        assert passings(left.position, right.position, *stance).crossed_percent == 0.0


@given(st.floats(-3, 3), st.tuples(*[st.floats(-500, 500)] * 3).map(np.array))
def test_the_sides_of_the_feet_do_not_depend_on_the_frame(yaw, shift):
    left, right, stance = along(rectangle())
    move = YawTransform(yaw, shift).position
    found = passings(move(left.position), move(right.position), *stance)
    same = passings(left.position, right.position, *stance)
    np.testing.assert_allclose(found.lateral_m, same.lateral_m, atol=1e-9)


def test_shuffling_on_the_spot_has_no_direction_and_no_passings():
    left, right, stance = straight(length=0.1)
    found = passings(left.position, right.position, *stance)
    assert len(found.index) == 0
    assert found.crossed_percent is None


def test_the_distance_error_is_estimate_minus_truth_at_the_constraints():
    left, right, stance = straight()
    feet = foot(left, stance[0]), foot(right, stance[1])
    feet[0].position[:, 1] += 0.05
    moments = passings(left.position, right.position, *stance).index[1:8]
    report = feet_report(*feet, moments, (left.position, right.position))
    assert report.moments == "constraint"
    assert report.distance_error_m.count == 7
    assert report.distance_error_m.mean == pytest.approx(0.05, abs=1e-3)
    assert report.distance_m.mean == pytest.approx(SPACING + 0.05, abs=1e-3)
    assert report.truth_crossed_percent == 0.0


def test_without_constraints_the_distance_is_taken_where_the_feet_pass():
    left, right, stance = straight(strides=5)
    empty = np.empty(0, dtype=np.int64)
    report = feet_report(foot(left, stance[0]), foot(right, stance[1]), empty)
    assert report.moments == "passing"
    assert report.distance_m.count == report.passings == 11
    assert report.distance_error_m is None
