"""Each kind of output of an ideal sensor says what it claims to say about the true motion."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import Increments
from dualfoot_ros.simulation import WalkConfig, grade, simulate, walk

GRAVITY = 9.80665
RATES_HZ = (60.0, 100.0, 200.0)


@cache
def walked():
    return walk(WalkConfig(route="straight", standing=1.0), seed=3)


def edges(rate_hz):
    return 2.0 + np.arange(round(20.0 * rate_hz) + 1) / rate_hz


def true_steps(sensor, edges_s):
    """Return rotation and change of velocity (body axes, without gravity) of each interval."""
    truth = walked().truth(sensor, edges_s, np.round(edges_s * 1e9).astype(np.int64))
    attitude = Rotation.from_quat(truth.quaternion)
    up = [0.0, 0.0, GRAVITY]
    push = np.diff(truth.velocity, axis=0) + np.diff(edges_s)[:, None] * up
    return attitude[:-1].inv() * attitude[1:], attitude[:-1].inv().apply(push)


def held_push(alpha, gamma, parts=400):
    """Return the push (N, 3) of a force that is constant in a body that turns by ``alpha``."""
    middles = (np.arange(parts) + 0.5) / parts
    return sum(Rotation.from_rotvec(alpha * share).apply(gamma) for share in middles) / parts


@pytest.mark.parametrize("rate_hz", RATES_HZ)
@pytest.mark.parametrize("sensor", [0, 1])
def test_compensated_values_held_over_their_interval_turn_and_push_as_the_foot_did(
    sensor, rate_hz
):
    edges_s = edges(rate_hz)
    force, rate = walked().sensed(sensor, edges_s, Increments.COMPENSATED)
    turn, push = true_steps(sensor, edges_s)
    alpha, gamma = rate / rate_hz, force / rate_hz
    assert (Rotation.from_rotvec(alpha) * turn.inv()).magnitude().max() < 2e-6
    assert np.abs(held_push(alpha, gamma) - push).max() < 2e-5


@pytest.mark.parametrize("kind", [Increments.AVERAGED, Increments.SAMPLED])
def test_values_of_another_kind_do_not(kind):
    edges_s = edges(60.0)
    _, rate = walked().sensed(0, edges_s, kind)
    turn, _ = true_steps(0, edges_s)
    assert (Rotation.from_rotvec(rate / 60.0) * turn.inv()).magnitude().max() > 2e-4


def test_sampled_values_are_those_of_the_motion_at_their_stamps():
    edges_s = edges(100.0)
    force, rate = walked().sensed(1, edges_s, Increments.SAMPLED)
    place = walked().levers[1], walked().mountings[1]
    at_stamps = walked().shoes[1].sensed(edges_s[1:], *place)
    np.testing.assert_array_equal(force, at_stamps[0])
    np.testing.assert_array_equal(rate, at_stamps[1])


def test_averaged_values_are_the_means_of_every_interval():
    edges_s = edges(100.0)
    for one, other in zip(
        walked().sensed(0, edges_s, Increments.AVERAGED), walked().means(0, edges_s), strict=True
    ):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("kind", Increments)
def test_a_recording_says_what_its_samples_are(kind):
    made = simulate(walked(), replace(grade("ideal"), increments=kind.value))
    assert made.left.increments is made.right.increments is kind


def test_all_kinds_have_the_same_noise_and_the_same_truth():
    made = {k: simulate(walked(), replace(grade("good"), increments=k.value)) for k in Increments}
    averaged = made[Increments.AVERAGED]
    for kind in (Increments.COMPENSATED, Increments.SAMPLED):
        other = made[kind]
        np.testing.assert_array_equal(other.left_truth.position, averaged.left_truth.position)
        still = slice(0, 80)  # where all kinds mean the same
        apart = other.left.angular_rate[still] - averaged.left.angular_rate[still]
        assert np.abs(apart).max() < 3e-3
