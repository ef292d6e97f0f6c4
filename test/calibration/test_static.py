"""Standstills are found, told apart and checked."""

import re

import numpy as np
import pytest

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.static import StandstillConfig, attitudes, segments_of, still_spans

from .rest import RATE_HZ, joined, moving, resting, segments


def test_each_attitude_held_between_movements_is_a_standstill():
    series = joined(
        resting([0, 0, 1]), moving(), resting([1, 0, 0], 4.0), moving(), resting([0, 1, 0])
    )
    found = segments_of(series, "tumbled")
    assert [s.name for s in found] == ["tumbled (1)", "tumbled (2)", "tumbled (3)"]
    ups = np.array([s.direction for s in found])
    assert np.allclose(ups, [[0, 0, 1], [1, 0, 0], [0, 1, 0]], atol=1e-3)


def test_an_attitude_changed_between_two_windows_ends_a_standstill():
    found = segments_of(joined(resting([0, 0, 1]), resting([0, 0.05, 1])), "tipped")
    assert len(found) == 2


def test_a_gap_ends_a_standstill():
    series = resting([0, 0, 1], 10.0)
    cut = series[np.r_[0:300, 400:600]]
    assert all(np.diff(cut.stamp_ns[s]).max() < 2e9 / RATE_HZ for s in still_spans(cut))


def test_the_same_attitude_twice_is_one_attitude():
    numbers = attitudes(segments([[0, 0, 1], [1, 0, 0], [0, 0.1, 1], [0, 0, -1]]))
    assert numbers == [0, 1, 0, 2]


def test_a_moving_sensor_has_no_standstill_and_the_sentence_says_how_far_it_is_from_one():
    with pytest.raises(CalibrationError, match=r"no standstill of 2 s in 3\.0 s.*scatters by"):
        segments_of(moving(), "hand")


def test_too_few_samples_are_no_standstill():
    for count in (0, 1, 3):
        with pytest.raises(CalibrationError, match="no standstill"):
            segments_of(resting([0, 0, 1])[:count], "short")


@pytest.mark.parametrize(("scale", "shown"), [(1 / 9.80665, "1 m/s^2"), (0.02, "m/s^2")])
def test_wrong_units_are_refused_with_the_value(scale, shown):
    series = resting([0, 0, 1], noise=0.001)
    wrong = type(series)(series.stamp_ns, series.specific_force * scale, series.angular_rate)
    with pytest.raises(CalibrationError, match=re.escape(shown) + ".*check the unit"):
        segments_of(wrong, "in g")


def test_samples_that_are_not_finite_are_left_out():
    series = resting([0, 0, 1])
    series.specific_force[10] = np.nan
    (segment,) = segments_of(series, "one", StandstillConfig(duration=1.0))
    assert np.isfinite(segment.mean).all()
