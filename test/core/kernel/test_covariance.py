"""The sparse propagation of the covariance against dense matrices and the motion itself."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.covariance import correlated, propagate_foot
from dualfoot_ros.core.kernel.strapdown import mechanize

from ..dense import noise_powers, propagated, transition
from .states import SAMPLE, error_between, nominal, put_error, random_workspace

NOISY = TrackerConfig.from_mapping(
    {
        "method": "zupt",
        "noise": {"gyro": 0.1, "accelerometer": 0.5, "gyro_bias": 0.01, "accelerometer_bias": 0.2},
        "noise.bias_time": 2.0,
    }
)


def mechanized_push(w, foot, dt):
    """Mechanize; return the attitude before it and the velocity increment less gravity."""
    _, v, C, _, _ = nominal(w, foot)
    mechanize(w, foot, dt, SAMPLE + 6 * foot)
    push = w[foot * lay.FOOT + lay.VEL : foot * lay.FOOT + lay.VEL + 3] - v
    return C, push + np.array([0.0, 0.0, w[lay.C_GRAVITY] * dt])


@pytest.mark.parametrize("seed", range(8))
def test_one_epoch_is_the_dense_phi_p_phi_plus_q_of_equations_8_and_10(seed):
    space, dt = random_workspace(seed, NOISY), 0.005 * (1 + seed)
    Phi, Q = np.zeros((30, 30)), np.diag(np.tile(noise_powers(NOISY), 2))
    expected = space.covariance()
    for foot in range(2):
        C, push = mechanized_push(space.w, foot, dt)
        own = slice(15 * foot, 15 * foot + 15)
        Phi[own, own] = transition(C, push / dt, NOISY.noise.bias_time, dt)
        propagate_foot(space.w, foot, dt)
    expected = propagated(expected, Phi, Q, dt)
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    assert np.abs((space.covariance() - expected) / scale).max() < 1e-14


def test_the_covariance_stays_symmetric_to_the_bit_over_a_thousand_epochs():
    space = random_workspace(5)
    for _ in range(1000):
        for foot in range(2):
            mechanize(space.w, foot, 0.01, SAMPLE + 6 * foot)
            propagate_foot(space.w, foot, 0.01)
    for start in (lay.PLL, lay.PRR):
        block = space.w[start : start + lay.BLOCK].reshape(15, lay.ROW)
        assert np.array_equal(block[:, :15], block[:, :15].T)
        assert not block[:, 15].any()


def test_uncorrelated_feet_stay_uncorrelated_to_the_bit():
    space = random_workspace(6)
    space.w[lay.PLR : lay.PLR + lay.BLOCK] = 0.0
    for foot in range(2):
        mechanize(space.w, foot, 0.01, SAMPLE + 6 * foot)
        propagate_foot(space.w, foot, 0.01)
    assert not space.w[lay.PLR : lay.PLR + lay.BLOCK].any()


def test_feet_are_correlated_by_whatever_the_cross_block_holds():
    w = random_workspace(7).w
    block = w[lay.PLR : lay.PLR + lay.BLOCK]
    assert correlated(w)
    block[:] = 0.0
    assert not correlated(w)
    for k in range(lay.BLOCK):
        block[k] = np.nan if k % 2 else 1e-300
        assert correlated(w)
        block[k] = -0.0
    assert not correlated(w)


@pytest.mark.parametrize("foot", (0, 1))
def test_small_errors_of_the_mechanization_grow_as_the_transition_matrix_says(foot):
    """Perturb, mechanize, compare: neither sign nor frame of any block is taken on trust."""
    dt, size = 1e-3, 1e-5
    truth = random_workspace(11)
    truth.w[lay.C_BIAS_RATE] = 0.0
    start = truth.w.copy()
    C, push = mechanized_push(truth.w, foot, dt)
    Phi = transition(C, push / dt, np.inf, dt)
    for i in range(15):
        error = np.zeros(15)
        error[i] = size
        w = start.copy()
        put_error(w, foot, error)
        mechanize(w, foot, dt, SAMPLE + 6 * foot)
        grown = error_between(nominal(w, foot), nominal(truth.w, foot)) / size
        off_diagonal = grown - Phi[:, i]
        assert np.abs(off_diagonal).max() < 0.02 * dt, (i, off_diagonal)
