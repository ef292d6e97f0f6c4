"""NEES: one where the covariance is honest, more where it promises too much."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import chi2

from dualfoot_ros.evaluation.frames.yaw_transform import YawTransform
from dualfoot_ros.evaluation.metrics.nees import nees


def covariance(seed: int) -> np.ndarray:
    """Return a random full covariance."""
    root = np.random.default_rng(seed).normal(size=(3, 3))
    return root @ root.T + 0.01 * np.eye(3)


def test_errors_drawn_from_the_covariance_have_the_chi_square_band():
    P, count = covariance(1), 4000
    errors = np.random.default_rng(2).multivariate_normal(np.zeros(3), P, size=count)
    total = 3 * nees(errors, np.repeat([P], count, axis=0)).sum()
    low, high = chi2.ppf([1e-6, 1 - 1e-6], 3 * count)
    assert low < total < high


def test_a_covariance_that_promises_twice_the_accuracy_has_four_times_the_nees():
    P, error = covariance(3), np.array([[0.1, -0.2, 0.3]])
    assert nees(error, P[None] / 4) == pytest.approx(4 * nees(error, P[None]))


@given(st.integers(0, 99), st.floats(-3, 3))
def test_nees_does_not_depend_on_the_frame(seed, yaw):
    P = covariance(seed)[None]
    error = np.random.default_rng(seed).normal(size=(1, 3))
    turn = YawTransform(yaw, np.zeros(3))
    assert nees(turn.vector(error), turn.covariance(P)) == pytest.approx(nees(error, P))


def test_a_covariance_made_singular_by_a_hard_constraint_gives_a_finite_figure():
    P = np.diag([0.0, 1.0, 1.0])[None]
    assert np.isfinite(nees(np.array([[0.01, 0.5, 0.5]]), P)).all()
