"""Errors against truth in cases whose result is known in closed form."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from dualfoot_ros.evaluation.frames.association import Footfalls
from dualfoot_ros.evaluation.frames.yaw_transform import YawTransform
from dualfoot_ros.evaluation.metrics.accuracy import (
    heading_error,
    position_errors,
    statistics,
    stride_errors,
)
from dualfoot_ros.evaluation.metrics.heading_split import heading_errors

from ..walks import foot, straight, yaw_quaternion


def test_a_shift_alone_is_the_same_error_everywhere():
    errors = position_errors(np.tile([0.3, 0.4, 1.2], (50, 1)), np.linspace(0, 500, 50))
    assert errors.rmse_m == pytest.approx(1.3)
    assert errors.rmse_horizontal_m == pytest.approx(0.5)
    assert errors.rmse_vertical_m == pytest.approx(1.2)
    assert errors.max_m == errors.end_m == pytest.approx(1.3)
    assert errors.end_percent == pytest.approx(100 * 1.3 / 500)
    assert set(errors.at_distance_m) == {"200", "400"}


def test_a_straight_track_turned_by_one_degree_has_the_chord_as_error():
    way = np.linspace(0, 100, 10_001)
    truth = np.column_stack([way, np.zeros_like(way), np.zeros_like(way)])
    turned = YawTransform(np.radians(1.0), np.zeros(3)).position(truth)
    errors = position_errors(turned - truth, way, marks_m=50.0)
    chord = 2 * np.sin(np.radians(0.5))
    assert errors.end_m == pytest.approx(100 * chord)
    assert errors.rmse_m == pytest.approx(100 * chord / np.sqrt(3), rel=1e-3)
    assert errors.at_distance_m["50"] == pytest.approx(50 * chord, rel=1e-6)


def test_the_end_error_of_a_walk_without_distance_has_no_percentage():
    assert position_errors(np.ones((5, 3)), np.zeros(5)).end_percent is None


def strides_of(track, truth):
    turn = heading_error(track.quaternion, truth.quaternion)
    return stride_errors(track, truth, Footfalls.of(track), turn)


def test_a_scale_error_shows_in_the_length_of_the_strides_and_not_in_their_direction():
    _, truth, stance = straight()
    track = foot(truth, stance[1])
    track.position[:] *= 0.98
    found = strides_of(track, truth)
    assert found.length_ratio == pytest.approx(0.98)
    assert found.rmse_m == pytest.approx(0.02 * 1.2)
    assert found.turn_rmse_deg == pytest.approx(0.0, abs=1e-9)
    assert found.strides == 20


def test_a_constant_heading_error_is_no_error_of_the_strides():
    truth, _, stance = straight()
    track = YawTransform(0.5, np.array([3.0, 1.0, 0.0])).foot(foot(truth, stance[0]))
    assert strides_of(track, truth).rmse_m == pytest.approx(0, abs=1e-9)


@given(st.floats(-3, 3), st.floats(-1.4, 1.4), st.floats(-3, 3), st.floats(-3, 3))
def test_the_heading_error_is_the_turn_whatever_the_attitude(yaw, pitch, roll, turn):
    attitude = Rotation.from_euler("zyx", [yaw, pitch, roll])
    estimate = Rotation.from_euler("z", turn) * attitude
    found = heading_error(estimate.as_quat()[None], attitude.as_quat()[None])[0]
    assert np.exp(1j * found) == pytest.approx(np.exp(1j * turn), abs=1e-9)


def test_a_heading_error_of_more_than_half_a_turn_keeps_counting():
    turns = np.linspace(0, 4 * np.pi, 400)
    estimate = yaw_quaternion(turns)
    truth = np.tile([0.0, 0.0, 0.0, 1.0], (400, 1))
    assert heading_error(estimate, truth)[-1] == pytest.approx(4 * np.pi)


@given(st.floats(-1, 1), st.floats(-1, 1))
def test_common_and_difference_headings_put_together_give_the_feet_again(common, difference):
    left = np.linspace(0, common + difference / 2, 20)
    right = np.linspace(0, common - difference / 2, 20)
    found = heading_errors(left, right)
    assert found.common_end_deg == pytest.approx(np.degrees(common))
    assert found.difference_end_deg == pytest.approx(np.degrees(difference))
    assert found.left_end_deg - found.right_end_deg == pytest.approx(found.difference_end_deg)


def test_feet_whose_headings_are_a_full_turn_apart_do_not_differ():
    found = heading_errors(np.full(5, np.pi + 0.01), np.full(5, -np.pi - 0.01))
    assert found.difference_rms_deg == pytest.approx(np.degrees(0.02))


@given(st.lists(st.floats(-100, 100), min_size=1, max_size=50))
def test_mean_and_spread_make_the_root_mean_square(values):
    found = statistics(values)
    assert found.rms**2 == pytest.approx(found.mean**2 + found.std**2, abs=1e-6)
    assert found.max >= found.rms - 1e-9
