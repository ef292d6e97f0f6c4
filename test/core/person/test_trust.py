"""How far to trust the position: against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import TrustTracker
from dualfoot_ros.core.person.trust import radius_95

SIGMA = math.radians(2.0)
SPEED = 1.25


def straight(seconds: int, limit_m: float = 3.0, bearing: float = 0.0) -> TrustTracker:
    """Return a tracker of a straight walk whose only error is a constant heading error."""
    tracker = TrustTracker(limit_m)
    ahead = np.array([math.cos(bearing), math.sin(bearing)])
    left = np.array([-ahead[1], ahead[0]])
    for second in range(seconds + 1):
        way = SPEED * second
        covariance = (SIGMA * way) ** 2 * np.outer(left, left)
        tracker.add(second * 10**9, way * ahead, covariance, SIGMA**2)
    return tracker


@given(st.floats(0.01, 3.0), st.floats(0.0, 1.0), st.floats(-3.0, 3.0), st.integers(0, 2**30))
def test_the_radius_holds_95_of_100_normal_errors(greater, ratio, angle, seed):
    c, s = math.cos(angle), math.sin(angle)
    axes = np.array([[c, -s], [s, c]]) * [greater, greater * ratio]
    errors = np.random.default_rng(seed).standard_normal((20_000, 2)) @ axes.T
    inside = np.linalg.norm(errors, axis=1) <= radius_95(axes @ axes.T)
    assert inside.mean() == pytest.approx(0.95, abs=0.008)


@pytest.mark.parametrize("bearing", [0.0, 2.0])
def test_straight_ahead_a_constant_heading_error_passes_the_limit_where_it_must(bearing):
    trust = straight(30, bearing=bearing).result()
    whole = 3.0 / (1.96 * SIGMA)
    assert trust.radius_m == pytest.approx(1.96 * SIGMA * 30 * SPEED)
    assert trust.way_left_m == pytest.approx(whole - 30 * SPEED, abs=0.2)
    assert trust.pace == pytest.approx(SPEED)
    assert trust.time_left_s == pytest.approx(trust.way_left_m / SPEED)
    assert trust.trusted


def test_beyond_the_limit_nothing_is_left():
    trust = straight(90).result()
    assert not trust.trusted
    assert trust.way_left_m == trust.time_left_s == 0.0


def test_who_stands_has_way_left_but_no_end_of_time():
    tracker = straight(30)
    covariance = (SIGMA * 30 * SPEED) ** 2 * np.diag([0.0, 1.0])
    for second in range(31, 60):
        tracker.add(second * 10**9, np.array([30 * SPEED, 0.0]), covariance, SIGMA**2)
    trust = tracker.result()
    assert trust.pace == 0.0 and math.isinf(trust.time_left_s)
    assert 0.0 < trust.way_left_m < 100.0


def test_before_the_heading_is_known_nothing_is_foretold():
    tracker = TrustTracker()
    assert tracker.result() is None
    covariance = np.eye(2) * 1e-4
    tracker.add(0, np.zeros(2), covariance, math.pi**2 / 3.0, heading_known=False)
    trust = tracker.result()
    assert not trust.heading_known and math.isinf(trust.way_left_m)


def test_a_heading_that_gets_worse_shortens_the_way():
    steady, worse = straight(30, 30.0), TrustTracker(30.0)
    for second in range(31):
        way, sigma = SPEED * second, SIGMA * math.sqrt(second / 30.0)
        covariance = np.diag([0.0, (SIGMA * way) ** 2])
        worse.add(second * 10**9, np.array([way, 0.0]), covariance, sigma**2)
    assert worse.result().way_left_m < steady.result().way_left_m
