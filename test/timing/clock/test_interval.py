"""The interval of a link is found where there is one, and nowhere else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing.clock.interval import find_interval, own_period

NOTIFICATIONS = 65


def notifications(link, rate=100.0, seed=0):
    """Return device and arrival times (n,) of the freshest samples of notifications, s."""
    sampled = np.round(np.arange(NOTIFICATIONS * link.burst) * 1e9 / rate).astype(np.int64)
    arrived = arrivals(link, sampled, np.random.default_rng(seed))
    last = np.flatnonzero(np.append(np.diff(arrived) > 1_000_000, True))
    return 1e-9 * sampled[last], 1e-9 * arrived[last]


@pytest.mark.parametrize("burst", [5, 10, 20])
def test_the_interval_of_most_bluetooth_links_is_found_and_hardly_ever_another(burst):
    right, wrong = 0, 0
    for seed, interval in enumerate(np.linspace(0.0152, 0.047, 40)):
        link = BleLinkConfig(interval=float(interval), burst=burst)
        found = find_interval(*notifications(link, 100.0, seed))
        right += found is not None and abs(found - interval) < 1e-3 * interval
        wrong += found is not None and abs(found - interval) > 1e-3 * interval
    assert right >= 35
    assert wrong <= 2


@settings(max_examples=40, deadline=None)
@given(
    rate=st.sampled_from([60.0, 100.0, 120.0, 200.0, 208.0]),
    burst=st.integers(1, 12),
    jitter=st.floats(0.0, 0.003),
    loss=st.sampled_from([0.0, 0.02, 0.2]),
    seed=st.integers(0, 1000),
)
def test_a_device_that_keeps_the_time_itself_has_none(rate, burst, jitter, loss, seed):
    rng = np.random.default_rng(seed)
    count = NOTIFICATIONS
    time = (np.arange(count) + 1.0) * burst / rate - rng.binomial(burst - 1, loss, count) / rate
    arrived = (np.arange(count) + 1.0) * burst / rate + rng.exponential(jitter, count)
    assert find_interval(time, arrived) is None


def test_several_notifications_an_event_tell_nothing():
    """Their waits are shorter than the interval, which would be taken for something else."""
    assert find_interval(*notifications(BleLinkConfig(interval=0.0317, burst=1), 200.0)) is None


def test_a_host_that_polls_is_such_a_link_too():
    time = np.arange(1, NOTIFICATIONS + 1) * 0.05
    arrived = np.ceil((time - 0.003) / 0.016) * 0.016
    arrived += np.random.default_rng(0).exponential(0.0001, NOTIFICATIONS)
    assert find_interval(time, arrived) == pytest.approx(0.016, rel=1e-3)


def test_the_own_period_is_that_of_the_samples_when_some_are_lost():
    time = 0.1 * np.arange(30.0)
    assert own_period(time) == pytest.approx(0.1)
    time[7] -= 0.01
    assert own_period(time) == pytest.approx(0.01)
    assert own_period(np.zeros(5)) == np.inf


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)), min_size=3, max_size=NOTIFICATIONS
    )
)
def test_no_times_raise(times):
    time, arrived = np.array(times).T
    found = find_interval(time, arrived)
    assert found is None or 0.005 < found < 0.4
