"""The connection events of a link are found, followed, lost and found again."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing.clock.connection_events import ConnectionEvents

RATE = 100.0


def feed(events, link, duration=30.0, start=0.0, seed=0):
    """Feed samples over a link; return the notifications that came out, with their events."""
    sampled = np.round((start + np.arange(int(duration * RATE)) / RATE) * 1e9).astype(np.int64)
    arrived = arrivals(link, sampled, np.random.default_rng(seed))
    out = []
    for time_ns, arrival_ns in zip(sampled.tolist(), arrived.tolist(), strict=True):
        out += events.add(1e-9 * time_ns, 1e-9 * arrival_ns)
    return out


def off_lattice(times, interval):
    """Return how far times are from a lattice of that interval, at its best phase; s."""
    turn = np.angle(np.exp(2j * np.pi * np.asarray(times) / interval).mean()) / (2.0 * np.pi)
    phase = np.asarray(times) / interval - turn
    return (phase - np.round(phase)) * interval


@pytest.mark.parametrize("interval", [0.0163, 0.0224, 0.0375, 0.0451])
def test_events_lie_on_one_lattice_though_arrivals_do_not(interval):
    link = BleLinkConfig(interval=interval)
    events = ConnectionEvents(0.5, 240)
    found = feed(events, link)
    assert events.interval_s == pytest.approx(interval, rel=2e-5)
    assert len(found) >= 290  # of 300 notifications; the first ones are made up for
    assert np.abs(off_lattice([f.arrival_s for f in found], interval)).max() < 0.0006
    waits = np.array([f.arrival_s - f.time_s for f in found]) - link.least
    assert waits.min() > -0.001  # no event before the sample was taken


def test_samples_of_a_notification_may_be_read_one_after_the_other():
    """A host that hands over ten datagrams takes its time for each."""
    link, rng = BleLinkConfig(interval=0.0375), np.random.default_rng(2)
    sampled = np.round(np.arange(3000) * 1e9 / RATE).astype(np.int64)
    arrived = arrivals(link, sampled, np.random.default_rng(1)) * 1e-9
    arrived += 0.0003 * (np.arange(3000) % link.burst) + rng.uniform(0.0, 1e-4, 3000)
    events = ConnectionEvents(0.5, 240)
    for time, each in zip((1e-9 * sampled).tolist(), arrived.tolist(), strict=True):
        events.add(time, each)
    assert events.interval_s == pytest.approx(0.0375, rel=1e-4)


def test_nothing_comes_out_of_a_link_without_events():
    events = ConnectionEvents(0.5, 240)
    rng = np.random.default_rng(0)
    out = []
    for time in (0.05 * np.arange(2000)).tolist():
        out += events.add(time, time + float(rng.exponential(0.004)))
    assert out == []
    assert events.interval_s is None


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10_000), slip=st.floats(0.0, 0.0006))
def test_times_between_arrivals_that_are_multiples_need_be_no_events(seed, slip):
    """A host that begins its period anew with every arrival: where the lattice is, slips."""
    events, rng = ConnectionEvents(0.5, 240), np.random.default_rng(seed)
    arrived = np.cumsum(0.02 * rng.integers(1, 4, 400) + rng.uniform(-slip, slip, 400) + slip / 2)
    for k, each in enumerate(arrived.tolist()):
        for found in events.add(0.1 * k, each):
            assert found.arrival_s <= each + 0.02


def test_events_that_jump_by_half_an_interval_in_the_middle_are_found_after_that():
    events, interval = ConnectionEvents(0.5, 240), 0.03
    number = np.cumsum(np.random.default_rng(0).integers(2, 5, 300))
    arrived = interval * (number + 0.5 * (number > number[31]))
    for k, each in enumerate(arrived.tolist()):
        events.add(0.11 * k, each)
    assert events.interval_s == pytest.approx(interval, rel=1e-6)


def test_an_interval_that_changes_is_lost_and_the_new_one_found():
    events = ConnectionEvents(0.5, 240)
    feed(events, BleLinkConfig(interval=0.0451))
    assert events.interval_s == pytest.approx(0.0451, rel=1e-4)
    feed(events, BleLinkConfig(interval=0.0183), start=30.0, duration=40.0)
    assert events.interval_s == pytest.approx(0.0183, rel=1e-4)


def test_memory_does_not_grow():
    events = ConnectionEvents(0.5, 20)
    feed(events, BleLinkConfig(), 60.0)
    tracemalloc.start()
    feed(events, BleLinkConfig(), 60.0, start=60.0)
    before = tracemalloc.get_traced_memory()[0]
    feed(events, BleLinkConfig(), 120.0, start=120.0)
    after = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert after - before < 20_000


@settings(max_examples=40, deadline=None)
@given(
    wild=st.lists(st.tuples(st.floats(-1e9, 1e9), st.floats(-1e9, 1e9)), max_size=60),
    seed=st.integers(0, 100),
)
def test_no_times_raise(wild, seed):
    events = ConnectionEvents(0.5, 20)
    feed(events, BleLinkConfig(), 12.0, seed=seed)
    for time, arrived in wild:
        for found in events.add(time, arrived):
            assert np.isfinite(found.arrival_s)
