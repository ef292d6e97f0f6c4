"""A clock that is set back during a walk costs a finding, and no walk."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.cli.main import main
from dualfoot_ros.core import PressureSeries
from dualfoot_ros.evaluation import RunOptions, run
from dualfoot_ros.inspection import FindingKind, check_usable, mend_clocks
from dualfoot_ros.recording import Recording, RecordingError, read_bag, write_bag
from dualfoot_ros.simulation import WalkConfig, simulate

BOTH = ("left", "right")
INTERVAL_NS = 16_666_667
AT_S = 20.0


@pytest.fixture(scope="module")
def walked():
    """Return a simulated walk with a corner, at 60 Hz, with truth and air pressure."""
    made = simulate(WalkConfig(route="L", rate=60.0, standing=4.0), seed=3)
    stamps = made.left.stamp_ns[::6]
    pressure = {"both": PressureSeries(stamps, np.full(len(stamps), 1e5))}
    return Recording(made.left, made.right, made.left_truth, made.right_truth, pressure=pressure)


def set_by(series, by_s, at_s=AT_S):
    """Return a series whose clock is set by ``by_s`` at ``at_s`` after its first sample."""
    index = round(at_s * 1e9 / np.median(np.diff(series.stamp_ns)))
    stamps = series.stamp_ns.copy()
    stamps[index:] += round(by_s * 1e9)
    return replace(series, stamp_ns=stamps)


def stepped(recording, by_s, feet=BOTH, **when):
    """Return the recording with the clock of ``feet`` and of their truths set."""
    names = [name for foot in feet for name in (foot, f"{foot}_truth")]
    return replace(recording, **{n: set_by(getattr(recording, n), by_s, **when) for n in names})


def error_m(recording):
    result = run(recording, options=RunOptions(check_feet=False))
    return result.truth_report.midpoint.rmse_m, result


def set_clocks(findings):
    return [f for f in findings if f.kind is FindingKind.CLOCK_SET]


def assert_same_time(mended, recording):
    for name in (*BOTH, "left_truth", "right_truth"):
        apart = getattr(mended, name).stamp_ns - getattr(recording, name).stamp_ns
        assert np.abs(apart).max() <= 2  # the intervals of 60 Hz are rounded to ns


def test_a_good_recording_is_returned_as_it_is(walked):
    assert mend_clocks(walked) is walked


@pytest.mark.parametrize("by_s", [-3600.0, -1.0])
def test_a_clock_of_both_feet_that_is_set_back_costs_no_walk(walked, by_s):
    before, _ = error_m(walked)
    after, result = error_m(stepped(walked, by_s))
    assert abs(after - before) < 0.1
    (found,) = set_clocks(result.findings)
    assert f"both feet was set back by {-by_s:.3f} s, 20.0 s after" in found.text
    assert "let no clock be set" in found.remedy
    assert result.trajectory.counters["sync.restarts"] == 1


@pytest.mark.parametrize("by_s", [1.0, 3600.0, 30 * 86400.0])
@pytest.mark.parametrize("foot", BOTH)
def test_a_clock_of_one_foot_that_is_set_ahead_is_mended_and_said(walked, foot, by_s):
    set_ahead = stepped(walked, by_s, [foot])
    assert_same_time(mend_clocks(set_ahead), walked)
    (found,) = set_clocks(check_usable(mend_clocks(set_ahead)))
    assert f"the {foot} foot was set ahead by {by_s:.3f} s" in found.text


def test_samples_of_a_second_that_one_foot_lost_are_a_hole(walked):
    kept = np.r_[0:1200, 1260 : len(walked.left)]
    lossy = replace(walked, left=walked.left[kept])
    assert mend_clocks(lossy) is lossy


def test_a_foot_that_ends_early_after_a_hole_is_left_as_it_is(walked):
    kept = np.r_[0:1200, 1260 : len(walked.left) - 300]
    lossy = replace(walked, left=walked.left[kept])
    assert mend_clocks(lossy) is lossy


def test_the_offset_of_the_feet_stays(walked):
    wanted = replace(walked, right=walked.right[2:])
    right = set_by(wanted.right, -3600.0, at_s=AT_S - 2 * INTERVAL_NS * 1e-9)
    mended = mend_clocks(replace(stepped(wanted, -3600.0), right=right))
    assert np.abs(mended.left.stamp_ns - wanted.left.stamp_ns).max() <= 2
    shifts = [getattr(mended, f).stamp_ns[-1] - getattr(wanted, f).stamp_ns[-1] for f in BOTH]
    assert shifts[0] == shifts[1]


def test_samples_that_one_foot_lost_at_the_step_are_a_hole_of_it_alone(walked):
    lost = np.r_[0:1200, 1203 : len(walked.right)]
    mended = mend_clocks(stepped(replace(walked, right=walked.right[lost]), -3600.0))
    assert np.abs(mended.right.stamp_ns - walked.right.stamp_ns[lost]).max() <= 2


def test_every_step_of_several_is_taken_off_and_told(walked):
    mended = mend_clocks(stepped(stepped(walked, -5.0), -3600.0, at_s=30.0))
    assert_same_time(mended, walked)
    assert [round(step.by_ns * 1e-9) for step in mended.clock_steps] == [5, 3600]


def test_a_truth_of_another_clock_is_left_as_it_is(walked):
    feet = {foot: set_by(walked.imu(foot), -3600.0) for foot in BOTH}
    assert_same_time(mend_clocks(replace(walked, **feet)), walked)


def test_a_truth_that_steps_otherwise_ends_there_and_that_is_said(walked):
    truths = {f"{f}_truth": set_by(walked.truth(f), -50.0) for f in BOTH}
    recording = replace(stepped(walked, -3600.0), **truths)
    error, result = error_m(recording)
    assert error < 0.5 and "the truth steps otherwise" in set_clocks(result.findings)[0].text
    last = result.trajectory.left.stamp_ns[-1] - walked.left.stamp_ns[0]
    assert abs(last * 1e-9 - AT_S) < 0.1


def test_air_pressure_on_the_same_clock_goes_along(walked):
    pressure = {"both": set_by(walked.pressure["both"], -3600.0)}
    mended = mend_clocks(replace(stepped(walked, -3600.0), pressure=pressure))
    wanted = walked.pressure["both"].stamp_ns
    assert np.abs(mended.pressure["both"].stamp_ns - wanted).max() <= 2


@pytest.mark.parametrize("foot", BOTH)
def test_a_clock_of_one_foot_is_mended_where_the_ends_of_the_feet_agree(walked, foot):
    mended = mend_clocks(stepped(walked, -3600.0, (foot,)))
    assert_same_time(mended, walked)
    (found,) = set_clocks(check_usable(mended))
    assert found.about == foot and f"the {foot} foot was set back" in found.text


def test_a_foot_that_is_alone_is_mended_by_its_own_samples(walked):
    alone = replace(walked, right=None, right_truth=None)
    mended = mend_clocks(stepped(alone, -3600.0, ("left",)))
    assert np.abs(mended.left.stamp_ns - walked.left.stamp_ns).max() <= 2


def without(series, index, count):
    return series[np.r_[0:index, index + count : len(series)]]


def from_the_future(series):
    stamps = series.stamp_ns.copy()
    stamps[1200] += 10_000_000_000
    return replace(series, stamp_ns=stamps)


REFUSED = {
    "begins anew": lambda walk: replace(walk, **{f: set_by(walk.imu(f), -AT_S) for f in BOTH}),
    "by different amounts": lambda walk: stepped(
        stepped(walk, -3600.0, ("left",)), -3605.0, ("right",)
    ),
    "at different places": lambda walk: stepped(
        stepped(walk, -3600.0, ("left",)), -3600.0, ("right",), at_s=30.0
    ),
    "one foot, which lost samples there": lambda walk: stepped(
        replace(walk, left=without(walk.left, 1200, 9)), -3600.0, ("left",)
    ),
    "a stamp from the future": lambda walk: replace(walk, left=from_the_future(walk.left)),
    "a hole before": lambda walk: stepped(
        replace(walk, left=without(walk.left, 1185, 9)), -3600.0
    ),
}


@pytest.mark.parametrize("change", REFUSED.values(), ids=REFUSED.keys())
def test_what_is_no_clock_that_was_set_is_refused_as_two_recordings(walked, change):
    recording = change(walked)
    assert mend_clocks(recording) is recording
    with pytest.raises(RecordingError, match="two recordings in one bag; cut it there"):
        run(recording)


def test_a_clock_that_is_set_again_and_again_is_not_mended(walked):
    recording = walked
    for at_s in range(10, 40, 2):
        recording = stepped(recording, -3600.0, at_s=at_s)
    assert mend_clocks(recording) is recording


def logged_by_the_clock_that_is_set(channels):
    """Return log times that are the stamps, and the channels, in the order of the rows."""
    stamps = [channel.stamp_ns for channel in channels]
    which = np.concatenate([np.full(len(s), k) for k, s in enumerate(stamps)])
    share = np.concatenate([np.arange(len(s)) / len(s) for s in stamps])
    order = np.argsort(share, kind="stable")
    return np.concatenate(stamps)[order], which[order]


@pytest.mark.parametrize("by_s", [-3600.0, -1.0])
def test_the_log_times_of_the_bag_may_be_of_the_same_clock(walked, tmp_path, monkeypatch, by_s):
    monkeypatch.setattr("dualfoot_ros.recording.write._in_order", logged_by_the_clock_that_is_set)
    bag = write_bag(tmp_path / "bag", stepped(walked, by_s))
    assert_same_time(mend_clocks(read_bag(bag)), walked)


def test_info_and_evaluate_say_the_same_of_a_bag(walked, tmp_path, capsys):
    bag = str(write_bag(tmp_path / "bag", stepped(walked, -3600.0)))
    said = []
    for verb in (["info", bag, "--no-stances"], ["evaluate", bag]):
        assert main(verb) == 0
        said.append("was set back by 3600.000 s" in capsys.readouterr().out)
    assert said == [True, True]
