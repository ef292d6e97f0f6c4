"""Each device samples, stamps, loses and delivers by its own clock."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.simulation import ClockConfig, WalkConfig, grade, simulate
from dualfoot_ros.simulation.clocks import sample_times


def times(config, rate=100.0, duration=100.0, seed=0):
    return sample_times(config, rate, duration, 0, np.random.Generator(np.random.PCG64(seed)))


def test_a_perfect_clock_stamps_the_true_end_of_each_interval():
    found = times(ClockConfig())
    np.testing.assert_array_equal(found.stamp_ns, found.true_ns(0))
    np.testing.assert_array_equal(found.stamp_ns, np.arange(1, 10_001) * 10_000_000)
    np.testing.assert_array_equal(found.arrival_ns, found.stamp_ns)
    assert found.kept.all()


@given(
    offset=st.floats(-3600.0, 3600.0),
    drift=st.floats(-2000.0, 2000.0),
    phase=st.floats(0.0, 0.999),
)
def test_offset_and_drift_are_those_of_the_straight_line_through_the_stamps(offset, drift, phase):
    found = times(ClockConfig(offset=offset, drift=drift, phase=phase))
    true, device = found.edges_s[1:], found.stamp_ns * 1e-9
    slope, start = np.polyfit(true, device - true, 1)
    assert slope * 1e6 == pytest.approx(drift, abs=1e-2)
    assert start == pytest.approx(offset, abs=1e-5)
    np.testing.assert_allclose(np.diff(found.stamp_ns), 10_000_000, atol=1)


def test_jitter_scatters_the_stamps_and_nothing_else():
    found = times(ClockConfig(jitter=1e-3))
    assert np.std(found.stamp_ns * 1e-9 - found.edges_s[1:]) == pytest.approx(1e-3, rel=0.05)
    np.testing.assert_allclose(np.diff(found.edges_s), 0.01)


@pytest.mark.parametrize("burst", [1.0, 10.0])
def test_the_share_of_lost_samples_is_as_stated(burst):
    found = times(ClockConfig(drops=0.1, drop_burst=burst), duration=3000.0)
    assert 1.0 - found.kept.mean() == pytest.approx(0.1, rel=0.15)


@settings(max_examples=30)
@given(delay=st.floats(0.0, 0.1), tail=st.floats(0.0, 0.1), interval=st.sampled_from([0.0, 0.03]))
def test_a_sample_never_arrives_before_it_was_taken_nor_before_its_forerunner(
    delay, tail, interval
):
    config = ClockConfig(delay=delay, delay_tail=tail, connection_interval=interval)
    found = times(config, duration=5.0)
    assert np.all(found.arrival_ns - found.true_ns(0) >= delay * 1e9 - 2)
    assert np.all(np.diff(found.arrival_ns) >= 0)


def test_with_a_connection_interval_samples_arrive_in_bursts():
    found = times(ClockConfig(connection_interval=0.05))
    assert len(np.unique(found.arrival_ns)) == pytest.approx(10_000 / 5, abs=2)


def test_lost_samples_are_missing_in_the_recording_and_present_in_the_truth():
    config = WalkConfig(route="L", rate=60.0)
    lossy = simulate(config, grade("ideal"), ClockConfig(drops=0.2), seed=1)
    whole = simulate(config, grade("ideal"), ClockConfig(), seed=1)
    assert len(lossy.left_truth) == len(whole.left)
    assert 0.7 < len(lossy.left) / len(whole.left) < 0.9
    at = np.searchsorted(whole.left.stamp_ns, lossy.left.stamp_ns)
    np.testing.assert_array_equal(lossy.left.specific_force, whole.left.specific_force[at])


def test_two_clocks_may_differ():
    config = WalkConfig(route="standing", rate=60.0)
    clocks = (ClockConfig(offset=3.0), ClockConfig(offset=-2.0, drift=50.0))
    simulation = simulate(config, grade("good"), clocks, seed=1)
    apart = simulation.left.stamp_ns[0] - simulation.right.stamp_ns[0]
    assert apart == pytest.approx(5_000_000_000, abs=100_000)
