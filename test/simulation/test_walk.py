"""A simulation is determined by its seed, and its parts are independent of each other."""

import numpy as np
import pytest

from dualfoot_ros.core import ConfigError
from dualfoot_ros.simulation import (
    ROUTES,
    ClockConfig,
    SensorConfig,
    SimulationError,
    WalkConfig,
    grade,
    rigid_pair,
    simulate,
    walk,
)

CONFIG = WalkConfig(route="L", rate=60.0, standing=2.0)


@pytest.mark.parametrize("route", ROUTES)
def test_every_route_gives_two_whole_recordings_with_truth(route):
    config = WalkConfig(route=route, rate=60.0, standing=2.0)
    simulation = simulate(config, seed=1)
    for foot in ("left", "right"):
        series, truth = getattr(simulation, foot), getattr(simulation, f"{foot}_truth")
        assert len(series) == len(truth) > 100
        np.testing.assert_array_equal(series.stamp_ns, truth.stamp_ns)
        assert np.all(np.isfinite(series.specific_force)) and np.all(np.isfinite(truth.position))
        np.testing.assert_allclose(np.linalg.norm(truth.quaternion, axis=1), 1.0)
        assert np.all(np.sum(truth.quaternion[1:] * truth.quaternion[:-1], axis=1) > 0.9)


def test_the_same_seed_gives_the_same_bits():
    one, other = simulate(CONFIG, seed=5), simulate(CONFIG, seed=5)
    assert one.left.specific_force.tobytes() == other.left.specific_force.tobytes()
    assert one.right.angular_rate.tobytes() == other.right.angular_rate.tobytes()
    assert one.right_truth.position.tobytes() == other.right_truth.position.tobytes()


def test_another_seed_gives_another_walk():
    one, other = simulate(CONFIG, seed=5), simulate(CONFIG, seed=6)
    assert len(one.left) != len(other.left) or np.any(
        one.left.specific_force != other.left.specific_force
    )


def test_another_sensor_or_clock_leaves_the_walk_as_it_is():
    one = simulate(CONFIG, grade("ideal"), ClockConfig(), seed=5)
    other = simulate(CONFIG, SensorConfig(), ClockConfig(jitter=1e-3, offset=2.0), seed=5)
    np.testing.assert_array_equal(one.left_truth.position, other.left_truth.position)
    np.testing.assert_array_equal(one.moment_ns, other.moment_ns)


def test_another_rate_leaves_the_walk_as_it_is():
    one = simulate(WalkConfig(route="L", rate=100.0), grade("ideal"), seed=5)
    other = simulate(WalkConfig(route="L", rate=200.0), grade("ideal"), seed=5)
    np.testing.assert_allclose(
        one.left_truth.position, other.left_truth.position[1::2], atol=1e-12
    )


def test_a_walk_made_once_can_be_sensed_many_times():
    walked = walk(CONFIG, seed=5)
    one, other = simulate(walked, seed=1), simulate(walked, seed=2)
    np.testing.assert_array_equal(one.left_truth.position, other.left_truth.position)
    assert np.any(one.left_errors.rate_bias != other.left_errors.rate_bias)


def test_two_sensors_on_one_shoe_keep_their_distance():
    pair = simulate(rigid_pair(walk(CONFIG, seed=5), 0.014), grade("ideal"), seed=5)
    apart = np.linalg.norm(pair.left_truth.position - pair.right_truth.position, axis=1)
    np.testing.assert_allclose(apart, 0.014, atol=1e-12)
    np.testing.assert_allclose(pair.left.angular_rate, pair.right.angular_rate, atol=1e-12)
    assert len(pair.moment_ns) == 0
    np.testing.assert_array_equal(pair.left_stances, pair.right_stances)


def test_too_many_stops_are_refused_with_the_number_allowed():
    with pytest.raises(SimulationError, match=r"stops is 50; on this route of .* allowed is 0 to"):
        walk(WalkConfig(route="L", stops=50))


@pytest.mark.parametrize(
    ("name", "value"), [("rate", 30.0), ("speed", 5.0), ("mounting", "knee"), ("route", "moon")]
)
def test_a_value_out_of_range_is_refused_with_its_name(name, value):
    with pytest.raises(ConfigError, match=name):
        WalkConfig.from_mapping({name: value})


def test_nested_gait_parameters_are_taken_and_checked():
    assert WalkConfig.from_mapping({"gait": {"kappa": 0.5}}).gait.kappa == 0.5
    with pytest.raises(ConfigError, match=r"gait\.kapa"):
        WalkConfig.from_mapping({"gait": {"kapa": 0.5}})
