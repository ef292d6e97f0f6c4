"""Gait parameters: on walks by formula, and against the exact truth of the simulator."""

import csv
import io
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from benchmark.gait_accuracy import true_strides
from dualfoot_ros.core import stance_bounds
from dualfoot_ros.evaluation import evaluate, pair_samples, track_samples
from dualfoot_ros.evaluation.gait import (
    PARAMETERS,
    Stride,
    find_contacts,
    strides_csv,
    strides_of,
    summarise,
)
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import WalkConfig, simulate

from ..walks import SPACING, perfect


@pytest.fixture(scope="module")
def made():
    """Return one simulated walk."""
    return simulate(WalkConfig.from_mapping({"route": "rectangle", "laps": 2}), seed=4)


@pytest.fixture(scope="module")
def tracked(made):
    """Return the track of the simulated walk."""
    return track_samples(pair_samples(Recording(made.left, made.right)))


@pytest.fixture(scope="module")
def simulated(made, tracked):
    """Return estimated and true strides of the simulated walk."""
    return strides_of(tracked.left, tracked.right), true_strides(made)


def matched(estimated, true):
    """Return pairs of the same steady stride."""
    pairs = [
        (e, t)
        for t in true
        for e in estimated
        if e.foot == t.foot and abs(e.end_ns - t.end_ns) < 200_000_000
    ]
    return [(e, t) for e, t in pairs if e.steady and t.steady]


def straight_walk() -> tuple[Stride, ...]:
    track, _ = perfect()
    return strides_of(track.left, track.right)


def test_strides_of_a_straight_walk_have_the_lengths_that_were_walked():
    strides = straight_walk()
    right = [s for s in strides if s.foot == "right"]
    assert len(right) == 20
    assert [s.stride_length_m for s in right] == pytest.approx([1.2] * 20)
    assert [s.step_length_m for s in right[1:-1]] == pytest.approx([0.6] * 18)
    assert [s.step_width_m for s in right] == pytest.approx([SPACING] * 20)
    assert [s.turn_deg for s in right] == pytest.approx([0.0] * 20, abs=1e-9)
    assert [s.rise_m for s in right] == pytest.approx([0.0] * 20)


def test_the_two_steps_of_a_stride_make_up_its_length():
    strides = straight_walk()
    left = [s for s in strides if s.foot == "left"][2:-2]
    right = {s.number: s for s in strides if s.foot == "right"}
    for own in left:
        before = right[own.number - 1]
        assert own.step_length_m + before.step_length_m == pytest.approx(own.stride_length_m)


def test_crossed_feet_have_a_negative_step_width():
    track, _ = perfect()
    crossed = strides_of(track.right, track.left)
    assert all(s.step_width_m < 0 for s in crossed if not math.isnan(s.step_width_m))


def test_a_slope_is_no_clearance_and_a_lifted_foot_is():
    track, _ = perfect()
    x = track.left.position[:, 0]
    for foot in (track.left, track.right):
        foot.position[:, 2] += 0.1 * foot.position[:, 0]
    swings = ~track.left.stance
    track.left.position[:, 2] += np.where(swings, 0.05, 0.0)
    assert np.ptp(x) > 0
    strides = [s for s in strides_of(track.left, track.right) if s.stride_length_m > 1.0]
    lifted = [s.clearance_m for s in strides if s.foot == "left"]
    level = [s.clearance_m for s in strides if s.foot == "right"]
    assert lifted == pytest.approx([0.05] * len(lifted), abs=1e-6)
    assert level == pytest.approx([0.0] * len(level), abs=1e-6)


def test_a_walk_that_is_turned_and_shifted_has_the_same_strides():
    track, truth = perfect()
    own = evaluate(track, truth=truth)
    turned = [replace(foot) for foot in (track.left, track.right)]
    for foot in turned:
        foot.position[:] = foot.position @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]]) + 5.0
    moved = strides_of(*turned)
    assert [s.stride_length_m for s in moved] == pytest.approx(
        [s.stride_length_m for s in own.gait.strides]
    )


def test_standing_feet_have_no_strides_and_no_contacts():
    track, _ = perfect()
    still = replace(
        track.left,
        position=np.zeros_like(track.left.position),
        stance=np.ones(len(track.left), dtype=bool),
    )
    assert strides_of(still, still) == ()
    assert np.isnan(find_contacts(still).contact_s).all()
    gait = summarise(())
    assert gait.parameters["stride_length_m"].both.mean is None


def test_stance_and_swing_make_up_the_stride_and_the_stride_makes_the_cadence(simulated):
    estimated, _ = simulated
    steady = [s for s in estimated if s.steady]
    assert len(steady) > 40
    for s in steady:
        assert s.stance_time_s + s.swing_time_s == pytest.approx(s.stride_time_s)
        assert s.cadence_steps_per_min * s.stride_time_s == pytest.approx(120.0)
        assert s.speed_m_per_s * s.stride_time_s == pytest.approx(s.stride_length_m)
        assert s.stance_percent == pytest.approx(100 * s.stance_time_s / s.stride_time_s)


@pytest.mark.parametrize(
    ("name", "bias", "spread"),
    [
        ("stride_length_m", 0.01, 0.025),
        ("step_length_m", 0.01, 0.05),
        ("step_width_m", 0.06, 0.05),
        ("stride_time_s", 0.002, 0.005),
        ("stance_time_s", 0.005, 0.004),
        ("swing_time_s", 0.005, 0.004),
        ("cadence_steps_per_min", 0.2, 0.5),
        ("speed_m_per_s", 0.01, 0.025),
        ("clearance_m", 0.01, 0.01),
        ("contact_deg", 2.0, 2.0),
        ("lift_off_deg", 2.5, 2.0),
        ("turn_deg", 0.3, 1.5),
    ],
)
def test_each_parameter_is_near_the_truth_of_the_simulator(simulated, name, bias, spread):
    pairs = matched(*simulated)
    assert len(pairs) > 40
    error = np.array([getattr(e, name) - getattr(t, name) for e, t in pairs])
    error = error[np.isfinite(error)]
    assert abs(error.mean()) < bias
    assert error.std() < spread


@pytest.mark.parametrize("higher", [-1, 1])
def test_lift_off_is_the_middle_of_push_off_whichever_tip_of_its_peak_is_higher(higher):
    track, _ = perfect()
    time = (track.left.stamp_ns - track.left.stamp_ns[0]) * 1e-9
    start, end = (np.flatnonzero(np.diff(track.left.stance.astype(int)) == s)[2] for s in (-1, 1))
    middle = time[start] + 0.3 * (time[end] - time[start])
    push = _bump(time - middle + 0.04, 0.032) + _bump(time - middle - 0.04, 0.032)
    push += 0.03 * _bump(time - middle - 0.04 * higher, 0.02)
    back = _bump(time - middle - 0.25, 0.05)
    rate = np.deg2rad(40.0) * (push / push.sum() - back / back.sum())
    pitch = np.cumsum(rate) - rate / 2
    own = Rotation.from_euler("Y", pitch[:, None]) * Rotation.from_quat(track.left.quaternion)
    found = find_contacts(replace(track.left, quaternion=own.as_quat()))
    lift_offs = found.lift_off_s[np.abs(found.lift_off_s - middle) < 0.1]
    assert lift_offs == pytest.approx([middle], abs=0.003)


def _bump(time, width):
    return np.exp(-0.5 * (time / width) ** 2)


def test_a_missed_stance_costs_its_stride_and_not_the_times_of_its_neighbours(tracked):
    bounds = stance_bounds(tracked.left.stance)
    missed = tracked.left.stance.copy()
    missed[slice(*bounds[12])] = False
    blind = replace(tracked.left, stance=missed)
    before, after = (
        [s for s in strides_of(left, tracked.right) if s.foot == "left"]
        for left in (tracked.left, blind)
    )
    assert len(after) == len(before) - 1
    double = next(s for s in after if s.start_ns == before[11].start_ns)
    assert not double.steady and math.isnan(double.stride_time_s)
    times = {s.end_ns: s.stride_time_s for s in before}
    for s in after:
        if s is not double:
            assert s.stride_time_s == pytest.approx(times[s.end_ns], abs=0.005, nan_ok=True)


def test_strides_beside_missing_samples_are_not_steady(tracked):
    """What was walked in a hole is put right in the next stance, so two strides are wrong."""
    stances = stance_bounds(tracked.left.stance)
    lost = tracked.left.present.copy()
    lost[stances[9, 1] + 5 : stances[9, 1] + 25] = False
    before = {(s.foot, s.start_ns): s for s in strides_of(tracked.left, tracked.right)}
    after = {
        (s.foot, s.start_ns): s
        for s in strides_of(replace(tracked.left, present=lost), tracked.right)
    }
    changed = [key for key, stride in after.items() if stride.steady != before[key].steady]
    starts = tracked.left.stamp_ns[(stances[9:11].sum(axis=1) - 1) // 2]
    assert changed == [("left", int(start)) for start in starts]
    steps = [s for s in after.values() if math.isnan(s.step_width_m)]
    assert {s.foot for s in steps} == {"right"} and len(steps) == 2


def test_a_corner_is_turned_stride_by_stride(simulated):
    estimated, _ = simulated
    for foot in ("left", "right"):
        turned = sum(s.turn_deg for s in estimated if s.foot == foot)
        assert abs(turned) == pytest.approx(720.0, abs=20.0)


def test_a_limp_is_asymmetry_and_not_variability():
    strides = [s for s in straight_walk() if s.foot == "left"][1:-1]
    left = [replace(s, steady=True, stance_time_s=0.60) for s in strides]
    right = [replace(s, steady=True, foot="right", stance_time_s=0.66) for s in strides]
    found = summarise(left + right).parameters["stance_time_s"]
    assert found.symmetry_percent == pytest.approx(100 * 0.06 / 0.63)
    assert found.both.std == pytest.approx(0.0, abs=1e-12)
    assert found.both.mean == pytest.approx(0.63)


def test_the_csv_has_one_row_a_stride_and_empty_cells_for_what_is_not_known(simulated):
    estimated, _ = simulated
    rows = list(csv.DictReader(io.StringIO(strides_csv(estimated))))
    assert len(rows) == len(estimated)
    assert float(rows[5]["stride_length_m"]) == pytest.approx(
        estimated[5].stride_length_m, abs=1e-6
    )
    assert rows[0]["stride_time_s"] == ""
    assert int(rows[3]["start_ns"]) == estimated[3].start_ns


def test_the_figures_of_an_evaluation_hold_every_parameter():
    track, truth = perfect()
    figures = evaluate(track, truth=truth).to_dict()["gait"]
    assert figures["strides"] == {"left": 21, "right": 20}
    assert set(figures["parameters"]) == set(PARAMETERS)
    assert set(figures["parameters"]["speed_m_per_s"]["left"]) == {
        "count",
        "mean",
        "std",
        "cv_percent",
    }
