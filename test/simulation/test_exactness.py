"""The truth is exact: integrating the noise-free output returns it, on every route."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core.kernel import layout, strapdown
from dualfoot_ros.simulation import ROUTES, WalkConfig, grade, simulate, walk
from dualfoot_ros.simulation.shoe import EulerAngles

from .strapdown import GRAVITY, strides

RATE = 250.0  # Hz; the integration itself is then wrong by up to 0.44 mm a stride on `city`
WALKED = [name for name in ROUTES if name != "standing"]


@cache
def noise_free(route, mounting="instep", rate=RATE):
    config = WalkConfig(route=route, rate=rate, mounting=mounting, standing=1.0)
    return simulate(config, grade("ideal"), seed=7)


def stride_bounds(simulation, foot):
    """Return (M, 2) indices from 0.2 s before a stance ends to 0.2 s after the next began."""
    stances = simulation.left_stances if foot == "left" else simulation.right_stances
    stamps = simulation.left.stamp_ns if foot == "left" else simulation.right.stamp_ns
    first = np.searchsorted(stamps, stances[:-1, 1] - 200_000_000)
    return np.column_stack([first, np.searchsorted(stamps, stances[1:, 0] + 200_000_000)])


@pytest.mark.parametrize("foot", ["left", "right"])
@pytest.mark.parametrize("route", WALKED)
def test_the_papers_strapdown_returns_the_truth_within_1_mm_a_stride(route, foot):
    simulation = noise_free(route)
    series, truth = getattr(simulation, foot), getattr(simulation, f"{foot}_truth")
    error = strides(series, truth, stride_bounds(simulation, foot))
    assert len(error) > 20
    assert np.linalg.norm(error, axis=1).max() < 1e-3


def test_a_heel_mounted_sensor_is_as_exact():
    simulation = noise_free("L", "heel")
    error = strides(simulation.left, simulation.left_truth, stride_bounds(simulation, "left"))
    assert np.linalg.norm(error, axis=1).max() < 1e-3


def test_the_projects_own_strapdown_returns_the_truth_within_1_mm_a_stride():
    simulation = noise_free("L")
    series, truth = simulation.right, simulation.right_truth
    bounds = stride_bounds(simulation, "right")
    for first, last in bounds[np.linspace(1, len(bounds) - 2, 8).astype(int)]:
        w = np.zeros(layout.workspace_size(1))
        w[layout.C_GRAVITY] = GRAVITY
        w[layout.POS : layout.POS + 3] = truth.position[first]
        w[layout.VEL : layout.VEL + 3] = truth.velocity[first]
        w[layout.ROT : layout.ROT + 9] = (
            Rotation.from_quat(truth.quaternion[first]).as_matrix().ravel()
        )
        sample = layout.RINGS
        for k in range(first + 1, last + 1):
            w[sample : sample + 3] = series.specific_force[k]
            w[sample + 3 : sample + 6] = series.angular_rate[k]
            strapdown.mechanize(w, 0, 1.0 / RATE, sample)
        np.testing.assert_allclose(w[layout.POS : layout.POS + 3], truth.position[last], atol=1e-3)


def test_the_error_of_integration_falls_about_fourfold_when_the_rate_doubles():
    # Eq. (3) is a trapezoid, of second order: any first-order fault of ours would show.
    errors = []
    for rate in (100.0, 200.0, 400.0):
        simulation = noise_free("straight", rate=rate)
        error = strides(simulation.left, simulation.left_truth, stride_bounds(simulation, "left"))
        errors.append(np.sqrt(np.mean(error**2)))
    assert errors[0] > 3.4 * errors[1] > 3.4**2 * errors[2]


def test_velocity_is_the_derivative_of_position_and_the_rate_that_of_the_attitude():
    walked = walk(WalkConfig(route="figure_eight"), seed=3)
    place = walked.levers[0], walked.mountings[0]
    time_s = np.linspace(2.0, 50.0, 997)
    step = 1e-5
    here = walked.shoes[0].poses(time_s, *place)
    before = walked.shoes[0].poses(time_s - step, *place)
    after = walked.shoes[0].poses(time_s + step, *place)
    _, rate = walked.shoes[0].sensed(time_s, *place)
    slope = (after.position - before.position) / (2 * step)
    np.testing.assert_allclose(here.velocity, slope, atol=1e-5)
    turned = Rotation.from_matrix(before.rotation.transpose(0, 2, 1) @ after.rotation)
    np.testing.assert_allclose(rate, turned.as_rotvec() / (2 * step), atol=1e-4)


def test_specific_force_is_acceleration_minus_gravity_in_the_body_frame():
    walked = walk(WalkConfig(route="stairs"), seed=3)
    place = walked.levers[1], walked.mountings[1]
    time_s = np.linspace(2.0, 40.0, 997)
    step = 1e-5
    here = walked.shoes[1].poses(time_s, *place)
    before = walked.shoes[1].poses(time_s - step, *place)
    after = walked.shoes[1].poses(time_s + step, *place)
    force, _ = walked.shoes[1].sensed(time_s, *place)
    acceleration = (after.velocity - before.velocity) / (2 * step)
    up = np.array([0.0, 0.0, GRAVITY])
    expected = np.einsum("nji,nj->ni", here.rotation, acceleration + up)
    np.testing.assert_allclose(force, expected, atol=1e-3)


def test_a_turn_about_one_axis_gives_the_rate_about_that_axis():
    angles, first = EulerAngles.of(*np.zeros((3, 1))), np.array([[0.0], [2.0], [0.0]])
    np.testing.assert_allclose(angles.rates(first), first)
    np.testing.assert_allclose(angles.accelerations(first, np.zeros((3, 1))), 0.0)


def test_samples_are_means_over_the_interval_before_their_stamp():
    walked = walk(WalkConfig(route="straight"), seed=3)
    coarse = 12.0 + np.arange(101) / 60.0
    fine = np.linspace(coarse[0], coarse[-1], 100 * 40 + 1)
    mean_force, mean_rate = walked.means(0, coarse)
    fine_force, fine_rate = walked.means(0, fine)
    np.testing.assert_allclose(mean_force, fine_force.reshape(100, 40, 3).mean(axis=1), atol=2e-3)
    np.testing.assert_allclose(mean_rate, fine_rate.reshape(100, 40, 3).mean(axis=1), atol=2e-4)


def test_standing_still_gives_gravity_and_no_rate_but_for_sway():
    simulation = simulate(WalkConfig(route="standing", standing=60.0), grade("ideal"), seed=1)
    norm = np.linalg.norm(simulation.left.specific_force, axis=1)
    np.testing.assert_allclose(norm, GRAVITY, atol=0.05)
    assert np.abs(simulation.left.angular_rate).max() < 0.03
    assert np.ptp(simulation.left_truth.position, axis=0).max() < 0.01
