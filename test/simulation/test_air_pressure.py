"""Simulated barometers: the pressure is that of the true height, and wrong as real ones are."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.aids import pressure_height
from dualfoot_ros.simulation import BarometerConfig, ClockConfig, WalkConfig, simulate, walk
from dualfoot_ros.simulation.air_pressure import air_pressure, barometers

QUIET = BarometerConfig(noise=0.0, offset=0.0, drift=0.0, temperature=15.0, altitude=0.0)


@pytest.fixture(scope="module")
def stairs():
    """Return a walk up two flights and down one."""
    return walk(WalkConfig(route="stairs", rate=60.0, standing=2.0), seed=2)


def pressure(walked, config, seed):
    """Return what the barometer of the left foot puts out, without the sensors beside it."""
    clocks = ClockConfig(), ClockConfig()
    rngs = tuple(np.random.default_rng([seed, foot]) for foot in range(2))
    return barometers(walked, config, clocks, 10**18, rngs)["left"]


def heights(series):
    return np.array([pressure_height(p) for p in series.pressure.tolist()])


def test_without_a_barometer_there_is_no_pressure(stairs):
    assert simulate(stairs, seed=2).pressure == {}


def test_a_perfect_barometer_tells_the_true_height_of_its_foot(stairs):
    made = simulate(stairs, seed=2, barometer=QUIET)
    assert set(made.pressure) == {"left", "right"}
    for foot, worn in enumerate(made.pressure):
        series = made.pressure[worn]
        time_s = (series.stamp_ns - made.left.stamp_ns[0]) * 1e-9 + 1.0 / 60.0
        truth = stairs.truth(foot, time_s, series.stamp_ns).position[:, 2]
        np.testing.assert_allclose(heights(series), truth, atol=1e-6)
        assert truth.max() - truth.min() > 3.0


def test_one_on_the_body_tells_the_mean_of_the_feet(stairs):
    feet = simulate(stairs, seed=2, barometer=QUIET).pressure
    body = simulate(stairs, seed=2, barometer=replace(QUIET, worn="body")).pressure
    assert set(body) == {"both"}
    mean = 0.5 * (heights(feet["left"]) + heights(feet["right"]))
    np.testing.assert_allclose(heights(body["both"]), mean, atol=1e-6)


def test_a_barometer_changes_nothing_else(stairs):
    one, other = simulate(stairs, seed=2), simulate(stairs, seed=2, barometer=BarometerConfig())
    assert one.left.specific_force.tobytes() == other.left.specific_force.tobytes()
    assert one.right.angular_rate.tobytes() == other.right.angular_rate.tobytes()


def test_the_same_seed_gives_the_same_pressure_and_another_foot_another():
    standing = walk(WalkConfig(route="standing", rate=60.0))
    one, two = (simulate(standing, seed=4, barometer=BarometerConfig()).pressure for _ in "ab")
    assert one["left"].pressure.tobytes() == two["left"].pressure.tobytes()
    assert one["left"].pressure.tobytes() != one["right"].pressure.tobytes()


def test_a_foots_barometer_has_the_clock_of_its_foot_and_the_bodys_the_true_one(stairs):
    clocks = ClockConfig(offset=3.0), ClockConfig(offset=-2.0, drops=0.2)
    feet = simulate(stairs, clock=clocks, seed=2, barometer=BarometerConfig()).pressure
    body = simulate(stairs, clock=clocks, seed=2, barometer=BarometerConfig(worn="body")).pressure
    apart = feet["left"].stamp_ns[0] - feet["right"].stamp_ns[0]
    assert apart == pytest.approx(5e9, abs=2e8)
    assert feet["left"].stamp_ns[0] - body["both"].stamp_ns[0] == 3_000_000_000
    assert len(feet["right"]) < 0.9 * len(feet["left"])


@pytest.mark.parametrize("rate", [10.0, 25.0, 100.0])
def test_noise_offset_and_drift_have_the_sizes_that_were_asked_for(rate):
    standing = walk(WalkConfig(route="standing", rate=60.0, standing=400.0))
    series = pressure(standing, replace(QUIET, rate=rate, noise=3.0), seed=1)
    assert len(series) == pytest.approx(rate * standing.duration_s, abs=1)
    assert series.pressure.std() == pytest.approx(3.0, rel=0.08)
    drifting = replace(QUIET, rate=rate, drift=10.0, drift_time=5.0)
    slow = pressure(standing, drifting, seed=1).pressure
    assert slow.std() == pytest.approx(10.0, rel=0.3)
    assert np.diff(slow).std() == pytest.approx(10.0 * np.sqrt(2.0 / (5.0 * rate)), rel=0.1)
    shifted = replace(QUIET, rate=rate, offset=50.0)
    means = [pressure(standing, shifted, seed).pressure.mean() for seed in range(6)]
    assert 15.0 < np.std(means) < 120.0


@given(st.floats(-40.0, 50.0), st.floats(0.0, 100.0))
@settings(max_examples=50)
def test_warm_air_makes_a_climb_look_smaller_by_the_ratio_of_the_temperatures(celsius, climb):
    config = replace(QUIET, temperature=celsius)
    low, high = (pressure_height(p) for p in air_pressure(config, np.array([0.0, climb])))
    assert (high - low) * (273.15 + celsius) / 288.15 == pytest.approx(climb, abs=1e-6)
