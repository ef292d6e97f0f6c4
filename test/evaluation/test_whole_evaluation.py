"""The whole evaluation of a trajectory, against truth, markers and itself."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.errors import EvaluationError
from dualfoot_ros.core.samples.series import PoseSeries
from dualfoot_ros.evaluation.frames.gauge import Options
from dualfoot_ros.evaluation.frames.yaw_transform import Align, Pair, YawTransform
from dualfoot_ros.evaluation.reports.text_files import write_tracks
from dualfoot_ros.evaluation.whole_evaluation import evaluate
from dualfoot_ros.recording.reference import Reference

from .walks import perfect, rectangle

shifts = st.tuples(*[st.floats(-100, 100)] * 3).map(np.array)


def moved(track, yaw, shift=(0.0, 0.0, 0.0), feet=("left", "right")):
    """Return a trajectory of which the named feet are turned and shifted."""
    transform = YawTransform(yaw, np.asarray(shift))
    return replace(track, **{name: transform.foot(getattr(track, name)) for name in feet})


@settings(max_examples=20, deadline=None)
@given(st.floats(-3.1, 3.1), shifts, st.sampled_from(list(Align)), st.sampled_from(list(Pair)))
def test_a_turned_and_shifted_estimate_is_without_error_once_aligned(yaw, shift, align, pair):
    track, truth = perfect(rectangle())
    found = evaluate(moved(track, yaw, shift), truth=truth, options=Options(align, pair))
    assert found.truth_report.left.max_m < 1e-9
    assert found.truth_report.right.max_m < 1e-9
    assert found.truth_report.heading.common_rms_deg < 1e-6
    assert found.truth_report.nees.left_position < 1e-12


@settings(max_examples=20, deadline=None)
@given(st.floats(-3.1, 3.1), shifts, st.integers(0, 50), st.sampled_from(list(Align)))
def test_no_figure_depends_on_where_and_whither_the_estimate_started(yaw, shift, seed, align):
    track, truth = perfect(rectangle())
    rng = np.random.default_rng(seed)
    for foot in (track.left, track.right):
        foot.position[:] += np.cumsum(rng.normal(scale=0.003, size=foot.position.shape), axis=0)
    here = evaluate(track, truth=truth, options=Options(align)).to_dict()
    there = evaluate(moved(track, yaw, shift), truth=truth, options=Options(align)).to_dict()
    assert flat(there["truth"]) == pytest.approx(flat(here["truth"]), abs=1e-7)
    assert flat(there["feet"]) == pytest.approx(flat(here["feet"]), abs=1e-7)
    assert flat(there["closure"]) == pytest.approx(flat(here["closure"]), abs=1e-7)


def flat(tree, name=""):
    """Return every number of a nested dictionary by its path."""
    if isinstance(tree, dict):
        return {k: v for key, item in tree.items() for k, v in flat(item, f"{name}/{key}").items()}
    return {name: tree} if isinstance(tree, (int, float)) else {}


def test_one_transform_for_both_feet_keeps_the_error_between_them_and_two_take_it_away():
    track, truth = perfect()
    apart = moved(track, 0.1, feet=("left",))
    common = evaluate(apart, truth=truth, options=Options(pair=Pair.COMMON))
    each = evaluate(apart, truth=truth, options=Options(pair=Pair.EACH))
    assert np.degrees(0.1) == pytest.approx(common.truth_report.heading.difference_end_deg)
    assert common.truth_report.heading.common_end_deg == pytest.approx(0.0, abs=1.0)
    assert each.truth_report.heading.difference_end_deg == pytest.approx(0.0, abs=1e-6)
    assert "both feet" in common.alignment_name
    assert "each foot" in each.alignment_name


@pytest.mark.parametrize("pair", list(Pair))
def test_where_a_foot_is_missing_it_has_no_error_and_tells_no_frame(pair):
    track, truth = perfect(rectangle())
    there = np.arange(len(track.right)) > len(track.right) // 2
    track.right.position[~there] = [5.0, -3.0, 1.0]
    late = replace(track, right=replace(track.right, present=there))
    found = evaluate(late, truth=truth, options=Options(pair=pair)).truth_report
    assert max(found.left.max_m, found.right.max_m, found.midpoint.max_m) < 1e-9
    gone = replace(track, right=replace(track.right, present=~there))
    found = evaluate(gone, truth=truth, options=Options(pair=pair)).truth_report
    assert found.right.max_m > 1.0


def test_the_whole_walk_fitted_has_no_more_rmse_than_the_first_strides_fitted():
    track, truth = perfect(rectangle())
    for foot in (track.left, track.right):
        foot.position[:] *= [1.05, 0.97, 1.0]
    figures = {
        align: evaluate(track, truth=truth, options=Options(align)).truth_report for align in Align
    }
    assert figures[Align.UMEYAMA4].left.rmse_m < figures[Align.FIRST_STRIDES].left.rmse_m


def test_markers_are_met_by_a_track_turned_away_from_them():
    track, _ = perfect(rectangle())
    stood = evaluate(track).trajectory.right
    markers = on_markers(known_stances(stood))
    found = evaluate(moved(track, 1.0, (3, 4, 5)), reference=markers)
    assert found.aligned_to == "markers"
    assert found.marker_report["right"].stances == found.marker_report["right"].markers == 21
    assert found.marker_report["right"].rmse_m < 1e-9


def test_a_track_one_degree_off_its_first_markers_has_the_rmse_of_the_chord():
    points = np.column_stack([np.arange(21) * 1.2, np.zeros(21)])
    track, _ = perfect(points)
    markers = on_markers(known_stances(track.right))
    bend = np.radians(1.0)
    late = track.right.position[:, 0] > 4.9
    x = track.right.position[:, 0] - 4.8
    track.right.position[late, 0] = 4.8 + x[late] * np.cos(bend)
    track.right.position[late, 1] += x[late] * np.sin(bend)
    errors = evaluate(track, reference=markers).marker_report["right"]
    beyond = np.arange(1, 17) * 1.2 * 2 * np.sin(bend / 2)
    assert errors.rmse_m == pytest.approx(np.sqrt(np.sum(beyond**2) / 21), rel=1e-6)
    assert errors.end_m == pytest.approx(beyond[-1], rel=1e-6)


def on_markers(points):
    """Return a reference of the right foot's markers."""
    return Reference("made by formula", {"right": points})


def known_stances(track):
    """Return the mean position of every stance, counted independently of the evaluation."""
    edges = np.flatnonzero(np.diff(track.stance.astype(int))) + 1
    parts = np.split(np.arange(len(track.stance)), edges)
    return np.array([track.position[p].mean(axis=0) for p in parts if track.stance[p[0]]])


def test_a_missed_stance_leaves_no_marker_error_rather_than_a_wrong_one():
    track, _ = perfect(rectangle())
    markers = on_markers(known_stances(track.right)[:-1])
    errors = evaluate(track, reference=markers).marker_report["right"]
    assert (errors.stances, errors.markers) == (21, 20)
    assert errors.rmse_m is None


def test_a_loop_that_closes_has_no_gap_and_one_that_does_not_has_the_gap_of_its_end():
    track, _ = perfect(rectangle())
    assert evaluate(track).closure.midpoint_m < SPACING_OF_START
    last = track.left.stance.nonzero()[0][-1]
    track.left.position[last - 20 :] += [0.3, 0.4, 2.0]
    before = evaluate(perfect(rectangle())[0]).closure
    found = evaluate(track).closure
    assert found.left_m != before.left_m
    assert found.right_m == before.right_m
    assert found.mean_m >= found.midpoint_m


SPACING_OF_START = 0.2


def test_truth_of_another_time_is_refused_in_a_sentence():
    track, truth = perfect()
    late = tuple(
        PoseSeries(t.stamp_ns + 10**12, t.position, t.quaternion, t.velocity) for t in truth
    )
    with pytest.raises(EvaluationError, match="overlap"):
        evaluate(track, truth=late)


def test_truth_of_another_rate_is_interpolated_to_the_stamps_of_the_estimate():
    track, truth = perfect()
    coarse = tuple(
        PoseSeries(t.stamp_ns[::2], t.position[::2], t.quaternion[::2], t.velocity[::2])
        for t in truth
    )
    found = evaluate(track, truth=coarse)
    assert found.truth_report.left.max_m < 2e-3
    without = tuple(replace(t, velocity=None) for t in coarse)
    assert evaluate(track, truth=without).truth_report.nees.left_velocity is None


def test_the_figures_survive_json_without_not_a_number():
    track, truth = perfect()
    text = json.dumps(evaluate(track, truth=truth).to_dict(), allow_nan=False)
    assert json.loads(text)["alignment"]["method"] == "first_strides"
    nothing = json.dumps(evaluate(track).to_dict(), allow_nan=False)
    assert json.loads(nothing)["truth"] is None


def test_tum_files_hold_the_aligned_track_with_stamps_to_the_nanosecond(tmp_path):
    track, truth = perfect()
    found = evaluate(moved(track, 0.3), truth=truth)
    paths = write_tracks(tmp_path, found)
    assert [p.name for p in paths] == [
        "left.tum",
        "right.tum",
        "left_truth.tum",
        "right_truth.tum",
    ]
    rows = np.loadtxt(paths[0])
    np.testing.assert_allclose(rows[:, 1:4], truth[0].position, atol=1e-8)
    np.testing.assert_allclose(rows[:, 4:], truth[0].quaternion, atol=1e-8)
    first = paths[0].read_text().split()[0]
    assert first.replace(".", "") == str(track.left.stamp_ns[0])
