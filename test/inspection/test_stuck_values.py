"""Sensors that repeat themselves are found, sensors that merely rest are not."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from recording.samples import moving

from dualfoot_ros.inspection import FindingKind, Severity, findings_of, require_usable
from dualfoot_ros.inspection.stuck_values import find_stuck
from dualfoot_ros.recording import Recording, RecordingError
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import WalkConfig, grade, simulate


def held(series, first, last):
    """Hold all six values from sample ``first`` to ``last``."""
    series.specific_force[first : last + 1] = series.specific_force[first]
    series.angular_rate[first : last + 1] = series.angular_rate[first]
    return series


def told(left):
    recording = Recording(left, moving(2))
    return [f for f in findings_of(recording) if f.kind is FindingKind.STUCK]


@settings(max_examples=20, deadline=None)
@given(first=st.integers(520, 1000), length=st.integers(30, 120))
def test_a_sensor_that_holds_its_values_while_it_moves_is_found_with_time_and_length(
    first, length
):
    series = moving(1)
    series.angular_rate[first] = [1.0, 2.0, 3.0]
    (stuck,) = find_stuck(held(series, first, first + length))
    assert (stuck.what, stuck.times) == ("sensor", 1)
    assert stuck.first_s == pytest.approx(first / 100.0)
    assert stuck.longest_s == pytest.approx(length / 100.0)


def test_at_rest_it_takes_some_seconds_to_be_sure():
    assert find_stuck(held(moving(1), 100, 300)) == ()
    assert find_stuck(held(moving(1), 100, 450))[0].longest_s == pytest.approx(3.5)


def test_one_axis_that_stays_while_the_others_move_is_named():
    series = moving(1)
    series.angular_rate[:, 0] = 0.02
    series.specific_force[600:900, 2] = 9.8
    found = find_stuck(series)
    assert {s.what for s in found} == {"angular rate x", "specific force z"}
    assert max(s.share for s in found) == 1.0


def test_a_short_hold_is_a_warning_and_a_long_one_makes_the_recording_useless():
    series = moving(1)
    series.angular_rate[700] = 3.0
    (short,) = told(held(series, 700, 740))
    assert short.severity is Severity.WARNING
    assert "left foot: the sensor repeats itself once, first 7.0 s after" in short.sentence
    (long,) = told(held(series, 700, 1100))
    assert long.severity is Severity.ERROR
    with pytest.raises(RecordingError, match="repeats itself"):
        require_usable(Recording(series, moving(2)))


@pytest.mark.parametrize("name", ["ideal", "good", "consumer"])
def test_no_simulated_sensor_is_called_stuck(name):
    made = simulate(WalkConfig(route="L"), grade(name), seed=1)
    assert find_stuck(made.left) == find_stuck(made.right) == ()


def test_no_real_sensor_is_called_stuck(dual_feet):
    for path in sorted(dual_feet.glob("*/*.mat")):
        recording = import_recording(ImportOptions(sources=(path,)))
        assert find_stuck(recording.left) == find_stuck(recording.right) == ()


def test_a_few_samples_say_nothing():
    assert find_stuck(moving(1)[:5]) == ()
    assert find_stuck(held(moving(1), 0, 15)[:16]) == ()
