"""No sample is stamped before its clock is known, and none by a clock that is refused."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.simulation.arrivals import BleLinkConfig
from dualfoot_ros.timing import DeviceClock, DeviceClockConfig

from .test_device_clock import START, errors_ms, follow, recording

drifts = st.floats(-300.0, 300.0)
seeds = st.integers(0, 10_000)
RATE = 100.0


def begin(found):
    """Return the number of the first sample that was stamped."""
    return next(k for k, f in enumerate(found) if f is not None)


def bursts(seed):
    """Return a Bluetooth link of a random interval."""
    rng = np.random.default_rng(seed)
    return BleLinkConfig(interval=float(rng.uniform(0.015, 0.05)), burst=int(rng.integers(1, 13)))


@cache
def first_seconds():
    """Return the Bluetooth links, and the errors in ms of the first second stamped over each."""
    drifts_ppm = np.linspace(-300.0, 300.0, 40)
    links = [bursts(seed) for seed in range(len(drifts_ppm))]
    return links, [
        first_second_ms(drift, link, seed)
        for seed, (drift, link) in enumerate(zip(drifts_ppm, links, strict=True))
    ]


def first_second_ms(drift, link, seed):
    """Return the errors of the first second that is stamped."""
    true, device, arrived = recording(drift, 900.0, RATE, 12.0, link, seed)
    clock, found = DeviceClock(), []
    while len(found) < 2 * round(RATE) or found[-2 * round(RATE)] is None:
        more = slice(len(found), len(found) + round(RATE))
        assert more.start < len(true)
        found += follow(clock, device[more], arrived[more])
    first = begin(found)
    assert None not in found[first:]
    return errors_ms(found, true[: len(found)], link)[first : first + round(RATE)]


def test_the_first_stamps_over_bluetooth_are_late_by_an_interval_at_most_and_hardly_ever_early():
    early, late = [], []
    for link, error in zip(*first_seconds(), strict=True):
        early.append(-error.min())
        late.append(error.max() - 1e3 * link.interval)  # a link that never was fast so far
    assert max(late) < 0.0
    assert np.quantile(early, 0.95) < 4.0
    assert max(early) < 20.0


def test_the_first_second_over_bluetooth_is_right_to_a_few_milliseconds_on_most_links():
    worst = [np.abs(error).max() for error in first_seconds()[1]]
    assert np.median(worst) < 3.0  # 90 and more with stamps from the first sample on
    assert np.quantile(worst, 0.9) < 12.0


@settings(max_examples=12, deadline=None)
@given(drift=drifts, jitter=st.floats(0.0, 0.002), seed=seeds)
def test_a_wired_link_loses_less_than_three_seconds_and_starts_right(drift, jitter, seed):
    true, device, _ = recording(drift, duration=6.0, rate=RATE)
    delay = np.random.default_rng(seed).exponential(1e9 * jitter + 1.0, len(true))
    arrived = np.maximum.accumulate(true + np.round(delay).astype(np.int64))
    found = follow(DeviceClock(), device, arrived)
    first = begin(found)
    error = errors_ms(found, true, BleLinkConfig(least=0.0))[first:]
    assert 1.0 <= first / RATE <= 3.0
    assert np.abs(error).max() < 5.0


@settings(max_examples=6, deadline=None)
@given(drift=drifts, seed=seeds)
def test_a_bad_link_is_not_waited_for_for_ever(drift, seed):
    link = BleLinkConfig(burst=20, failure=0.3, stall_period=1.0)
    _, device, arrived = recording(drift, duration=15.0, link=link, seed=seed)
    clock = DeviceClock()
    found = follow(clock, device, arrived)
    assert 3.0 < begin(found) / RATE < 12.0
    assert clock.state.phase in ("acquiring", "tracking")


@settings(max_examples=10, deadline=None)
@given(
    drift=st.floats(12_000.0, 60_000.0),
    sign=st.sampled_from([-1.0, 1.0]),
    burst=st.sampled_from([0, 1, 10]),
    seed=seeds,
)
def test_a_clock_that_is_refused_never_stamps_a_sample(drift, sign, burst, seed):
    link = BleLinkConfig(interval=0.0371, burst=max(burst, 1))
    true, device, arrived = recording(sign * drift, 70.0, duration=10.0, link=link, seed=seed)
    clock = DeviceClock()
    found = follow(clock, device, arrived if burst else true + 1_000_000)
    assert set(found) == {None}
    assert clock.state.phase in ("settling", "refused")


@pytest.mark.parametrize("rate", [1e-3, 0.25, 4.0, 1e3])
def test_stamps_in_another_unit_are_never_taken(rate):
    true = START + np.arange(700) * 10_000_000
    clock = DeviceClock()
    assert set(follow(clock, np.round((true - START) * rate), true)) == {None}
    assert clock.state.phase in ("settling", "refused")


def test_the_limit_on_the_skew_decides_what_is_stamped():
    true, device, _ = recording(5000.0, duration=8.0)
    assert follow(DeviceClock(), device, true)[-1] is not None
    assert set(follow(DeviceClock(DeviceClockConfig(max_skew=3000.0)), device, true)) == {None}


def test_after_a_restart_in_a_walk_stamps_go_on_with_the_first_samples_of_the_new_epoch():
    true, device, arrived = recording(50.0, duration=30.0)
    device = device.copy()
    device[2000:] -= int(device[2000]) - 5_000_000
    clock = DeviceClock()
    found = follow(clock, device, arrived)
    assert clock.epoch == 1
    assert begin(found) < 700
    assert found[2000:].count(None) <= 30  # three bursts make a restart
    assert clock.counters["settling"] == begin(found)
    assert np.abs(errors_ms(found, true)[2600:]).max() < 25.0


def test_a_restart_before_the_clock_is_known_begins_the_settling_anew():
    _, device, arrived = recording(50.0, duration=12.0)
    device = device.copy()
    device[150:] -= int(device[150]) - 5_000_000
    clock = DeviceClock()
    found = follow(clock, device, arrived)
    assert clock.counters["restarts"] == 1
    assert begin(found) > 150 + 150


def test_how_long_a_clock_is_learnt_is_told_by_the_host_s_clock():
    clock = DeviceClock()
    assert clock.state.phase == "empty" and clock.state.age_s == 0.0
    for k in range(100):
        assert clock.update(k * 10_000, START + k * 10_000_000) is None  # a wrong unit
    assert clock.state.phase == "settling"
    assert clock.state.age_s == pytest.approx(0.99)


def test_an_offset_that_is_asked_for_too_exactly_is_waited_for_as_long_as_settle_says():
    true, device, _ = recording(30.0, duration=8.0)
    begins = {}
    for settle in (2.0, 4.0, 6.0):
        clock = DeviceClock(DeviceClockConfig(tracking_std=1e-6, settle=settle))
        begins[settle] = begin(follow(clock, device, true)) / RATE
    for settle, found in begins.items():
        assert settle <= found <= settle + 1.0


def test_stamping_begins_the_sooner_the_less_exact_the_offset_need_be():
    _, device, arrived = recording(30.0, duration=12.0, link=BleLinkConfig(burst=10))
    begins = [
        begin(
            follow(DeviceClock(DeviceClockConfig(tracking_std=std, settle=9.0)), device, arrived)
        )
        for std in (0.05, 0.005, 0.0005)
    ]
    assert begins == sorted(begins) and begins[0] < begins[-1]
