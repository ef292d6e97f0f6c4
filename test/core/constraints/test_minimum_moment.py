"""The minimum-distance moment, eqs (30), (31) of Liu et al. 2023, and when it is applied."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig
from dualfoot_ros.core.constraints.mdmd import MdmdEkf, MdmdEkfConfig

from ..harness import simulated, walk
from .joint import MadeUpGait, apart, separation, set_separation, stance

firsts = st.integers(10, 60)
lengths = st.integers(0, 60)
shares = st.floats(0.0, 1.0)


def method(**options) -> MdmdEkf:
    return MdmdEkf(MdmdEkfConfig(distance=0.15, **options))


def standing(foot: int, first: int, last: int) -> MadeUpGait:
    still = np.zeros((2, 140), dtype=bool)
    still[foot, first : last + 1] = True
    return MadeUpGait(still, np.zeros((140, 2, 3)))


@given(firsts, lengths, shares)
def test_the_moment_is_the_share_kappa_of_the_stance_to_the_nearest_epoch(first, length, kappa):
    moment = stance(0, first, first + length).moment(kappa)
    assert abs(moment - (first + kappa * length)) <= 0.5 + 1e-9


@given(firsts, lengths, shares, st.integers(0, 8))
def test_the_delay_of_the_detector_is_taken_off(first, length, kappa, lag):
    late = stance(0, first, first + length, lag=float(lag)).moment(kappa)
    assert late == pytest.approx(stance(0, first, first + length).moment(kappa) - lag, abs=1)


@given(firsts, lengths, shares, shares)
def test_a_greater_kappa_is_never_an_earlier_moment(first, length, a, b):
    phase = stance(1, first, first + length)
    assert phase.moment(min(a, b)) <= phase.moment(max(a, b))


@pytest.mark.parametrize("foot", (0, 1))
def test_at_the_moment_itself_the_filter_is_rolled_back_to_it(foot):
    gait = standing(foot, 40, 70)
    gait.positions[58, 0] = [0.3, 0.0, 0.0]
    requests = method(kappa=0.6).on_stance_end(stance(foot, 40, 70), gait)
    assert [(r.epoch, r.roll_back) for r in requests] == [(58, True)]


def test_at_detection_the_distance_is_still_that_of_the_moment():
    """The paper applies late, but to the buffered positions: the feet are far apart by then."""
    gait = standing(0, 40, 70)
    gait.positions[58, 0] = [0.3, 0.0, 0.0]
    (request,) = method(kappa=0.6, apply_at="detection").on_stance_end(stance(0, 40, 70), gait)
    assert (request.epoch, request.roll_back) == (58, False)
    _, estimate = apart(1, 0.8)
    outcome = request.apply(estimate)
    assert outcome.detail["distance"] == pytest.approx(0.3)
    assert outcome.innovation[0] == pytest.approx(0.15)


def test_no_constraint_while_both_feet_stand_or_in_a_long_stance():
    both = standing(0, 40, 70)
    both.still[1] = True
    assert not method().on_stance_end(stance(0, 40, 70), both)
    assert not method(max_stance=0.3).on_stance_end(stance(0, 40, 75), standing(0, 40, 75))


def test_only_a_distance_that_exceeds_c0_is_constrained():
    space, estimate = apart(5, 0.6)
    set_separation(space, [0.0, 0.149, 0.0])
    outcome = method().apply(estimate)
    assert not outcome.accepted and outcome.detail["reason"] == "distance within c0"
    assert np.allclose(separation(estimate), [0.0, 0.149, 0.0])


@pytest.mark.parametrize("rate", (60.0, 100.0))
def test_on_a_simulated_walk_the_moments_are_those_of_the_truth(rate):
    """Within the edges of what a detector sees as stance, kappa is 0.49 on these walks."""
    config = {"method": "idc", "idc.kappa": 0.49, "idc.distance": 0.15}
    run = DualFootTracker(TrackerConfig.from_mapping(config)).run(*walk(rate=rate).series())
    events = run.of_kind(EventKind.CONSTRAINT)
    found = np.array([event.stamp_ns for event in events])
    true = simulated(rate=rate).moment_ns
    late_s = np.array([(f - true)[np.argmin(np.abs(f - true))] for f in found]) * 1e-9
    assert len(found) > 0.9 * len(true)
    assert abs(np.median(late_s)) < 0.01
    assert np.percentile(np.abs(late_s), 90) < 0.04
    assert all(event.detected_ns > event.stamp_ns for event in events)
