"""The spacing vector of Ma and Särkkä 2023, eqs (5)-(9), in the axes used here."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.constraints.spacing_vector import SpacingVector, SpacingVectorConfig
from dualfoot_ros.core.rotation import mean_angle

from ..kernel.states import set_covariance
from .joint import (
    MadeUpGait,
    apart,
    assert_covariance,
    assert_dense_update,
    separation,
    stance,
    states,
)

seeds = st.integers(0, 10_000)
headings = st.floats(-7.0, 7.0)
spacings = st.floats(0.05, 0.4)


def method(**options) -> SpacingVector:
    """Return the method as the paper has it, but for ``options``."""
    paper = {"height_std": 0.0, "heading_correction": "full"}
    return SpacingVector(SpacingVectorConfig(**{**paper, **options}))


@given(seeds, headings, spacings)
@settings(max_examples=40, deadline=None)
def test_the_right_foot_comes_out_2a_to_the_right_whatever_the_heading(seed, heading, spacing):
    space, estimate = apart(seed, 0.5)
    method(spacing=spacing, spacing_std=0.0).apply(estimate, heading)
    to_right = -separation(estimate)[:2]
    forward = np.array([math.cos(heading), math.sin(heading)])
    assert forward[0] * to_right[1] - forward[1] * to_right[0] < 0.0  # clockwise of forward
    assert np.linalg.norm(to_right) == pytest.approx(spacing, abs=1e-8)
    assert abs(forward @ to_right) < 1e-8
    assert_covariance(space.covariance())


@given(seeds, headings, spacings)
@settings(max_examples=40, deadline=None)
def test_equation_9_is_met_to_a_nanometre_by_the_hard_projection(seed, heading, spacing):
    """D x = d with D = [I -I], right minus left; the paper's x is right and its y forward."""
    _, estimate = apart(seed, 0.5)
    method(spacing=spacing, spacing_std=0.0).apply(estimate, heading)
    psi_L = psi_R = heading
    up, ahead = math.sin(psi_R) + math.sin(psi_L), math.cos(psi_R) + math.cos(psi_L)
    right_of_paper = spacing * np.array([ahead, up]) / math.hypot(ahead, up)  # eq. (8)
    # paper's east-like x at heading zero is our -y, its forward y our x
    in_our_axes = np.array([right_of_paper[1], -right_of_paper[0]])
    assert np.allclose(-separation(estimate)[:2], in_our_axes, atol=1e-9)


@given(st.floats(-3.1, 3.1), st.floats(-1.5, 1.5))
def test_the_heading_is_the_circular_mean_of_equation_7(psi, apart_by):
    mean = mean_angle(psi + apart_by, psi - apart_by)
    assert math.isclose(math.cos(mean - psi), 1.0, abs_tol=1e-12)


@given(seeds, headings)
@settings(max_examples=20, deadline=None)
def test_height_is_not_observed(seed, heading):
    space, estimate = apart(seed, 0.5)
    P = space.covariance()
    P[2, [i for i in range(30) if i != 2]] = P[[i for i in range(30) if i != 2], 2] = 0.0
    set_covariance(space, P)
    height = estimate.position(0)[2]
    method(spacing=0.2).apply(estimate, heading)
    assert estimate.position(0)[2] == pytest.approx(height, abs=1e-12)


@given(seeds, headings, st.floats(0.01, 0.2), st.floats(0.05, 0.5))
@settings(max_examples=20, deadline=None)
def test_the_difference_in_height_is_one_row_more(seed, heading, std, height_std):
    space, estimate = apart(seed, 0.5)
    before, P, r = states(space), space.covariance(), separation(estimate)
    method(spacing=0.2, spacing_std=std, height_std=height_std).apply(estimate, heading)
    H = np.zeros((3, 30))
    H[:, 0:3], H[:, 15:18] = np.eye(3), -np.eye(3)
    y = r - 0.2 * np.array([-math.sin(heading), math.cos(heading), 0.0])
    R = np.diag([std**2, std**2, height_std**2])
    assert_dense_update(before, P, space, H, R, y)


@given(seeds, headings)
@settings(max_examples=20, deadline=None)
def test_a_correction_of_the_difference_does_not_move_the_pair(seed, heading):
    """It only pulls the feet to each other: the way and the heading in common stay."""
    space, estimate = apart(seed, 0.5)
    weights = np.diag(space.covariance())
    a = weights[0:3] / (weights[0:3] + weights[15:18])

    def middle():
        return (1.0 - a) * estimate.position(0) + a * estimate.position(1)

    before = middle()
    method(spacing=0.2, heading_correction="difference", height_std=0.15).apply(estimate, heading)
    assert np.allclose(middle(), before, atol=1e-9)
    assert_covariance(space.covariance())


@given(seeds, headings, st.floats(0.01, 0.2))
@settings(max_examples=20, deadline=None)
def test_it_is_the_dense_update_with_two_rows(seed, heading, std):
    space, estimate = apart(seed, 0.5)
    before, P, r = states(space), space.covariance(), separation(estimate)
    outcome = method(spacing=0.2, spacing_std=std).apply(estimate, heading)
    H = np.zeros((2, 30))
    H[:, 0:2], H[:, 15:17] = np.eye(2), -np.eye(2)
    y = r[:2] - 0.2 * np.array([-math.sin(heading), math.cos(heading)])
    assert_dense_update(before, P, space, H, np.eye(2) * std**2, y)
    assert outcome.nis == pytest.approx(float(y @ np.linalg.solve(outcome.S, y)))


@given(seeds, headings, st.floats(0.01, 0.2))
@settings(max_examples=20, deadline=None)
def test_the_lateral_variant_is_the_dense_update_with_the_row_across_the_heading(
    seed, heading, std
):
    space, estimate = apart(seed, 0.5)
    before, P, r = states(space), space.covariance(), separation(estimate)
    method(spacing=0.2, spacing_std=std, variant="lateral").apply(estimate, heading)
    left = np.array([-math.sin(heading), math.cos(heading), 0.0])
    H = np.concatenate([left, np.zeros(12), -left, np.zeros(12)])
    assert_dense_update(before, P, space, H, std**2, float(r @ left) - 0.2)


@given(seeds, headings)
@settings(max_examples=20, deadline=None)
def test_the_lateral_variant_leaves_the_separation_along_the_way_alone(seed, heading):
    """Where along and across are not correlated; and it is hard across."""
    space, estimate = apart(seed, 0.5)
    set_covariance(space, np.diag(np.tile(np.repeat([0.04, 0.01, 1e-4, 1e-6, 1e-3], 3), 2)))
    forward = np.array([math.cos(heading), math.sin(heading), 0.0])
    along = float(separation(estimate) @ forward)
    method(spacing=0.2, spacing_std=0.0, variant="lateral").apply(estimate, heading)
    r = separation(estimate)
    assert float(r @ forward) == pytest.approx(along, abs=1e-12)
    assert float(r @ [-forward[1], forward[0], 0.0]) == pytest.approx(0.2, abs=1e-9)


def test_it_is_asked_for_at_mid_stance_of_the_standing_foot():
    still = np.zeros((2, 100), dtype=bool)
    still[0, 40:71] = True
    (request,) = method().on_stance_end(stance(0, 40, 70), MadeUpGait(still))
    assert (request.epoch, request.roll_back) == (55, True)


def test_or_at_the_peak_of_the_swinging_foots_turn():
    still = np.zeros((2, 100), dtype=bool)
    still[0, 40:71] = True
    samples = np.zeros((2, 100, 6))
    samples[1, 40:71, 4] = -5.0 * np.exp(-0.5 * ((np.arange(40, 71) - 58.0) / 5.0) ** 2)
    config = method(moment="feet_adjacent")
    (request,) = config.on_stance_end(stance(0, 40, 70), MadeUpGait(still, samples=samples))
    assert (request.epoch, request.roll_back) == (58, True)


def test_not_in_a_stand_nor_while_both_feet_stand():
    still = np.ones((2, 400), dtype=bool)
    assert not method().on_stance_end(stance(0, 40, 300), MadeUpGait(still))
    assert not method().on_stance_end(stance(0, 40, 70), MadeUpGait(still))
    moving = method(moment="feet_adjacent")
    assert not moving.on_stance_end(stance(0, 40, 70), MadeUpGait(still))


@pytest.mark.parametrize(("variant", "height_std"), (("vector", 0.1), ("lateral", 0.0)))
def test_other_rows_after_a_retune_are_those_of_the_outcome_and_of_its_dimensions(
    variant, height_std
):
    changed = method(spacing=0.2)
    changed.retune(method(spacing=0.2, variant=variant, height_std=height_std).config)
    outcome = changed.apply(apart(3, 0.5)[1], 0.4)
    rows = {"vector": 3, "lateral": 1}[variant]
    assert changed.dimensions == len(outcome.innovation) == len(outcome.S) == rows
    assert (np.diag(outcome.S) > 0.0).all()
