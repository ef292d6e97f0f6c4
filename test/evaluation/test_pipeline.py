"""The pipeline as a user of Python calls it: a recording in, an evaluation out."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.calibration import SensorCalibration, Triad
from dualfoot_ros.cli.main import main
from dualfoot_ros.core import ONE_FOOT_STD, ConfigError, TrackerConfig
from dualfoot_ros.evaluation import (
    Align,
    EvaluationError,
    Options,
    RunOptions,
    person_track,
    run,
)
from dualfoot_ros.evaluation.notes import field_notes
from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.recording import (
    Recording,
    RecordingError,
    Reference,
    Topics,
    read_bag,
    write_bag,
)
from dualfoot_ros.simulation import WalkConfig, simulate


@pytest.fixture(scope="module")
def walked() -> Recording:
    """Return a simulated walk with turns and with truth."""
    made = simulate(WalkConfig(route="rectangle", rate=60.0, standing=4.0), seed=4)
    return Recording(made.left, made.right, made.left_truth, made.right_truth)


@pytest.fixture(scope="module")
def bag(walked, tmp_path_factory):
    """Return the folder that holds the walk as the bag "walk"."""
    folder = tmp_path_factory.mktemp("bags")
    write_bag(folder / "walk", walked)
    return folder


def test_three_lines_give_an_evaluation(bag):
    lines = """\
from dualfoot_ros.evaluation import run
from dualfoot_ros.recording import read_bag
result = run(read_bag("walk"))
"""
    shown = "print(result.truth_report.midpoint.end_percent, len(result.tracked.left))"
    done = subprocess.run(
        [sys.executable, "-c", lines + shown], cwd=bag, capture_output=True, text=True, check=True
    )
    end_percent, epochs = map(float, done.stdout.split())
    assert 0.0 < end_percent < 5.0
    assert epochs > 2000
    assert done.stderr == ""


def test_its_figures_are_those_of_the_verb(bag, capsys):
    assert main(["evaluate", str(bag / "walk"), "--method", "idc", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    figures = run(read_bag(bag / "walk"), options=RunOptions(method="idc")).to_dict()
    assert {name: printed[name] for name in figures} == figures


@pytest.mark.parametrize("config", [None, "liu2023", TrackerConfig(gravity=9.81)])
def test_method_and_parameters_of_the_options_win_over_any_configuration(walked, config):
    options = RunOptions(method="zupt", parameters={"zupt": {"std": 0.03}}, check_feet=False)
    result = run(walked, config, options)
    by_hand = {"method": "zupt", "zupt.std": 0.03}
    if isinstance(config, TrackerConfig):
        by_hand["gravity"] = 9.81
        expected = run(walked, TrackerConfig.from_mapping(by_hand))
    else:
        expected = run(walked, config, RunOptions(parameters=by_hand))
    assert result.trajectory.method == "zupt"
    assert np.array_equal(result.tracked.left.position, expected.tracked.left.position)


def test_an_unknown_preset_or_parameter_is_refused_before_the_recording_is_looked_at():
    with pytest.raises(ConfigError, match="unknown preset 'nix'"):
        run(Recording(), "nix")
    with pytest.raises(ConfigError, match=r"unknown parameter 'zupt\.sdt'"):
        run(Recording(), options=RunOptions(parameters={"zupt.sdt": 1.0}))


def test_a_recording_that_cannot_be_used_is_refused_with_its_finding(walked):
    asked_for = replace(Topics(), right=replace(Topics().right, imu="/imu"))
    with pytest.raises(RecordingError, match="no samples of the right foot"):
        run(replace(walked, right=None, topics=asked_for))


@pytest.mark.parametrize(("feet", "sentence"), [("nix", "allowed is left"), ("right", "no samp")])
def test_a_foot_that_is_asked_for_alone_must_be_there(walked, feet, sentence):
    with pytest.raises(EvaluationError, match=sentence):
        run(replace(walked, right=None), options=RunOptions(feet=feet))


def test_warnings_about_the_recording_are_findings_of_the_result(walked):
    kept = np.r_[0:1500, 1530 : len(walked.left)]
    result = run(replace(walked, left=walked.left[kept]), options=RunOptions(method="zupt"))
    assert [finding.kind for finding in result.findings] == [FindingKind.GAPS]
    assert run(walked, options=RunOptions(method="zupt")).findings == ()


def test_exchanged_sensors_are_found_unless_nobody_asks(walked):
    exchanged = Recording(walked.right, walked.left, walked.right_truth, walked.left_truth)
    result = run(exchanged, options=RunOptions(method="zupt"))
    assert [finding.kind for finding in result.findings] == [FindingKind.EXCHANGED_FEET]
    assert result.notes[-1] == f"warning: {result.findings[0].sentence}"
    assert run(exchanged, options=RunOptions(method="zupt", check_feet=False)).findings == ()


def test_samples_that_are_not_finite_are_left_out_and_counted_where_that_is_allowed(walked):
    rate = walked.left.angular_rate.copy()
    rate[1500] = np.nan
    broken = replace(walked, left=replace(walked.left, angular_rate=rate))
    with pytest.raises(RecordingError, match=r"1 of .* samples are not finite"):
        run(broken)
    result = run(broken, options=RunOptions(method="zupt", allow_not_finite=True))
    assert result.trajectory.counters["sync.left_not_finite"] == 1


def test_a_calibration_is_applied_to_the_samples_of_its_foot(walked):
    offset = np.array([0.0, 0.0, 0.02])
    off = replace(walked.left, angular_rate=walked.left.angular_rate + offset)
    bias = SensorCalibration(gyro=Triad(offset, np.eye(3)))
    options = RunOptions(method="zupt", check_feet=False)
    plain = run(walked, options=options)
    corrected = run(
        replace(walked, left=off), options=replace(options, calibration={"left": bias})
    )
    assert corrected.tracked.left.position == pytest.approx(plain.tracked.left.position, abs=1e-6)


def test_alignment_and_reference_are_those_of_the_options(walked):
    marks = Reference("a test", {"right": np.array([[0.0, 0.0, 0.0], [1.2, 0.0, 0.0]])})
    options = RunOptions(method="zupt", alignment=Options(Align.UMEYAMA4), reference=marks)
    result = run(walked, options=options)
    assert result.options.align is Align.UMEYAMA4
    assert result.marker_report["right"].markers == 2


def test_the_tracks_before_alignment_and_the_time_it_took_are_kept(walked):
    result = run(walked, options=RunOptions(method="zupt"))
    middle = 0.5 * (result.tracked.left.position[0] + result.tracked.right.position[0])
    assert np.linalg.norm(middle[:2]) < 0.01  # the tracker's own origin
    assert result.run_s is not None and result.run_s > 0.0
    moved = result.transforms["left"].position(result.tracked.left.position)
    assert moved[-len(result.trajectory.left) :] == pytest.approx(
        result.trajectory.left.position, abs=1e-9
    )


def test_a_magnetic_heading_that_found_no_reference_says_so():
    counters = {"stances_before_field_reference": 40}
    (note,) = field_notes(counters, used=False)
    assert "no reference was found in 40 stances" in note
    (usual,) = field_notes(counters, used=True)
    assert "40 stances until the field of the start was known" in usual


def test_of_one_foot_alone_the_person_walks_the_whole_way_of_that_foot(walked):
    both, alone = (run(walked, None, RunOptions(feet=feet)) for feet in ("both", "left"))
    person, of_both = person_track(alone.tracked), person_track(both.tracked)
    left = alone.tracked.left
    assert np.array_equal(person.position, left.position)
    assert person.walked_m[-1] == pytest.approx(of_both.walked_m[-1], rel=0.02)
    assert np.ptp(person.heading) == pytest.approx(np.ptp(of_both.heading), abs=0.3)
    variance = left.position_covariance[:, 0, 0] + ONE_FOOT_STD**2
    assert np.allclose(person.covariance[:, 0, 0], variance)
    figures = alone.to_dict()
    assert figures["feet"]["passings"] == 0
    gap = figures["closure"]
    assert gap["right_m"] is None and gap["right_percent"] is None
    assert gap["mean_m"] == gap["midpoint_m"] == gap["left_m"] < 5.0
    assert gap["mean_percent"] == gap["left_percent"]
    largest = float(person.radius_95_m[-1])  # of the ellipse; that of the trust is of a circle
    assert 0.8 * largest < figures["trust"]["radius_m"] <= largest


def test_where_a_foot_is_silent_for_a_while_the_person_is_at_the_other_one(walked):
    stamps = walked.right.stamp_ns
    silent = (stamps > stamps[1500]) & (stamps < stamps[1900])
    tracked = run(replace(walked, right=walked.right[~silent])).tracked
    position, gone = person_track(tracked).position, ~tracked.right.present
    assert 300 < np.sum(gone) < 500
    assert np.array_equal(position[gone], tracked.left.position[gone])
    middle = (tracked.left.position + tracked.right.position) / 2
    assert np.array_equal(position[~gone], middle[~gone])


def test_with_fewer_covariances_every_figure_is_the_same(walked):
    """Also where the truth begins late and ends early, and where there is none."""
    middle = [truth_part(walked.truth(foot)) for foot in ("left", "right")]
    for truths in (middle, [None, None]):
        recording = replace(walked, left_truth=truths[0], right_truth=truths[1])
        whole, lean = (
            run(recording, options=RunOptions(check_feet=False, all_covariances=every))
            for every in (True, False)
        )
        assert lean.to_dict() == whole.to_dict()
        assert np.isnan(lean.trajectory.left.velocity_covariance[:, 0, 0]).mean() > 0.9
        assert np.array_equal(lean.person.covariance, whole.person.covariance)


def truth_part(truth):
    part = slice(len(truth) // 4, len(truth) // 2)
    velocity = truth.velocity[part]
    return replace(
        truth,
        stamp_ns=truth.stamp_ns[part],
        position=truth.position[part],
        quaternion=truth.quaternion[part],
        velocity=velocity,
    )
