"""Smoothed odometry: no leap, no ripple, a fixed lag, and a twist in the body frame."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dualfoot_ros.core import PersonEstimate, Smoother

from .following_person import follow

RATE_HZ = 100


def person(k: int, place, heading=0.0) -> PersonEstimate:
    """Return the person at epoch ``k``."""
    still = np.eye(3) * 1e-4
    position = np.array([*place, 0.0])
    stamp_ns = k * 10**9 // RATE_HZ
    return PersonEstimate(
        stamp_ns, position, np.zeros(3), heading, 0.0, np.eye(6) * 1e-4, still, 1e-2, True
    )


def smooth(people, moved=()):
    smoother = Smoother(1.0, 1000.0)
    found = [smoother.add(p, moved=k in moved) for k, p in enumerate(people)]
    return [each for each in found if each is not None], smoother


@pytest.mark.parametrize("speed", [0.5, 1.4])
def test_steady_walking_in_any_direction_is_passed_on_as_it_is_half_a_window_late(speed):
    heading = 2.0
    ahead = np.array([math.cos(heading), math.sin(heading)]) * speed
    found, smoother = smooth([person(k, ahead * k / RATE_HZ, heading) for k in range(300)])
    assert smoother.lag_s == 0.5
    last = found[-1]
    assert (299 * 10**9 // RATE_HZ - last.stamp_ns) * 1e-9 == pytest.approx(0.5, abs=0.01)
    assert np.allclose(last.position[:2], ahead * last.stamp_ns * 1e-9, atol=1e-9)
    assert np.allclose(last.velocity, [speed, 0.0, 0.0], atol=1e-9)
    assert last.heading == pytest.approx(heading)


def test_a_ripple_of_the_period_of_the_window_vanishes():
    def place(k):
        return (k / RATE_HZ + 0.1 * math.sin(2 * math.pi * k / RATE_HZ), 0.0)

    found, _ = smooth([person(k, place(k)) for k in range(400)])
    assert max(abs(each.velocity[0] - 1.0) for each in found) < 0.01


@pytest.mark.parametrize("announced", [False, True])
def test_a_correction_enters_evenly_over_a_second(announced):
    people = [person(k, (0.0, 0.0 if k < 200 else 1.0)) for k in range(400)]
    found, _ = smooth(people, {200} if announced else ())
    y = np.array([each.position[1] for each in found])
    assert y[0] == 0.0 and y[-1] == pytest.approx(1.0)
    assert np.diff(y).max() < 0.011
    fastest = max(abs(each.velocity[1]) for each in found)
    assert fastest == pytest.approx(0.0 if announced else 1.0, abs=0.02)


def test_after_a_gap_the_window_fills_anew():
    smoother = Smoother(1.0, 1000.0)
    for k in range(200):
        smoother.add(person(k, (0.0, 0.0)))
    assert smoother.add(person(300, (5.0, 0.0))) is None
    assert smoother.add(person(350, (5.0, 0.0))) is None


def test_over_a_walk_it_neither_leaps_nor_swings_with_the_steps():
    found = follow("L", 100.0)
    stamps = np.array([s.stamp_ns for s in found.smoothed])
    assert (np.diff(stamps) > 0).all()
    places = np.array([s.position for s in found.smoothed])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 0.06
    walking = slice(len(places) // 3, len(places) // 2)
    forward = np.array([s.velocity[0] for s in found.smoothed])[walking]
    raw = [np.linalg.norm(p.velocity[:2]) for p in found.people]
    assert forward.std() < 0.15 * np.std(raw)
    assert forward.mean() == pytest.approx(1.2, abs=0.1)
    assert np.abs([s.velocity[1] for s in found.smoothed][len(places) // 4 :]).max() < 0.25
