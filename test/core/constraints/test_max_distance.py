"""The maximum distance (Skog et al. 2012): onto the bound, only when needed, not too often."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig
from dualfoot_ros.core.constraints.max_distance import MaxDistance, MaxDistanceConfig
from dualfoot_ros.core.kernel import layout as lay

from ..harness import walk
from .joint import (
    SELECTOR,
    MadeUpGait,
    apart,
    assert_covariance,
    assert_same_covariance,
    separation,
)

seeds = st.integers(0, 10_000)


def method(bound: float, **options) -> MaxDistance:
    return MaxDistance(MaxDistanceConfig(bound=bound, **options))


@given(seeds, st.floats(0.2, 1.0), st.floats(1.02, 2.0))
@settings(max_examples=40, deadline=None)
def test_a_hard_bound_leaves_the_feet_exactly_that_far_apart(seed, bound, excess):
    space, estimate = apart(seed, bound * excess)
    outcome = method(bound, bound_std=0.0).apply(estimate)
    assert outcome.accepted
    assert np.linalg.norm(separation(estimate)) == pytest.approx(bound, abs=1e-9)
    assert_covariance(space.covariance())


@given(seeds, st.floats(0.2, 1.0), st.floats(1.02, 2.0), st.floats(0.01, 0.2))
@settings(max_examples=40, deadline=None)
def test_a_soft_bound_ends_between_estimate_and_bound(seed, bound, excess, std):
    _, estimate = apart(seed, bound * excess)
    method(bound, bound_std=std).apply(estimate)
    assert bound < np.linalg.norm(separation(estimate)) < bound * excess


@given(seeds, st.floats(0.2, 1.0), st.floats(0.1, 1.0))
@settings(max_examples=20, deadline=None)
def test_feet_within_the_bound_are_left_alone_to_the_bit(seed, bound, share):
    space, estimate = apart(seed, bound * share * 0.999)
    before = space.w.copy()
    assert not method(bound).apply(estimate).accepted
    assert np.array_equal(space.w[: lay.STATE], before[: lay.STATE])


def test_the_hard_bound_loses_the_uncertainty_along_the_separation_and_no_other():
    space, estimate = apart(4, 1.2)
    P = space.covariance()
    method(0.9, bound_std=0.0).apply(estimate)
    A = separation(estimate) @ SELECTOR
    J = np.eye(30) - np.outer(P @ A / (A @ P @ A), A)  # eq. (23) of Liu et al. at the solution
    assert_same_covariance(space.covariance(), J @ P @ J.T, P)


def test_a_constraint_waits_for_the_interval_after_the_last_one():
    method_ = method(0.9, interval=0.5)
    asked = []
    for now in range(200):
        gait = MadeUpGait(np.zeros((2, now + 1), dtype=bool))
        asked += [request.epoch for request in method_.on_epoch(gait)]
    assert asked == [0, 50, 100, 150]


def test_on_a_walk_it_applies_where_the_bound_is_exceeded_and_at_least_the_interval_apart():
    config = {"method": "max_distance", "max_distance.bound": 0.5, "max_distance.bound_std": 0.0}
    tracker = DualFootTracker(TrackerConfig.from_mapping(config))
    found = tracker.run(*walk(30.0).series()).of_kind(EventKind.CONSTRAINT)
    assert len(found) > 10
    stamps = np.array([event.detected_ns for event in found])
    assert np.diff(stamps).min() >= 0.5e9 - 2e7
    for event in found:
        assert event.innovation[0] > 0.0
        assert event.detail["distance_after"] == pytest.approx(0.5, abs=1e-9)
