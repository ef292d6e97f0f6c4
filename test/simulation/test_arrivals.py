"""The delays of a Bluetooth Low Energy link are what that link does."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals

QUIET = {"handling": 0.0, "failure": 0.0, "stall": 0.0, "tail_share": 0.0}


def sampled(rate=100.0, duration=60.0):
    return np.round(np.arange(int(rate * duration)) * 1e9 / rate).astype(np.int64)


def delays(link, seed=0, **how):
    stamps = sampled(**how)
    return (arrivals(link, stamps, np.random.default_rng(seed)) - stamps) * 1e-9


@settings(max_examples=50, deadline=None)
@given(
    interval=st.floats(0.0075, 0.05),
    burst=st.integers(1, 20),
    count=st.integers(0, 300),
    seed=st.integers(0, 1000),
)
def test_no_sample_arrives_before_it_was_taken_or_out_of_order(interval, burst, count, seed):
    stamps = sampled()[:count]
    link = BleLinkConfig(interval=interval, burst=burst)
    found = arrivals(link, stamps, np.random.default_rng(seed))
    assert found.shape == stamps.shape
    assert np.all(found - stamps >= link.least * 1e9)
    assert np.all(np.diff(found) >= 0)


def test_a_quiet_link_delivers_within_one_connection_interval():
    found = delays(BleLinkConfig(interval=0.0371, burst=1, least=0.004, **QUIET))
    assert found.min() == pytest.approx(0.004, abs=1e-4)
    assert found.max() == pytest.approx(0.004 + 0.0371, abs=1e-3)


def test_the_samples_of_a_notification_arrive_together():
    found = arrivals(BleLinkConfig(burst=10), sampled(), np.random.default_rng(0))
    assert np.all(np.ptp(found.reshape(-1, 10), axis=1) == 0)


def test_stalls_hold_samples_back_for_their_length():
    quiet = delays(BleLinkConfig(burst=1, **QUIET))
    stalled = delays(BleLinkConfig(burst=1, **{**QUIET, "stall": 0.1, "stall_period": 2.0}))
    assert quiet.max() < 0.04
    assert 0.1 < stalled.max() < 0.17
    assert 0.02 < np.mean(stalled > 0.04) < 0.1


def test_the_tail_is_heavy():
    found = delays(BleLinkConfig(burst=1), duration=600.0)
    assert np.quantile(found, 0.5) < 0.03
    assert found.max() > 0.3


def test_a_notification_period_that_is_a_multiple_of_the_interval_hides_the_least_delay():
    found = delays(BleLinkConfig(interval=0.05, burst=10, **QUIET), seed=3)[9::10]
    assert np.ptp(found) < 1e-6
