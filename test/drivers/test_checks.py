"""What is recognised in the samples of a sensor: rate, range, clipping, being stuck."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.drivers import CheckConfig, Sample, SensorCheck, SensorFault
from dualfoot_ros.drivers.checks import AXES


def walk(count, *, interval_us=5000, bits=32, start_us=0, seed=1):
    noise = random.Random(seed)
    for k in range(count):
        force = (noise.gauss(0, 1), noise.gauss(0, 1), noise.gauss(9.8, 1))
        rate = (noise.gauss(0, 1), noise.gauss(0, 1), noise.gauss(0, 1))
        ticks = (start_us + k * interval_us) % (1 << bits)
        yield Sample(k, force, rate, ticks, 1000, bits)


def checked(samples, **options):
    check = SensorCheck(CheckConfig(**options))
    for sample in samples:
        check.accept(sample)
    return check


def test_an_ordinary_walk_raises_no_finding():
    check = checked(walk(2000), rate=200.0, force_range=160.0, rate_range=35.0)
    assert check.findings == []
    assert check.rate_hz == pytest.approx(200.0)


@given(st.sampled_from([16, 32]), st.integers(0, (1 << 32) - 1))
def test_the_rate_does_not_care_where_the_counter_wraps(bits, start_us):
    samples = walk(300, bits=bits, start_us=start_us)
    assert checked(samples).rate_hz == pytest.approx(200.0)


def test_a_wrong_rate_is_said_with_both_figures():
    (finding,) = checked(walk(500, interval_us=16667), rate=200.0).findings
    assert finding.kind is SensorFault.WRONG_RATE
    assert "60.0" in finding.text and "200" in finding.text


def test_lost_samples_do_not_change_the_rate():
    kept = [s for k, s in enumerate(walk(1000)) if k % 7]
    assert checked(kept).rate_hz == pytest.approx(200.0)


def test_without_device_time_the_rate_is_that_of_the_arrivals():
    samples = [s._replace(ticks=None, arrival_ns=k * 10_000_000) for k, s in enumerate(walk(300))]
    assert checked(samples).rate_hz == pytest.approx(100.0)


def test_readings_at_the_end_of_the_range_are_counted_as_clipped():
    samples = [s._replace(specific_force=(0.0, 156.9, 0.0)) for s in walk(5)]
    check = checked([*walk(20), *samples], force_range=156.9)
    assert check.counters["clipped_force"] == 5
    (finding,) = check.findings
    assert finding.kind is SensorFault.CLIPPED_FORCE and "accelerometer" in str(finding)


def test_what_no_sensor_of_that_range_reads_is_refused():
    check = SensorCheck(CheckConfig(force_range=160.0, rate_range=35.0))
    (good,) = walk(1)
    assert check.accept(good)
    assert not check.accept(good._replace(specific_force=(1e30, 0.0, 0.0)))
    assert not check.accept(good._replace(angular_rate=(0.0, -60.0, 0.0)))
    assert check.counters["out_of_range"] == 2


def test_a_frozen_sensor_is_recognised_and_forgotten_when_it_thaws():
    (frozen,) = walk(1)
    check = checked([*walk(100), *[frozen] * 60], stuck_after=50)
    assert check.stuck == AXES
    assert [finding.kind for finding in check.findings] == [SensorFault.STUCK_SENSOR]
    check.accept(next(walk(1, seed=2)))
    assert check.stuck == ()


def test_one_axis_that_never_moves_is_named():
    samples = [
        s._replace(angular_rate=(s.angular_rate[0], 0.0, s.angular_rate[2])) for s in walk(300)
    ]
    check = checked(samples, stuck_axis_after=250)
    assert check.stuck == ("angular rate y",)
    (finding,) = check.findings
    assert finding.kind is SensorFault.STUCK_AXIS and "angular rate y" in finding.text


def test_a_sensor_at_rest_with_coarse_steps_is_not_called_stuck():
    noise = random.Random(3)
    samples = [
        s._replace(specific_force=(0.0, 0.0, 9.8 + 0.005 * noise.choice((-1, 0, 0, 0, 1))))
        for s in walk(200)
    ]
    assert checked(samples, stuck_axis_after=250).stuck == ()
