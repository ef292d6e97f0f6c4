"""Sensor errors do what their parameters say."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import ConfigError
from dualfoot_ros.simulation import GRADES, SensorConfig, SimulationError, grade
from dualfoot_ros.simulation.sensors import SensorErrors, draw_pair, measure

STILL = np.array([0.0, 0.0, 9.8])


def rng(seed=0):
    return np.random.Generator(np.random.PCG64(seed))


def only(**sizes):
    zero = {s.name: 0.0 for s in SensorConfig.specs() if s.minimum == 0.0}
    return SensorConfig.from_mapping({**zero, **sizes})


def sensed(config, count=200_000, rate_hz=100.0, force=STILL, rate=(0.0, 0.0, 0.0), seed=0):
    time_s = np.arange(1, count + 1) / rate_hz
    errors = SensorErrors.draw(config, rng(seed))
    force, rate = np.tile(force, (count, 1)), np.tile(rate, (count, 1))
    return measure(config, errors, time_s, force, rate, rng(seed + 1)), errors


def test_the_ideal_sensor_returns_the_truth_to_the_bit():
    (force, rate), _ = sensed(grade("ideal"), count=100, rate=(0.1, -2.0, 3.0))
    assert np.all(force == STILL)
    assert np.all(rate == [0.1, -2.0, 3.0])


@pytest.mark.parametrize("rate_hz", [60.0, 400.0])
def test_white_noise_has_the_stated_density_at_any_rate(rate_hz):
    (force, rate), _ = sensed(only(gyro_noise=1e-3, accelerometer_noise=1e-2), rate_hz=rate_hz)
    np.testing.assert_allclose(rate.std(axis=0), 1e-3 * np.sqrt(rate_hz), rtol=0.02)
    np.testing.assert_allclose(force.std(axis=0), 1e-2 * np.sqrt(rate_hz), rtol=0.02)


def test_bias_instability_has_the_stated_deviation_and_correlation_time():
    (_, rate), _ = sensed(
        only(gyro_instability=1e-3, instability_time=5.0), count=400_000, rate_hz=20.0
    )
    np.testing.assert_allclose(rate.std(axis=0), 1e-3, rtol=0.1)
    lag = 100  # one correlation time
    together = np.mean(rate[lag:] * rate[:-lag]) / np.mean(rate**2)
    assert together == pytest.approx(np.exp(-1.0), abs=0.06)


def test_the_warm_up_drift_dies_away_with_its_time_constant():
    config = only(gyro_warm_up=1e-2, warm_up_time=10.0)
    (_, rate), errors = sensed(config, count=10_000)
    np.testing.assert_allclose(rate[999], errors.rate_warm_up * np.exp(-1.0))
    np.testing.assert_allclose(rate[-1], 0.0, atol=1e-5)


def test_scale_and_misalignment_multiply_and_g_sensitivity_adds_rate():
    config = only(gyro_scale=0.01, gyro_misalignment=0.01, g_sensitivity=1e-3)
    (_, rate), errors = sensed(config, count=3, rate=(1.0, 2.0, 3.0))
    expected = (np.eye(3) + errors.rate_matrix) @ [1.0, 2.0, 3.0] + errors.g_matrix @ STILL
    np.testing.assert_allclose(rate[0], expected)


def test_a_range_clips_and_a_resolution_rounds():
    config = only(gyro_range=2.0, gyro_resolution=0.1)
    (_, rate), _ = sensed(config, count=1, rate=(5.0, -3.0, 0.58))
    np.testing.assert_allclose(rate[0], [2.0, -2.0, 0.6])


@given(st.integers(0, 10_000))
def test_mirrored_sensors_answer_to_mirrored_motion_with_mirrored_output(seed):
    config = SensorConfig(errors="mirrored", gyro_noise=0.0, accelerometer_noise=0.0)
    left, right = draw_pair(config, (rng(seed), rng(seed + 1)))
    quiet = only(gyro_scale=0.01, gyro_bias=0.1, accelerometer_bias=0.1, g_sensitivity=1e-3)
    polar, axial = np.array([1.0, -1.0, 1.0]), np.array([-1.0, 1.0, -1.0])
    force, rate = rng(seed + 2).standard_normal((2, 5, 3))
    time_s = np.arange(1.0, 6.0)
    one = measure(quiet, left, time_s, force, rate, rng())
    other = measure(quiet, right, time_s, force * polar, rate * axial, rng())
    np.testing.assert_allclose(other[0], one[0] * polar, atol=1e-12)
    np.testing.assert_allclose(other[1], one[1] * axial, atol=1e-12)


@given(st.integers(0, 10_000))
def test_mirroring_twice_is_no_change(seed):
    errors = SensorErrors.draw(SensorConfig(), rng(seed))
    twice = errors.mirrored().mirrored()
    for name, value in vars(errors).items():
        np.testing.assert_array_equal(getattr(twice, name), value)


def test_independent_sensors_have_nothing_in_common():
    pairs = [draw_pair(SensorConfig(), (rng(k), rng(1000 + k))) for k in range(400)]
    left = np.array([a.rate_bias for a, _ in pairs]).ravel()
    right = np.array([b.rate_bias for _, b in pairs]).ravel()
    assert abs(np.corrcoef(left, right)[0, 1]) < 0.1
    assert left.std() == pytest.approx(SensorConfig().gyro_bias, rel=0.1)


def test_a_better_grade_has_no_larger_error():
    grades = [grade(name) for name in ("ideal", "good", "consumer")]
    names = [s.name for s in SensorConfig.specs() if s.minimum == 0.0 and "range" not in s.name]
    for name in names:
        sizes = [getattr(g, name) for g in grades]
        assert sizes == sorted(sizes), name


def test_an_unknown_grade_is_refused_with_the_known_ones():
    with pytest.raises(
        SimulationError, match="grade is 'best'; allowed is one of " + ", ".join(GRADES)
    ):
        grade("best")


def test_a_negative_noise_is_refused_with_its_name():
    with pytest.raises(ConfigError, match="gyro_noise"):
        SensorConfig(gyro_noise=-1.0)
