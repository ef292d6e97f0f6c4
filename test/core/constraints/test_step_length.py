"""The bound from body height of Chen, Liu, Guo 2024, eqs (20), (22)-(26)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig
from dualfoot_ros.core.constraints.step_length import StepLength, StepLengthConfig, step_length
from dualfoot_ros.core.kernel import layout as lay

from ..harness import walk
from ..kernel.states import set_covariance
from .joint import MadeUpGait, apart, assert_dense_update, states

seeds = st.integers(0, 10_000)
feet = st.integers(0, 1)


def test_the_papers_subject_of_1_83_m_has_a_bound_of_1_207_m():
    assert step_length(1.83) == pytest.approx(1.207, abs=5e-4)
    assert StepLengthConfig(body_height=1.83).threshold_m == pytest.approx(1.2, abs=0.01)


@given(st.floats(1.45, 2.1))
def test_ten_centimetres_of_height_are_28_of_step(height):
    assert step_length(height + 0.1) - step_length(height) == pytest.approx(0.2789, abs=1e-9)


def test_a_bound_that_is_given_wins_over_the_height():
    assert StepLengthConfig(body_height=1.83, bound=0.8).threshold_m == 0.8


@given(seeds, feet, st.floats(1.02, 2.0), st.floats(0.01, 1.0))
@settings(max_examples=40, deadline=None)
def test_it_is_the_dense_update_of_the_swinging_position_by_the_virtual_one(
    seed, swinging, excess, std
):
    bound = 0.9
    space, estimate = apart(seed, bound * excess)
    before, P = states(space), space.covariance()
    swing, stand = estimate.position(swinging), estimate.position(1 - swinging)
    D = np.linalg.norm(swing - stand)  # eq. (22)
    virtual = ((D - bound) * stand + bound * swing) / D  # eq. (23), second form
    StepLength(StepLengthConfig(bound=bound, position_std=std)).apply(estimate, swinging)
    H = np.zeros((3, 30))
    H[:, 15 * swinging : 15 * swinging + 3] = np.eye(3)  # eq. (26)
    assert_dense_update(before, P, space, H, np.eye(3) * std**2, swing - virtual)


@given(seeds, feet)
@settings(max_examples=20, deadline=None)
def test_an_exact_virtual_position_puts_the_swinging_foot_on_the_sphere(seed, swinging):
    space, estimate = apart(seed, 1.5)
    P = space.covariance()
    P[:15, 15:] = P[15:, :15] = 0.0
    set_covariance(space, P)
    stand = estimate.position(1 - swinging)
    StepLength(StepLengthConfig(bound=0.9, position_std=1e-3)).apply(estimate, swinging)
    assert np.array_equal(estimate.position(1 - swinging), stand)
    assert np.linalg.norm(estimate.position(swinging) - stand) == pytest.approx(0.9, abs=1e-3)


@given(seeds, feet, st.floats(0.1, 1.0))
@settings(max_examples=20, deadline=None)
def test_within_the_bound_nothing_happens(seed, swinging, share):
    space, estimate = apart(seed, 0.9 * share * 0.999)
    before = space.w[: lay.STATE].copy()
    outcome = StepLength(StepLengthConfig(bound=0.9)).apply(estimate, swinging)
    assert not outcome.accepted
    assert np.array_equal(space.w[: lay.STATE], before)


@pytest.mark.parametrize(("still", "asked"), [((1, 0), 1), ((0, 1), 1), ((1, 1), 0), ((0, 0), 0)])
def test_exactly_one_foot_must_swing(still, asked):
    gait = MadeUpGait(np.array(still, dtype=bool)[:, None])
    assert len(StepLength(StepLengthConfig()).on_epoch(gait)) == asked


def test_on_a_walk_of_normal_steps_the_bound_of_the_body_is_idle_and_a_tight_one_is_not():
    applied = []
    for bound in (0.0, 0.45):
        config = {"method": "step_length", "step_length.bound": bound}
        run = DualFootTracker(TrackerConfig.from_mapping(config)).run(*walk(25.0).series())
        applied.append(sum(event.accepted for event in run.of_kind(EventKind.CONSTRAINT)))
    assert applied[0] == 0
    assert applied[1] > 50
