"""The person between the feet: a heading that follows corners, a floor, an honest sigma."""

from __future__ import annotations

import math

import numpy as np
import pytest

from .following_person import follow, true_headings


def errors(found):
    """Return stamps (s), heading errors (rad), true rates and variances after the first steps."""
    people = found.people[found.known :]
    stamps = np.array([p.stamp_ns for p in people])
    truth = true_headings(found.made, stamps)
    estimate = np.array([p.heading for p in people])
    error = np.mod(estimate - truth + math.pi, math.tau) - math.pi
    seconds = (stamps - stamps[0]) * 1e-9
    variance = np.array([p.pose_covariance[5, 5] for p in people])
    return seconds, error, np.gradient(truth, seconds), variance


def near_corners(seconds, rate):
    """Return (N,) bool: within a second of a moment at which the route turns."""
    turning = seconds[np.abs(rate) > 0.02]
    return np.abs(seconds[:, None] - turning[None, ::5]).min(axis=1) < 1.0


@pytest.mark.parametrize("rate", [60.0, 100.0])
def test_in_a_corner_the_heading_follows_the_person_within_five_degrees(rate):
    seconds, error, turn, _ = errors(follow("L", rate))
    corner = near_corners(seconds, turn)
    assert math.degrees(np.sqrt(np.mean(error[corner] ** 2))) < 5.0
    assert math.degrees(np.sqrt(np.mean(error[~corner] ** 2))) < 2.5


def test_the_heading_moves_while_a_foot_swings_and_never_leaps():
    found = follow("L", 100.0)
    headings = np.array([p.heading for p in found.people[found.known :]])
    steps = np.abs(np.diff(headings))
    assert np.mean(steps > 1e-9) > 0.99
    assert math.degrees(steps.max()) < 5.0


@pytest.mark.parametrize("route", ["L", "rectangle"])
def test_the_sigma_of_the_heading_holds(route):
    ratios = []
    for seed in (1, 2, 3):
        _, error, _, variance = errors(follow(route, 60.0, seed))
        ratios.append(np.mean(error**2 / variance))
    assert 0.3 < np.mean(ratios) < 2.0


def test_nothing_is_known_of_the_heading_before_the_first_strides():
    found = follow("L", 60.0)
    before = found.people[: found.known]
    assert all(p.pose_covariance[5, 5] == pytest.approx(math.pi**2 / 3.0) for p in before)
    assert found.people[found.known].pose_covariance[5, 5] < math.radians(10.0) ** 2


def test_the_yaw_rate_is_the_turn_of_the_person():
    seconds, _, turn, _ = errors(follow("L", 100.0))
    found = follow("L", 100.0)
    rates = np.array([p.yaw_rate for p in found.people[found.known :]])
    assert np.trapezoid(rates, seconds) == pytest.approx(math.pi / 2.0, abs=0.15)
    assert np.sqrt(np.mean((rates - turn)[np.abs(turn) < 0.02] ** 2)) < 0.3


def test_the_person_is_on_the_floor_a_lever_arm_below_the_standing_sensors():
    found = follow("L", 100.0)
    heights = np.array([p.position[2] for p in found.people])
    assert heights[0] == pytest.approx(-0.10, abs=0.005)
    # The sensors of swinging feet rise by 0.2 m, the floor does not; it only drifts.
    assert np.abs(np.diff(heights)).max() < 0.03
    assert np.abs(heights - heights[0]).max() < 0.3


def test_every_covariance_of_the_person_is_symmetric_and_positive():
    for person in follow("rectangle", 60.0, 1).people[::50]:
        for matrix in (person.pose_covariance, person.velocity_covariance):
            assert np.allclose(matrix, matrix.T, atol=1e-15)
            assert np.linalg.eigvalsh(matrix)[0] > -1e-12
        assert person.yaw_rate_variance > 0.0
