"""The distance constraint against the paper's equations in dense form and a general optimiser."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from dualfoot_ros.core.constraints.distance_solvers import iterate
from dualfoot_ros.core.constraints.idc import Idc, IdcConfig
from dualfoot_ros.core.joint_estimate import JointEstimate, relative_row
from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay

from ..kernel.states import error_between, nominal, random_workspace

SELECTOR = np.zeros((3, 30))
SELECTOR[:, 0:3], SELECTOR[:, 15:18] = np.eye(3), -np.eye(3)
M = SELECTOR.T @ SELECTOR  # eq. (17)

seeds = st.integers(0, 10_000)
shares = st.floats(0.2, 0.95)


def problem(seed: int, share: float):
    """Return a random joint state, its separation (3,), covariance (30, 30), and a smaller c0."""
    space, rng = random_workspace(seed), np.random.default_rng(seed)
    unit = rng.normal(size=3)
    apart = unit / np.linalg.norm(unit) * rng.uniform(0.06, 1.0)
    left = space.w[lay.POS : lay.POS + 3]
    space.w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3] = left - apart
    r = np.array(JointEstimate(space, interpreted()).relative_position())
    return space, r, space.covariance(), share * float(np.linalg.norm(r))


def method(c0: float, **options) -> Idc:
    return Idc(IdcConfig(distance=c0, **options))


def constrained(space, c0: float, **options):
    """Apply the method; return (outcome, separation after, error taken off (30,))."""
    before = space.w.copy()
    estimate = JointEstimate(space, interpreted())
    outcome = method(c0, **options).apply(estimate)
    taken = [error_between(nominal(before, f), nominal(space.w, f)) for f in range(2)]
    return outcome, np.array(estimate.relative_position()), np.concatenate(taken)


def positions(w: np.ndarray) -> np.ndarray:
    """Return the 30-vector of eq. (15): only the positions matter to the constraint."""
    x = np.zeros(30)
    x[0:3], x[15:18] = w[lay.POS : lay.POS + 3], w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3]
    return x


@given(seeds, shares)
@settings(max_examples=60, deadline=None)
def test_after_the_exact_hard_constraint_the_feet_are_c0_apart_to_a_nanometre(seed, share):
    space, _, _, c0 = problem(seed, share)
    outcome, r, _ = constrained(space, c0, distance_std=0.0)
    assert outcome.accepted
    assert abs(np.linalg.norm(r) - c0) < 1e-9
    assert outcome.detail["distance_after"] == pytest.approx(c0, abs=1e-9)


@given(seeds, shares)
@settings(max_examples=12, deadline=None)
def test_no_point_at_c0_costs_less_than_the_exact_solution(seed, share):
    """Eq. (14) over the sphere of eq. (15), searched by a general optimiser in two angles."""
    space, r, P, c0 = problem(seed, share)
    W = np.linalg.inv(SELECTOR @ P @ SELECTOR.T)

    def cost(angles):
        a, b = angles
        unit = [math.cos(b) * math.cos(a), math.cos(b) * math.sin(a), math.sin(b)]
        step = np.array(unit) * c0 - r
        return float(step @ W @ step)

    estimate = JointEstimate(space, interpreted())
    p = estimate.relative_covariance()
    direction, push, _ = estimate.closest(r.tolist(), p, c0, 0.0)
    s = float(np.array(direction) @ np.array(p) @ direction)
    found = r - np.array(p) @ direction * push / s
    ours = float((found - r) @ W @ (found - r))
    starts = [(a, b) for a in np.arange(-3, 3, 1.0) for b in (-1.0, 0.0, 1.0)]
    best = min(minimize(cost, start, method="BFGS").fun for start in starts)
    assert ours <= best * (1.0 + 1e-6) + 1e-12


@given(seeds, shares, st.floats(0.01, 0.3))
@settings(max_examples=25, deadline=None)
def test_the_soft_constraint_is_the_minimiser_of_both_costs_together(seed, share, std):
    """(x - x0)' W (x - x0) + (|r| - c0)^2 / s^2 over the whole separation, by an optimiser."""
    space, r, P, c0 = problem(seed, share)
    W = np.linalg.inv(SELECTOR @ P @ SELECTOR.T)

    def cost(x):
        return float((x - r) @ W @ (x - r)) + (np.linalg.norm(x) - c0) ** 2 / std**2

    _, after, _ = constrained(space, c0, distance_std=std)
    slope = 2.0 * W @ (after - r)
    slope += 2.0 * (np.linalg.norm(after) - c0) / std**2 * after / np.linalg.norm(after)
    steepness = np.abs(2.0 * W @ (after - r)).max()
    assert np.abs(slope).max() < 1e-7 * max(1.0, steepness)
    best = minimize(cost, after, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12})
    assert cost(after) <= best.fun * (1.0 + 1e-9) + 1e-12


@given(seeds, shares)
@settings(max_examples=30, deadline=None)
def test_the_soft_constraint_ends_between_the_estimate_and_c0(seed, share):
    space, r, _, c0 = problem(seed, share)
    _, after, _ = constrained(space, c0, distance_std=0.1)
    assert c0 < np.linalg.norm(after) < np.linalg.norm(r)


def test_a_soft_constraint_of_no_scatter_is_the_hard_one():
    results = []
    for std in (0.0, 1e-6):
        space, _, _, c0 = problem(7, 0.5)
        _, after, _ = constrained(space, c0, distance_std=std)
        results.append(after)
    assert np.allclose(results[0], results[1], atol=1e-9)


def dense_iterates(x0: np.ndarray, P: np.ndarray, c0: float, count: int):
    """Return [(cost, x, J)] of eqs (22), (23) with the matrices as the paper prints them."""
    found, x = [], x0
    for _ in range(count):
        A = 2.0 * x @ M
        b = 2.0 * x @ M @ x - (x @ M @ x - c0 * c0)
        gain = P @ A / (A @ P @ A)
        J = np.eye(30) - np.outer(gain, A)
        x = x0 - gain * (A @ x0 - b)
        step = x - x0
        found.append((float(step @ np.linalg.solve(P, step)), x, J))
    return found


@pytest.mark.parametrize("iterations", (1, 2, 5))
@pytest.mark.parametrize("seed", range(6))
def test_the_iterative_solver_is_equations_22_and_23_with_the_least_cost_of_equation_14(
    seed, iterations
):
    space, _, P, c0 = problem(seed, 0.6)
    x0 = positions(space.w)
    options = {"distance_std": 0.0, "solver": "iterative", "iterations": iterations}
    _, _, taken = constrained(space, c0, **options)
    iterates = dense_iterates(x0, P, c0, iterations)
    _, x, J = min(iterates, key=lambda item: item[0])
    at_positions = [0, 1, 2, 15, 16, 17]
    assert np.allclose((x0 - taken)[at_positions], x[at_positions], atol=1e-8)
    assert np.allclose(x0 - taken, x, atol=1e-7)
    scale = np.sqrt(np.outer(np.diag(P), np.diag(P)))
    assert np.abs((space.covariance() - J @ P @ J.T) / scale).max() < 1e-9


@given(seeds, shares)
@settings(max_examples=30, deadline=None)
def test_the_covariance_after_the_exact_solution_is_j_p_j_along_the_final_separation(seed, share):
    space, _, P, c0 = problem(seed, share)
    _, after, _ = constrained(space, c0, distance_std=0.0)
    A = 2.0 * after @ SELECTOR
    J = np.eye(30) - np.outer(P @ A / (A @ P @ A), A)
    scale = np.sqrt(np.outer(np.diag(P), np.diag(P)))
    assert np.abs((space.covariance() - J @ P @ J.T) / scale).max() < 1e-9
    assert abs(A @ space.covariance() @ A) < 1e-9 * float(A @ P @ A)


def test_the_papers_iteration_need_not_converge():
    """An uncertain direction across the separation: the iterates jump, the exact one holds."""
    r, c0 = [0.30, 0.02, 0.0], 0.10
    p = [[1e-4, 0.0, 0.0], [0.0, 0.04, 0.0], [0.0, 0.0, 1e-4]]
    distances = []
    for count in (1, 2, 5, 50):
        a, push, _ = iterate(r, p, c0, 0.0, count)
        s = float(np.array(a) @ p @ a)
        distances.append(float(np.linalg.norm(r - np.array(p) @ a * push / s)))
    assert min(abs(d - c0) for d in distances) > 0.01
    estimate = JointEstimate(random_workspace(0), interpreted())
    u, push, _ = estimate.closest(r, p, c0, 0.0)
    s = float(np.array(u) @ p @ u)
    assert abs(np.linalg.norm(r - np.array(p) @ u * push / s) - c0) < 1e-12


@pytest.mark.parametrize("solver", ("exact", "iterative"))
def test_nothing_happens_to_feet_that_are_within_c0(solver):
    space, r, _, _ = problem(2, 0.5)
    before = space.w.copy()
    c0 = min(1.0, 1.01 * float(np.linalg.norm(r)))
    space.w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3] = before[
        lay.POS : lay.POS + 3
    ] + np.array([0.0, 0.1, 0.0])
    before = space.w.copy()
    outcome, _, _ = constrained(space, c0, solver=solver)
    assert not outcome.accepted
    assert outcome.detail["reason"] == "distance within c0"
    assert np.array_equal(space.w[: lay.STATE], before[: lay.STATE])


def test_feet_at_the_very_same_place_are_left_alone():
    space = random_workspace(3)
    space.w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3] = space.w[lay.POS : lay.POS + 3]
    assert not constrained(space, 0.15)[0].accepted


def test_a_second_hard_constraint_at_the_same_moment_changes_nothing():
    space, _, _, c0 = problem(4, 0.5)
    constrained(space, c0, distance_std=0.0)
    settled = space.w[: lay.STATE].copy()
    constrained(space, c0, distance_std=0.0)
    assert np.allclose(space.w[: lay.STATE], settled, atol=1e-9)


@given(seeds, st.floats(0.02, 0.2))
@settings(max_examples=40, deadline=None)
def test_a_distance_out_of_reach_of_what_is_uncertain_never_throws_the_feet_away(seed, c0):
    """P_r has rank one: c0 may be unreachable along it, and the feet must stay where they were."""
    space = random_workspace(seed)
    estimate = JointEstimate(space, interpreted())
    for axis in range(2):
        unit = [0.0, 0.0, 0.0]
        unit[axis] = 1.0
        estimate.update([relative_row(unit)], [0.0], [0.0])
    r = np.array(estimate.relative_position())
    outcome, after, _ = constrained(space, c0, distance_std=0.0)
    assert np.isfinite(space.w[: lay.STATE]).all()
    assert np.linalg.norm(after) <= np.linalg.norm(r) + 1e-9
    assert outcome.S[0, 0] >= 0.0


def test_the_reported_innovation_its_variance_and_nis_are_those_of_the_distance():
    space, r, P, c0 = problem(5, 0.5)
    outcome, _, _ = constrained(space, c0, distance_std=0.05)
    u = r / np.linalg.norm(r) @ SELECTOR
    s = float(u @ P @ u) + 0.05**2
    error = float(np.linalg.norm(r)) - c0
    assert outcome.innovation[0] == pytest.approx(error)
    assert outcome.S[0, 0] == pytest.approx(s)
    assert outcome.nis == pytest.approx(error**2 / s)
