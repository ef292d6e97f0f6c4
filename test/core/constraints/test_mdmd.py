"""The minimum distance through sigma points: exact moments, limits, singular covariances."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.constraints.idc import Idc, IdcConfig
from dualfoot_ros.core.constraints.mdmd import MdmdCkf, MdmdEkf, MdmdUkf, square_root

from ..kernel.states import set_covariance
from .joint import (
    SELECTOR,
    apart,
    assert_covariance,
    assert_same_covariance,
    error_taken,
    separation,
    set_separation,
    states,
)

seeds = st.integers(0, 10_000)
BOTH = pytest.mark.parametrize("method_class", (MdmdUkf, MdmdCkf))


class Listener:
    """Stands in for an estimate and keeps what an update would be done with."""

    def __init__(self, P: np.ndarray) -> None:
        self.P = P

    def covariance(self) -> np.ndarray:
        return self.P

    def update_with(self, cross, innovation, s) -> float:
        self.cross, self.innovation, self.s = cross, innovation, s
        return 0.0


def moments(method_class, r, P, **options) -> tuple[float, float, np.ndarray]:
    """Return (mean, variance, covariance with the errors (30,)) of the distance, as found."""
    listener = Listener(P)
    config = method_class.config_class(distance=0.1, distance_std=0.0, **options)
    method_class(config).correct(listener, list(r), None, 0.1)
    return listener.innovation + 0.1, listener.s, listener.cross


def quadrature(r, P, points: int = 24) -> tuple[float, float, np.ndarray]:
    """Return the same by Gauss-Hermite quadrature over the separation: exact to rounding."""
    nodes, weights = np.polynomial.hermite_e.hermegauss(points)
    weights = weights / weights.sum()
    root = np.linalg.cholesky(SELECTOR @ P @ SELECTOR.T)
    z = np.array(list(itertools.product(nodes, repeat=3)))
    w = np.prod(list(itertools.product(weights, repeat=3)), axis=1)
    error = z @ root.T  # of the separation: estimate minus truth
    distance = np.linalg.norm(r - error, axis=1)
    mean = float(w @ distance)
    with_separation = -(w * (distance - mean)) @ error
    gain = P @ SELECTOR.T @ np.linalg.inv(SELECTOR @ P @ SELECTOR.T)
    return mean, float(w @ (distance - mean) ** 2), gain @ with_separation


def case(seed: int, relative_std: float):
    """Return (r, P): the separation is uncertain by ``relative_std`` of its length."""
    space, estimate = apart(seed, 0.5)
    P = space.covariance()
    scale = relative_std * 0.5 / np.sqrt(np.trace(SELECTOR @ P @ SELECTOR.T) / 3.0)
    return separation(estimate), P * scale**2


@BOTH
@pytest.mark.parametrize("seed", range(5))
def test_mean_variance_and_cross_covariance_are_those_of_the_gaussian(method_class, seed):
    """To the third order: of what an EKF misses (the curvature), at most a few percent stay."""
    r, P = case(seed, 0.03)
    mean, variance, cross = moments(method_class, r, P)
    exact_mean, exact_variance, exact_cross = quadrature(r, P)
    missed_by_ekf = exact_mean - np.linalg.norm(r)
    assert missed_by_ekf > 1e-5
    assert abs(mean - exact_mean) < 0.03 * missed_by_ekf
    assert variance == pytest.approx(exact_variance, rel=0.02)
    assert np.abs(cross - exact_cross).max() < 0.02 * np.abs(exact_cross).max()


@BOTH
def test_the_curvature_of_the_distance_is_in_the_mean(method_class):
    """E|r| = |r| + tr((I - u u') P) / (2 |r|) + O(4): in closed form."""
    r, P = case(2, 0.01)
    u = r / np.linalg.norm(r)
    bent = np.trace((np.eye(3) - np.outer(u, u)) @ SELECTOR @ P @ SELECTOR.T) / (2.0 * 0.5)
    assert moments(method_class, r, P)[0] - 0.5 == pytest.approx(bent, rel=0.01)


@pytest.mark.parametrize("alpha", (1.0, 0.3, 0.1, 0.01))
def test_the_unscented_moments_hold_for_every_spread(alpha):
    r, P = case(1, 0.03)
    mean, variance, _ = moments(MdmdUkf, r, P, alpha=alpha)
    exact_mean, exact_variance, _ = quadrature(r, P)
    assert abs(mean - exact_mean) < 0.05 * (exact_mean - 0.5)
    assert variance == pytest.approx(exact_variance, rel=0.02)


def textbook(r, P, alpha: float, beta: float, kappa: float):
    """Return the moments by Julier and Uhlmann's unscented transform, all weights spelt out."""
    n = len(P)
    lam = alpha**2 * (n + kappa) - n
    values, axes = np.linalg.eigh((n + lam) * P)
    root = axes * np.sqrt(np.clip(values, 0.0, None))
    errors = np.vstack([np.zeros(n), root.T, -root.T])
    mean_weights = np.full(2 * n + 1, 0.5 / (n + lam))
    mean_weights[0] = lam / (n + lam)
    weights = mean_weights.copy()
    weights[0] += 1.0 - alpha**2 + beta
    distance = np.linalg.norm(r - errors @ SELECTOR.T, axis=1)
    mean = mean_weights @ distance
    return mean, weights @ (distance - mean) ** 2, -(weights * (distance - mean)) @ errors


@pytest.mark.parametrize(("alpha", "beta", "kappa"), [(1.0, 2.0, 0.0), (0.5, 2.0, 3.0), (1, 0, 0)])
def test_with_much_uncertainty_the_moments_are_the_textbooks(alpha, beta, kappa):
    r, P = case(6, 0.4)
    found = moments(MdmdUkf, r, P, alpha=float(alpha), beta=float(beta), scaling=float(kappa))
    for ours, theirs in zip(found, textbook(r, P, alpha, beta, kappa), strict=True):
        assert np.allclose(ours, theirs, rtol=1e-9, atol=1e-12)


def test_the_cubature_rule_has_equal_weights_and_no_centre():
    """It is the unscented transform with alpha 1, kappa 0 and nothing added to the centre."""
    r, P = case(6, 0.4)
    found = moments(MdmdCkf, r, P)
    for ours, theirs in zip(found, textbook(r, P, 1.0, 0.0, 0.0), strict=True):
        assert np.allclose(ours, theirs, rtol=1e-9, atol=1e-12)


@BOTH
@given(seed=seeds)
@settings(max_examples=15, deadline=None)
def test_with_little_uncertainty_the_update_is_that_of_the_ekf(method_class, seed):
    found = []
    for each in (method_class, MdmdEkf):
        space, estimate = apart(seed, 0.5)
        set_covariance(space, space.covariance() * 1e-6)
        before, P = states(space), space.covariance()
        each(each.config_class(distance=0.4999, distance_std=1e-4)).apply(estimate)
        found.append((error_taken(before, space), space.covariance()))
    stds = np.sqrt(np.diag(P))
    assert np.abs((found[0][0] - found[1][0]) / stds).max() < 5e-3
    assert np.abs((found[0][1] - found[1][1]) / np.outer(stds, stds)).max() < 5e-3


@BOTH
@given(seed=seeds, direction=seeds)
@settings(max_examples=25, deadline=None)
def test_a_covariance_that_is_singular_after_a_hard_projection_stays_one(
    method_class, seed, direction
):
    space, estimate = apart(seed, 0.6)
    hard = Idc(IdcConfig(distance=0.3, distance_std=0.0))
    assert hard.apply(estimate).accepted
    unit = np.random.default_rng(direction).normal(size=3)
    set_separation(space, 0.5 * unit / np.linalg.norm(unit))
    outcome = method_class(method_class.config_class(distance=0.15, distance_std=0.0)).apply(
        estimate
    )
    P = space.covariance()
    assert np.isfinite(space.w[:60]).all()
    assert_covariance(P)
    assert not outcome.accepted or np.isfinite(separation(estimate)).all()


@BOTH
@given(seed=seeds, times=st.integers(2, 5))
@settings(max_examples=10, deadline=None)
def test_many_constraints_on_end_never_make_a_variance_negative(method_class, seed, times):
    space, estimate = apart(seed, 0.8)
    for k in range(times):
        method_class(method_class.config_class(distance=0.5 / (k + 1), distance_std=0.0)).apply(
            estimate
        )
        assert_covariance(space.covariance())


@BOTH
def test_the_covariance_loses_what_the_gain_says(method_class):
    space, estimate = apart(8, 0.5)
    P, r = space.covariance(), separation(estimate)
    _, variance, cross = moments(method_class, r, P)
    method_class(method_class.config_class(distance=0.15, distance_std=0.1)).apply(estimate)
    expected = P - np.outer(cross, cross) / (variance + 0.01)
    assert_same_covariance(space.covariance(), expected, P)


def test_the_square_root_of_a_singular_or_slightly_negative_matrix_is_real():
    P = np.diag([4.0, 0.0, -1e-18])
    root = square_root(P)
    assert np.isfinite(root).all()
    assert np.allclose(root @ root.T, np.diag([4.0, 0.0, 0.0]))
