"""Recordings through time alignment and tracker."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import EventKind, TrackerConfig
from dualfoot_ros.core.samples.series import ImuSeries, PressureSeries
from dualfoot_ros.evaluation import EvaluationError, evaluate, pair_samples, track, truth_of
from dualfoot_ros.recording.recording import Recording
from dualfoot_ros.simulation import (
    BarometerConfig,
    MagnetometerConfig,
    WalkConfig,
    grade,
    simulate,
)


@pytest.fixture(scope="module")
def walked() -> Recording:
    """Return a simulated straight walk with truth."""
    made = simulate(WalkConfig(route="straight"), seed=2)
    return Recording(made.left, made.right, made.left_truth, made.right_truth)


def part(recording: Recording, left: slice, right: slice) -> Recording:
    """Return the recording with only some samples of each foot."""
    return replace(recording, left=recording.left[left], right=recording.right[right])


@pytest.mark.parametrize("method", ["zupt", "idc"])
def test_a_walk_with_ideal_sensors_is_tracked_within_five_percent_by_the_defaults(method):
    made = simulate(WalkConfig(route="straight"), grade("ideal"), seed=2)
    recording = Recording(made.left, made.right, made.left_truth, made.right_truth)
    found = track(recording, TrackerConfig.from_mapping({"method": method}))
    report = evaluate(found, truth=truth_of(recording)).truth_report
    assert max(report.left.end_percent, report.right.end_percent) < 5.0
    assert report.left_strides.length_ratio == pytest.approx(1.0, abs=0.02)


def test_the_samples_that_were_left_out_are_counted_and_said(walked):
    rate = walked.left.angular_rate.copy()
    rate[3000:3004] = np.nan
    broken = replace(walked, left=replace(walked.left, angular_rate=rate))
    found = track(broken, TrackerConfig.from_mapping({"method": "zupt"}))
    assert found.counters["sync.left_not_finite"] == 4
    assert any("4 samples of the left foot" in note for note in evaluate(found).notes)


def test_of_a_foot_without_samples_every_pair_has_the_other_one_only(walked):
    empty = ImuSeries(np.empty(0), np.empty((0, 3)), np.empty((0, 3)))
    for alone in (replace(walked, right=None), replace(walked, right=empty)):
        samples = pair_samples(alone)
        assert np.array_equal(samples.left.specific_force, walked.left.specific_force)
        assert np.isnan(samples.right.angular_rate).all()
        assert samples.counters["right_missing"] == len(walked.left)
    with pytest.raises(EvaluationError, match="no samples of either foot"):
        pair_samples(replace(walked, left=None, right=empty))


def test_feet_that_were_not_recorded_at_the_same_time_are_refused(walked):
    with pytest.raises(EvaluationError, match="share no time"):
        track(part(walked, slice(0, 500), slice(1000, None)))


def test_a_walk_that_only_ends_in_a_standstill_starts_from_its_first_stances(walked):
    late = slice(1200, None)
    found = track(part(walked, late, late))
    (aligned,) = found.of_kind(EventKind.ALIGNED)
    assert aligned.detail["start"] == "first_stance"
    assert found.left.distance_m > 5.0


def test_truth_of_one_foot_is_no_truth(walked):
    assert truth_of(replace(walked, left_truth=None)) is None


@pytest.fixture(scope="module")
def climbed() -> Recording:
    """Return a simulated walk on stairs with truth and a barometer on each foot."""
    made = simulate(WalkConfig(route="stairs"), seed=0, barometer=BarometerConfig())
    truth = made.left_truth, made.right_truth
    return Recording(made.left, made.right, *truth, pressure=made.pressure)


def height_rmse(recording: Recording, **settings) -> tuple[float, list[str]]:
    """Return the height error of the left foot, m, and the notes."""
    given = {"method": "step_length", **settings}
    found = track(recording, TrackerConfig.from_mapping(given))
    report = evaluate(found, truth=truth_of(recording))
    return report.truth_report.left.rmse_vertical_m, list(report.notes)


def test_the_pressure_of_a_recording_betters_the_height_and_is_offered_where_it_is_not_used(
    climbed,
):
    drifting = {"zupt.lever_back": 0.0}  # with the pivot below the sensor walks climb
    without, notes = height_rmse(climbed, **drifting)
    assert notes == [
        f"{sum(map(len, climbed.pressure.values()))} samples of air pressure not used; with "
        "aids.barometer=true they give the height"
    ]
    better, notes = height_rmse(climbed, **drifting, **{"aids.barometer": True})
    assert notes == []
    assert better < 0.75 * without


def test_a_barometer_that_is_on_without_pressure_is_told_what_to_record(climbed):
    bare = replace(climbed, pressure={})
    without, _ = height_rmse(bare)
    same, notes = height_rmse(bare, **{"aids.barometer": True})
    assert same == without
    assert len(notes) == 1
    assert "aids.barometer is on but there is no air pressure" in notes[0]
    assert "sensor_msgs/FluidPressure on /left/pressure" in notes[0]


def test_pressure_on_another_clock_or_in_other_units_is_noted(climbed):
    left = climbed.pressure["left"]
    elsewhere = {"left": PressureSeries(left.stamp_ns - 10**15, left.pressure)}
    _, notes = height_rmse(replace(climbed, pressure=elsewhere), **{"aids.barometer": True})
    assert any("stances had too few samples of air pressure; check that it" in n for n in notes)
    hecto = {"left": PressureSeries(left.stamp_ns, left.pressure / 100.0)}
    _, notes = height_rmse(replace(climbed, pressure=hecto), **{"aids.barometer": True})
    assert f"{len(left)} samples of air pressure left out: no air pressure in Pa" in notes


@pytest.fixture(scope="module")
def felt() -> Recording:
    """Return a simulated lap with truth and a magnetometer on each foot."""
    walk = WalkConfig(route="track", rate=60.0, standing=5.0)
    made = simulate(walk, seed=3, magnetometer=MagnetometerConfig())
    return Recording(made.left, made.right, made.left_truth, made.right_truth)


def closed(recording: Recording, on: bool) -> tuple[float, list[str]]:
    """Return the RMSE of the left foot, m, and the notes."""
    found = track(recording, TrackerConfig.from_mapping({"aids.magnetic_heading": on}))
    report = evaluate(found, truth=truth_of(recording))
    return report.truth_report.left.rmse_horizontal_m, list(report.notes)


def test_the_field_of_a_recording_betters_the_track_and_is_offered_where_it_is_not_used(felt):
    without, notes = closed(felt, False)
    assert notes == [
        f"{len(felt.left) + len(felt.right)} samples of the magnetic field not used; outdoors, "
        "with aids.magnetic_heading=true, they hold the heading"
    ]
    better, notes = closed(felt, True)
    assert better < 0.5 * without
    assert [note.partition(":")[0] for note in notes] == ["magnetic heading"]


def test_a_magnetic_heading_without_a_field_is_refused_with_what_to_record(walked):
    with pytest.raises(EvaluationError, match="MagneticField on /left/imu/mag and /right/imu/mag"):
        closed(walked, True)


def test_a_field_in_gauss_or_of_one_foot_is_noted(felt):
    gauss = replace(felt.left, magnetic_field=1e4 * felt.left.magnetic_field)
    _, notes = closed(replace(felt, left=gauss), True)
    assert any("stances without a magnetic field; check that each foot" in n for n in notes)
    said = "samples of the magnetic field left out: not finite, or no field of the earth in T"
    assert f"{len(gauss)} {said}" in notes
