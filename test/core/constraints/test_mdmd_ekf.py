"""The minimum distance in an EKF update: a dense one, and its linearisation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.constraints.idc import Idc
from dualfoot_ros.core.constraints.mdmd import MdmdEkf, MdmdEkfConfig

from .joint import (
    SELECTOR,
    apart,
    assert_covariance,
    assert_dense_update,
    error_taken,
    separation,
    states,
)

seeds = st.integers(0, 10_000)


def method(distance: float, **options) -> MdmdEkf:
    return MdmdEkf(MdmdEkfConfig(distance=distance, **options))


@given(seeds, st.floats(0.2, 1.0), st.floats(0.01, 0.3))
@settings(max_examples=40, deadline=None)
def test_it_is_the_dense_update_with_the_gradient_of_the_distance(seed, distance, std):
    space, estimate = apart(seed, distance)
    before, P, r = states(space), space.covariance(), separation(estimate)
    outcome = method(0.15, distance_std=std).apply(estimate)
    step = 1e-6
    gradient = [
        (np.linalg.norm(r + step * e) - np.linalg.norm(r - step * e)) / (2.0 * step)
        for e in np.eye(3)
    ]
    H = np.array(gradient) @ SELECTOR
    assert_dense_update(before, P, space, np.round(H, 9), std**2, distance - 0.15)
    assert outcome.S[0, 0] == pytest.approx(float(H @ P @ H) + std**2)
    assert outcome.nis == pytest.approx((distance - 0.15) ** 2 / outcome.S[0, 0])
    assert_covariance(space.covariance())


def test_one_linearisation_of_a_hard_constraint_is_the_first_iterate_of_the_paper():
    """Eq. (22) starts from A_0 = 2 r', the same row up to length; the constraint is not met."""
    found = []
    for method_class, options in ((MdmdEkf, {}), (Idc, {"solver": "iterative", "iterations": 1})):
        space, estimate = apart(11, 0.6)
        before = states(space)
        config = method_class.config_class(distance=0.59, distance_std=0.0, **options)
        method_class(config).apply(estimate)
        found.append((error_taken(before, space), np.linalg.norm(separation(estimate))))
    # their linearised right-hand sides differ by (|r| - c0)^2 / (2 |r|)
    assert np.abs(found[0][0] - found[1][0]).max() < 0.02 * np.abs(found[0][0]).max()
    assert abs(found[0][1] - 0.59) > 1e-9


def test_a_hard_observation_is_met_when_the_separation_alone_is_uncertain_along_itself():
    _, estimate = apart(3, 0.5)
    u = separation(estimate) / 0.5
    for other in np.linalg.svd(u[None])[2][1:]:
        estimate.update([dict(enumerate(other)) | dict(enumerate(-other, 15))], [0.0], [0.0])
    method(0.15, distance_std=0.0).apply(estimate)
    assert np.linalg.norm(separation(estimate)) == pytest.approx(0.15, abs=1e-9)
