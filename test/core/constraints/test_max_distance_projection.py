"""Eq. (4) of Ma and Särkkä 2023, and that nothing else is touched."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from dualfoot_ros.core.constraints.max_distance_projection import (
    MaxDistanceProjection,
    MaxDistanceProjectionConfig,
    pull,
)
from dualfoot_ros.core.kernel import layout as lay

from .joint import MadeUpGait, apart

seeds = st.integers(0, 10_000)
feet = st.integers(0, 1)


@given(seeds, feet, st.floats(0.3, 1.0), st.floats(1.01, 3.0))
@settings(max_examples=40, deadline=None)
def test_the_moving_foot_comes_to_gamma_over_d_of_its_way_and_nothing_else_changes(
    seed, moving, gamma, excess
):
    space, estimate = apart(seed, gamma * excess)
    before = space.w.copy()
    standing, moved = estimate.position(1 - moving), estimate.position(moving)
    outcome = pull(estimate, moving, gamma)
    d = float(np.linalg.norm(moved - standing))
    assert np.allclose(
        estimate.position(moving), standing + gamma / d * (moved - standing), rtol=0, atol=1e-14
    )
    assert outcome.detail["distance_after"] == pytest.approx(gamma)
    start = moving * lay.FOOT + lay.POS
    changed = np.flatnonzero(space.w[: lay.STATE] != before[: lay.STATE])
    assert set(changed) <= {start, start + 1, start + 2}


@given(seeds, feet, st.floats(0.3, 1.0), st.floats(0.05, 1.0))
@settings(max_examples=20, deadline=None)
def test_a_foot_inside_the_sphere_stays_where_it_is(seed, moving, gamma, share):
    space, estimate = apart(seed, gamma * share * 0.999)
    before = space.w[: lay.STATE].copy()
    assert not pull(estimate, moving, gamma).accepted
    assert np.array_equal(space.w[: lay.STATE], before)


def test_it_is_the_nearest_point_of_the_sphere_as_equation_3_asks():
    _, estimate = apart(9, 1.5)
    standing, moved = estimate.position(0), estimate.position(1)
    pull(estimate, 1, 0.9)
    inside = {"type": "ineq", "fun": lambda p: 0.81 - ((p - standing) ** 2).sum()}
    best = minimize(
        lambda p: ((p - moved) ** 2).sum(),
        standing,
        constraints=[inside],
        method="SLSQP",
        options={"ftol": 1e-14},
    )
    assert np.allclose(estimate.position(1), best.x, atol=1e-6)


def test_pulling_twice_is_pulling_once():
    space, estimate = apart(2, 1.3)
    pull(estimate, 0, 0.9)
    once = space.w[: lay.STATE].copy()
    pull(estimate, 0, 0.9)
    assert np.allclose(space.w[: lay.STATE], once, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("still", "pulled"), [((1, 0), 1), ((0, 1), 0), ((1, 1), None), ((0, 0), None)]
)
def test_only_the_one_foot_that_moves_is_pulled(still, pulled):
    gait = MadeUpGait(np.array(still, dtype=bool)[:, None])
    requests = MaxDistanceProjection(MaxDistanceProjectionConfig(bound=0.9)).on_epoch(gait)
    assert len(requests) == (pulled is not None)
    if requests:
        _, estimate = apart(4, 1.4)
        kept = estimate.position(1 - pulled)
        requests[0].apply(estimate)
        assert np.array_equal(estimate.position(1 - pulled), kept)
        assert (requests[0].epoch, requests[0].roll_back) == (0, False)
        assert np.linalg.norm(np.subtract(*[estimate.position(f) for f in (0, 1)])) < 0.9 + 1e-12
