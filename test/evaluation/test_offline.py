"""Recordings through time alignment and tracker."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.series import ImuSeries
from dualfoot_ros.evaluation import EvaluationError, evaluate, track, truth_of
from dualfoot_ros.recording.recording import Recording
from dualfoot_ros.simulation import WalkConfig, grade, simulate


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


def test_a_foot_without_samples_is_refused_by_name(walked):
    with pytest.raises(EvaluationError, match="only the right foot"):
        track(replace(walked, left=None))
    empty = ImuSeries(np.empty(0), np.empty((0, 3)), np.empty((0, 3)))
    with pytest.raises(EvaluationError, match="no samples of the right foot"):
        track(replace(walked, right=empty))


def test_feet_that_were_not_recorded_at_the_same_time_are_refused(walked):
    with pytest.raises(EvaluationError, match="share no time"):
        track(part(walked, slice(0, 500), slice(1000, None)))


def test_a_walk_that_only_ends_in_a_standstill_is_refused_rather_than_reported_empty(walked):
    late = slice(1200, None)
    with pytest.raises(EvaluationError, match="stand still with both feet before walking"):
        track(part(walked, late, late))


def test_truth_of_one_foot_is_no_truth(walked):
    assert truth_of(replace(walked, left_truth=None)) is None
