"""The classical minimum distance (Niu et al. 2019): the moment comes from the positions."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.constraints.min_distance import MinDistance, MinDistanceConfig

from .joint import MadeUpGait, apart, assert_dense_update, separation, stance, states

FIRST, LAST = 20, 60


def passing(at: float, closest: float = 0.15, pace: float = 0.02) -> MadeUpGait:
    """Return the right foot passing the standing left one, closest at epoch ``at``."""
    epochs = np.arange(80)
    positions = np.zeros((80, 2, 3))
    positions[:, 1, 0], positions[:, 1, 1] = (epochs - at) * pace, -closest
    still = np.zeros((2, 80), dtype=bool)
    still[0, FIRST : LAST + 1] = True
    return MadeUpGait(still, positions)


def method(**options) -> MinDistance:
    return MinDistance(MinDistanceConfig(**options))


@given(st.integers(FIRST + 1, LAST - 1), st.floats(-0.49, 0.49))
def test_the_moment_is_the_least_distance_of_the_estimated_positions_within_the_stance(at, part):
    assert method().moment(stance(0, FIRST, LAST), passing(at + part)) == at


def test_a_least_distance_at_an_end_of_the_stance_is_no_minimum():
    for at in (0, FIRST, LAST, 79):
        assert method().moment(stance(0, FIRST, LAST), passing(at)) is None


def test_a_drifted_track_moves_the_moment_as_liu_et_al_say():
    """5 cm of error along the way are 2.5 epochs here: what MDMD was made to mend."""
    gait = passing(40.0)
    gait.positions[:, 1, 0] += 0.05
    assert method().moment(stance(0, FIRST, LAST), gait) in (37, 38)


def test_no_moment_while_the_other_foot_stands_too():
    gait = passing(40.0)
    gait.still[1, 35:45] = True
    assert method().moment(stance(0, FIRST, LAST), gait) is None


def test_no_moment_in_a_stance_that_is_no_step():
    assert method(max_stance=0.3).moment(stance(0, FIRST, LAST), passing(40.0)) is None


def test_no_moment_from_before_what_is_remembered():
    gait = passing(30.0)
    gait.oldest = 40
    assert method().moment(stance(0, FIRST, LAST), gait) is None


def test_moments_are_at_least_the_interval_apart():
    steady = method(interval=0.3)
    assert steady.moment(stance(0, FIRST, LAST), passing(40.0)) == 40
    assert steady.moment(stance(0, FIRST, LAST), passing(50.0)) is None
    hasty = method(interval=0.05)
    assert hasty.moment(stance(0, FIRST, LAST), passing(40.0)) == 40
    assert hasty.moment(stance(0, FIRST, LAST), passing(50.0)) == 50


def test_the_request_is_about_the_moment_itself():
    requests = method(distance=0.01).on_stance_end(stance(0, FIRST, LAST), passing(33.0))
    assert [(r.epoch, r.roll_back) for r in requests] == [(33, True)]


def test_feet_that_are_near_enough_need_no_roll_back():
    requests = method(distance=1.0).on_stance_end(stance(0, FIRST, LAST), passing(33.0))
    assert [(r.epoch, r.roll_back) for r in requests] == [(33, False)]


@given(st.integers(0, 1000))
@settings(max_examples=10, deadline=None)
def test_the_distance_is_a_pseudo_observation_along_the_separation(seed):
    space, estimate = apart(seed, 0.5)
    before, P, r = states(space), space.covariance(), separation(estimate)
    method(distance=0.15, distance_std=0.1).apply(estimate)
    u = r / np.linalg.norm(r)
    H = np.concatenate([u, np.zeros(12), -u, np.zeros(12)])
    assert_dense_update(before, P, space, H, 0.01, 0.35)
