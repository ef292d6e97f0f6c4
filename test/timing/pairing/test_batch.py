"""Two recordings on one grid: what holds for any stamps, and what for particular ones."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import ConfigError, ImuSeries
from dualfoot_ros.timing import AlignerConfig, TimingError, align, align_with_report

MS = 1_000_000


def series(stamps, force=None, rate=None):
    """Return a series along one axis and linear in time unless values are given."""
    stamps = np.asarray(stamps, dtype=np.int64)
    line = (stamps[:, None] * 1e-9 + 0.3) * np.array([1.0, -2.0, 0.5])
    return ImuSeries(
        stamps, line if force is None else force, -2.0 * line if rate is None else rate
    )


intervals = st.lists(st.integers(2 * MS, 40 * MS), min_size=2, max_size=60)
starts = st.integers(0, 60 * MS)
rates = st.sampled_from([0.0, 37.0, 60.0, 100.0, 200.0])


@given(intervals, intervals, starts, rates)
def test_both_feet_have_equal_increasing_stamps(a, b, start, rate):
    left, right = align(
        series(np.cumsum(a)), series(start + np.cumsum(b)), AlignerConfig(rate=rate, max_gap=0.05)
    )
    assert np.array_equal(left.stamp_ns, right.stamp_ns)
    assert (np.diff(left.stamp_ns) > 0).all()


@given(intervals, intervals, starts, rates, st.sampled_from(["left", "right"]))
def test_turns_about_one_axis_linear_in_time_come_out_exact(a, b, start, rate, reference):
    config = AlignerConfig(rate=rate, tolerance=0.0, reference=reference)
    aligned = align(series(np.cumsum(a)), series(start + np.cumsum(b)), config)
    for foot in aligned:
        true = series(foot.stamp_ns)
        assert np.allclose(foot.specific_force, true.specific_force, rtol=0, atol=1e-9)
        assert np.allclose(foot.angular_rate, true.angular_rate, rtol=0, atol=1e-9)


@given(
    st.lists(st.integers(2 * MS, 200 * MS), min_size=2, max_size=60),
    st.lists(st.integers(2 * MS, 200 * MS), min_size=2, max_size=60),
    rates,
)
def test_no_pair_is_invented_inside_a_gap(a, b, rate):
    left, right = series(np.cumsum(a)), series(np.cumsum(b))
    config = AlignerConfig(rate=rate, max_gap=0.05)
    grid = align(left, right, config)[0].stamp_ns
    for foot in (left, right):
        holes = np.flatnonzero(np.diff(foot.stamp_ns) > config.max_gap_ns)
        for low, high in zip(foot.stamp_ns[holes], foot.stamp_ns[holes + 1], strict=True):
            inside = (grid > low + config.tolerance_ns) & (grid < high - config.tolerance_ns)
            assert not inside.any()


@given(intervals, rates)
def test_nothing_lies_outside_the_time_both_feet_were_on(a, rate):
    left = series(np.cumsum(a))
    right = left[len(left) // 3 : -1] if len(left) > 4 else left
    grid = align(left, right, AlignerConfig(rate=rate))[0].stamp_ns
    assert (grid >= right.stamp_ns[0]).all()
    assert (grid <= right.stamp_ns[-1] + 1000).all()


def test_feet_that_share_their_stamps_pass_through_unchanged():
    rng = np.random.default_rng(0)
    stamps = np.cumsum(rng.integers(4 * MS, 6 * MS, 500))
    values = rng.normal(size=(4, 500, 3))
    left = ImuSeries(stamps, values[0], values[1])
    right = ImuSeries(stamps + rng.integers(-900, 900, 500), values[2], values[3])
    aligned_left, aligned_right, report = align_with_report(left, right)
    assert report.shared_stamps
    assert np.array_equal(aligned_left.stamp_ns, stamps)
    assert np.array_equal(aligned_right.specific_force, values[2])
    assert np.array_equal(aligned_right.angular_rate, values[3])


@pytest.mark.parametrize("reference", ["left", "right"])
def test_the_samples_of_the_reference_foot_are_not_touched(reference):
    rng = np.random.default_rng(1)
    feet = {
        "left": series(np.arange(100) * 16_667_000, rng.normal(size=(100, 3))),
        "right": series(np.arange(100) * 16_667_000 + 8 * MS, rng.normal(size=(100, 3))),
    }
    left, right = align(feet["left"], feet["right"], AlignerConfig(reference=reference))
    kept = {"left": left, "right": right}[reference]
    shared = np.isin(feet[reference].stamp_ns, kept.stamp_ns)
    assert shared.sum() == 99
    assert np.array_equal(kept.specific_force, feet[reference].specific_force[shared])


def test_a_uniform_grid_has_the_rate_asked_for_and_starts_where_both_feet_are_on():
    left = series(np.arange(400) * 5 * MS)
    right = series(13 * MS + np.arange(400) * 5_010_000)
    grid = align(left, right, AlignerConfig(rate=60.0))[0].stamp_ns
    assert grid[0] == 13 * MS
    assert np.array_equal(grid, 13 * MS + np.rint(np.arange(len(grid)) * 1e9 / 60).astype(int))


def test_duplicates_disorder_and_values_that_are_not_finite_are_counted_and_left_out():
    stamps = np.arange(50) * 10 * MS
    stamps[10] = stamps[9]
    stamps[20] = stamps[17]
    left = series(stamps)
    left.angular_rate[30, 1] = np.nan
    left.specific_force[31, 0] = np.inf
    _, _, report = align_with_report(left, series(np.arange(50) * 10 * MS))
    counters = report.counters
    assert counters["left_duplicate"] == 1
    assert counters["left_out_of_order"] == 1
    assert counters["left_not_finite"] == 2
    assert counters["left_accepted"] == 46
    assert counters["right_accepted"] == 50


@given(intervals, intervals, starts)
def test_held_values_are_those_of_the_last_sample_before(a, b, start):
    left, right = series(np.cumsum(a)), series(start + np.cumsum(b))
    held = align(left, right, AlignerConfig(between="hold", tolerance=0.0))[1]
    last = np.searchsorted(right.stamp_ns, held.stamp_ns, side="right") - 1
    assert np.array_equal(held.specific_force, right.specific_force[last])
    assert np.array_equal(held.angular_rate, right.angular_rate[last])


def test_a_gap_is_counted_and_its_stamps_are_dropped():
    left = series(np.arange(100) * 10 * MS)
    right = left[np.r_[0:40, 60:100]]
    aligned, _, report = align_with_report(left, right)
    assert report.counters["right_gap"] == 1
    assert report.counters["in_gap"] == 20
    assert len(aligned) == 80


def test_a_foot_that_starts_again_in_the_past_is_refused_with_a_sentence():
    stamps = np.concatenate([np.arange(200), np.arange(100)]) * 10 * MS
    with pytest.raises(TimingError, match=r"right foot jump back .*sample 219"):
        align(series(np.arange(300) * 10 * MS), series(stamps))


def test_feet_never_on_at_the_same_time_give_empty_series_and_a_negative_overlap():
    left, right, report = align_with_report(
        series(np.arange(50) * 10 * MS), series(np.arange(50) * 10 * MS + 10**12)
    )
    assert len(left) == len(right) == 0
    assert report.overlap_s < -990
    assert not report.shared_stamps


@pytest.mark.parametrize("rate", [0.0, 100.0])
def test_an_empty_foot_gives_empty_series(rate):
    left, right, _ = align_with_report(series([]), series([1, 2 * MS]), AlignerConfig(rate=rate))
    assert len(left) == len(right) == 0


def test_the_magnetic_field_is_interpolated_with_the_rest():
    stamps = np.arange(20) * 10 * MS
    field = np.outer(stamps * 1e-9, [1e-6, 2e-6, 3e-6])
    left = ImuSeries(stamps, field, field, field)
    shifted = stamps + 5 * MS
    field = np.outer(shifted * 1e-9, [1e-6, 2e-6, 3e-6])
    _, right = align(left, ImuSeries(shifted, field, field, field))
    expected = np.outer(right.stamp_ns * 1e-9, [1e-6, 2e-6, 3e-6])
    assert np.allclose(right.magnetic_field, expected, rtol=0, atol=1e-18)


def test_a_delay_shorter_than_the_gap_is_refused_by_name():
    with pytest.raises(ConfigError, match=r"'max_delay' is 0.02; allowed is at least 'max_gap'"):
        AlignerConfig(max_gap=0.05, max_delay=0.02)
