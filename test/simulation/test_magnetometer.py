"""Simulated magnetometers: the earth's field in the axes of the sensor, and wrong as real ones."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.simulation import ClockConfig, MagnetometerConfig, WalkConfig, simulate, walk

QUIET = MagnetometerConfig(noise=0.0, hard_iron=0.0)


@pytest.fixture(scope="module")
def eight():
    """Return a figure of eight."""
    return walk(WalkConfig(route="figure_eight", rate=60.0, standing=2.0), seed=2)


def level(made, foot="left"):
    """Return the field (N, 3) uT turned to navigation axes by the true attitude."""
    truth = getattr(made, f"{foot}_truth")
    turned = Rotation.from_quat(truth.quaternion)
    return 1e6 * turned.apply(getattr(made, foot).magnetic_field)


def test_without_a_magnetometer_there_is_no_field(eight):
    assert simulate(eight, seed=2).left.magnetic_field is None


@pytest.mark.parametrize("foot", ["left", "right"])
def test_a_perfect_magnetometer_sees_one_field_all_along_the_walk(eight, foot):
    config = replace(QUIET, field=50.0, dip=1.1, north=-0.4)
    field = level(simulate(eight, seed=2, magnetometer=config), foot)
    expected = 50.0 * np.array(
        [np.cos(1.1) * np.cos(-0.4), np.cos(1.1) * np.sin(-0.4), -np.sin(1.1)]
    )
    np.testing.assert_allclose(field, np.tile(expected, (len(field), 1)), atol=1e-9)


def test_a_magnetometer_changes_nothing_else(eight):
    one = simulate(eight, seed=2)
    other = simulate(eight, seed=2, magnetometer=MagnetometerConfig(disturbance=5.0))
    assert one.left.specific_force.tobytes() == other.left.specific_force.tobytes()
    assert one.right.angular_rate.tobytes() == other.right.angular_rate.tobytes()
    assert one.left.stamp_ns.tobytes() == other.left.stamp_ns.tobytes()


def test_the_same_seed_gives_the_same_field_and_another_foot_another(eight):
    one, two = (simulate(eight, seed=4, magnetometer=MagnetometerConfig()) for _ in "ab")
    assert one.left.magnetic_field.tobytes() == two.left.magnetic_field.tobytes()
    assert one.left.magnetic_field.tobytes() != one.right.magnetic_field.tobytes()


def test_samples_that_were_lost_have_lost_their_field_too(eight):
    clock = ClockConfig(drops=0.2)
    made = simulate(eight, clock=clock, seed=2, magnetometer=MagnetometerConfig())
    assert len(made.left) < 0.9 * len(made.left_truth)
    assert len(made.left.magnetic_field) == len(made.left)


def test_noise_and_hard_iron_have_the_sizes_that_were_asked_for():
    standing = walk(WalkConfig(route="standing", rate=60.0, standing=60.0))
    noisy = simulate(standing, seed=1, magnetometer=replace(QUIET, noise=2.0))
    assert (1e6 * noisy.left.magnetic_field).std(axis=0) == pytest.approx(2.0, rel=0.1)
    plain = simulate(standing, seed=1, magnetometer=QUIET).left.magnetic_field
    irons = []
    for seed in range(12):
        made = simulate(standing, seed=seed, magnetometer=replace(QUIET, hard_iron=3.0))
        offset = 1e6 * (made.left.magnetic_field - plain)
        assert np.ptp(offset, axis=0).max() < 1e-6
        irons.append(offset[0])
    assert np.std(irons) == pytest.approx(3.0, rel=0.4)


def test_iron_around_is_smooth_in_space_and_there_again_when_the_foot_comes_by():
    there_and_back = walk(WalkConfig(route="track", rate=60.0, standing=2.0), seed=3)
    config = replace(QUIET, disturbance=5.0, disturbance_length=3.0)
    made = simulate(there_and_back, seed=3, magnetometer=config)
    field = level(made)
    assert (field - level(simulate(there_and_back, seed=3, magnetometer=QUIET))).std(
        axis=0
    ) == pytest.approx(5.0, rel=0.4)
    steepest = 5.0 * np.sqrt(3.0) * 5.0 / 3.0  # uT/m, five standard deviations
    ends = made.left_truth.position[[0, -1]]
    apart_m = np.linalg.norm(ends[1] - ends[0])
    assert np.linalg.norm(field[0] - field[-1]) < steepest * apart_m
    steps_m = np.linalg.norm(np.diff(made.left_truth.position, axis=0), axis=1)
    assert np.linalg.norm(np.diff(field, axis=0), axis=1).max() < steepest * steps_m.max()
