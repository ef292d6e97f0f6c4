"""Zero-velocity and general updates against dense matrices and numerical differentiation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.joint_estimate import HeadingCorrection, JointEstimate
from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.strapdown import mechanize
from dualfoot_ros.core.kernel.zero_velocity import zupt

from ..dense import AS_THE_PAPER, considering, joseph
from .states import SAMPLE, error_between, nominal, put_error, random_workspace, set_covariance

seeds = st.integers(0, 10_000)
CONFIG = TrackerConfig.from_mapping({"method": "zupt", **AS_THE_PAPER})


def scaled(difference: np.ndarray, P: np.ndarray) -> float:
    """Return the greatest element of a difference of covariances, in standard deviations of P."""
    std = np.sqrt(np.diag(P))
    return float(np.abs(difference / np.outer(std, std)).max())


def errors_taken_off(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return the error state (30,) that the feedback removed."""
    return np.concatenate(
        [error_between(nominal(before, foot), nominal(after, foot)) for foot in range(2)]
    )


def moving(seed: int):
    """Return a random workspace whose last rates are those of its sample."""
    space = random_workspace(seed, CONFIG)
    for foot in range(2):
        mechanize(space.w, foot, 0.01, SAMPLE + 6 * foot)
    return space


def pivot_velocity(w: np.ndarray, foot: int) -> np.ndarray:
    """Return h(x): the estimated velocity of the point about which the foot pivots."""
    _, v, C, bg, _ = nominal(w, foot)
    lever = lay.C_FOOT + foot * lay.C_STRIDE + lay.C_LEVER
    sample = w[SAMPLE + 6 * foot + 3 : SAMPLE + 6 * foot + 6]
    rate = C @ (sample - bg)
    return v + np.cross([rate[0], rate[1], 0.0], C @ w[lever : lever + 3])


@pytest.mark.parametrize("foot", (0, 1))
@pytest.mark.parametrize("seed", range(4))
def test_the_row_of_a_zero_velocity_update_is_the_derivative_of_the_pivot_velocity(foot, seed):
    space = moving(seed)
    start, size = space.w.copy(), 1e-6
    numerical = np.zeros((3, 15))
    for i in range(15):
        for sign in (-1.0, 1.0):
            error, w = np.zeros(15), start.copy()
            error[i] = sign * size
            put_error(w, foot, error)
            numerical[:, i] += sign * pivot_velocity(w, foot) / (2.0 * size)
    zupt(space.w, foot)
    rows = space.w[lay.S_H : lay.S_H + 96].reshape(3, 32)
    assert np.allclose(rows[:, 16 * foot : 16 * foot + 15], numerical, atol=1e-8)
    assert not rows[:, 16 * (1 - foot) : 16 * (1 - foot) + 16].any()


@given(seeds, st.sampled_from((0, 1)))
@settings(max_examples=40, deadline=None)
def test_a_zero_velocity_update_is_the_dense_joseph_update(seed, foot):
    space = moving(seed)
    before, P, config = space.w.copy(), space.covariance(), CONFIG
    innovation = pivot_velocity(before, foot)
    rate = before[foot * lay.FOOT + lay.RATE : foot * lay.FOOT + lay.RATE + 3]
    zupt(space.w, foot)
    H = np.zeros((3, 30))
    rows = space.w[lay.S_H : lay.S_H + 96].reshape(3, 32)
    H[:, 15 * foot : 15 * foot + 15] = rows[:, 16 * foot : 16 * foot + 15]
    R = np.eye(3) * (config.zupt.std**2 + config.zupt.rate_std**2 * rate @ rate)
    error, expected, S, nis = joseph(P, H, R, innovation)
    assert scaled(space.covariance() - expected, P) < 1e-12
    taken = errors_taken_off(before, space.w)
    assert np.allclose(taken, error, rtol=1e-9, atol=1e-12 * np.abs(error).max())
    info = space.w[lay.Z_LEFT + foot * lay.ZUPT_INFO :][: lay.ZUPT_INFO]
    assert np.allclose(info[:3], innovation, atol=1e-13)
    assert np.allclose(info[3:12].reshape(3, 3), S, rtol=1e-12)
    assert info[12] == pytest.approx(nis, rel=1e-9)


@given(seeds, st.integers(1, 3), st.floats(0.0, 1.0))
@settings(max_examples=40, deadline=None)
def test_one_to_three_rows_at_once_are_the_dense_joseph_update(seed, rows, std):
    rng = np.random.default_rng(seed)
    space = random_workspace(seed)
    before, P = space.w.copy(), space.covariance()
    H, y = rng.normal(size=(rows, 30)), rng.normal(size=rows) * 0.1
    estimate = JointEstimate(space, interpreted())
    S, nis = estimate.update([dict(enumerate(h)) for h in H], y, [std**2] * rows)
    error, expected, S_dense, nis_dense = joseph(P, H, np.eye(rows) * std**2, y)
    assert np.allclose(S, S_dense, rtol=1e-11)
    assert nis == pytest.approx(nis_dense, rel=1e-6)
    assert scaled(space.covariance() - expected, P) < 1e-9
    taken = errors_taken_off(before, space.w)
    assert np.allclose(taken, error, rtol=1e-6, atol=1e-8 * np.abs(error).max())


@given(seeds, st.sampled_from((0, 1)))
@settings(max_examples=40, deadline=None)
def test_standing_still_considers_position_heading_and_the_other_foot(seed, foot):
    """A Schmidt update: the optimal gain with the rows of the considered states set to zero."""
    space = moving(seed)
    before, P, z = space.w.copy(), space.covariance(), CONFIG.zupt
    innovation = pivot_velocity(before, foot)
    rate = before[foot * lay.FOOT + lay.RATE : foot * lay.FOOT + lay.RATE + 3]
    zupt(space.w, foot, True)
    H = np.zeros((3, 30))
    rows = space.w[lay.S_H : lay.S_H + 96].reshape(3, 32)
    H[:, 15 * foot : 15 * foot + 15] = rows[:, 16 * foot : 16 * foot + 15]
    R = np.eye(3) * (z.still_std**2 + z.rate_std**2 * rate @ rate)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    own = 15 * foot
    K[[own, own + 1, own + 2, own + 8]] = 0.0
    K[15 * (1 - foot) : 15 * (1 - foot) + 15] = 0.0
    J = np.eye(30) - K @ H
    assert scaled(space.covariance() - (J @ P @ J.T + K @ R @ K.T), P) < 1e-11
    error = K @ innovation
    taken = errors_taken_off(before, space.w)
    assert np.allclose(taken, error, rtol=1e-8, atol=1e-11 * np.abs(error).max())


def known_alone(*states: int) -> np.ndarray:
    """Return T (30, c) of error states that are known each for itself."""
    return np.eye(30)[:, list(states)]


HEADINGS_AND_BIASES = [8, 9, 10, 11, 23, 24, 25, 26]


@given(seeds, st.sampled_from((0, 1)))
@settings(max_examples=40, deadline=None)
def test_a_zero_velocity_update_leaves_heading_and_bias_alone_and_carries_their_uncertainty(
    seed, foot
):
    space = moving(seed)
    space.w[lay.C_ZUPT_CONSIDERS], space.w[lay.C_BIAS_KNOWN_VAR] = 1.0, np.inf
    before, P, z = space.w.copy(), space.covariance(), CONFIG.zupt
    innovation = pivot_velocity(before, foot)
    rate = before[foot * lay.FOOT + lay.RATE : foot * lay.FOOT + lay.RATE + 3]
    zupt(space.w, foot)
    H = np.zeros((3, 30))
    H[:, 15 * foot : 15 * foot + 15] = space.w[lay.S_H : lay.S_H + 96].reshape(3, 32)[
        :, 16 * foot : 16 * foot + 15
    ]
    R = np.eye(3) * (z.std**2 + z.rate_std**2 * rate @ rate)
    error, after, gain, nis = considering(P, H, R, innovation, known_alone(*HEADINGS_AND_BIASES))
    assert np.abs(gain[HEADINGS_AND_BIASES]).max() < 1e-9
    assert scaled(space.covariance() - after, P) < 1e-8
    assert np.allclose(
        errors_taken_off(before, space.w), error, rtol=1e-6, atol=1e-8 * np.abs(error).max()
    )
    info = space.w[lay.Z_LEFT + foot * lay.ZUPT_INFO :][: lay.ZUPT_INFO]
    assert info[12] == pytest.approx(nis, rel=1e-6)


def in_common(P: np.ndarray) -> np.ndarray:
    """Return T (30, 10) of the gyro biases, and of heading and position that both feet share."""
    T = np.zeros((30, 10))
    T[:, :6] = known_alone(9, 10, 11, 24, 25, 26)
    for k, state in enumerate((8, 0, 1, 2)):
        a = P[state, state] / (P[state, state] + P[state + 15, state + 15])
        T[state, 6 + k], T[state + 15, 6 + k] = 1.0 - a, a
    return T


@given(seeds, st.integers(1, 3), st.floats(0.05, 1.0))
@settings(max_examples=40, deadline=None)
def test_a_correction_between_the_feet_leaves_what_they_have_in_common(seed, rows, std):
    rng, space = np.random.default_rng(seed), random_workspace(seed)
    before, P = space.w.copy(), space.covariance()
    H, y = rng.normal(size=(rows, 30)), rng.normal(size=rows) * 0.1
    T = in_common(P)
    estimate = JointEstimate(space, interpreted())
    rows_of_h = [dict(enumerate(h)) for h in H]
    _, nis = estimate.update(rows_of_h, y, [std**2] * rows, HeadingCorrection.DIFFERENCE)
    error, after, gain, nis_dense = considering(P, H, np.eye(rows) * std**2, y, T)
    assert nis == pytest.approx(nis_dense, rel=1e-5)
    assert np.abs(T.T @ gain).max() < 1e-7 * np.abs(gain).max()
    assert scaled(space.covariance() - after, P) < 1e-7
    taken = errors_taken_off(before, space.w)
    assert np.allclose(taken, error, rtol=1e-5, atol=1e-7 * np.abs(error).max())
    assert np.linalg.eigvalsh(space.covariance()).min() > 0.0


@pytest.mark.parametrize("still", (False, True))
def test_an_update_leaves_the_covariance_symmetric_to_the_bit(still):
    space = moving(3)
    for _ in range(50):
        for foot in range(2):
            zupt(space.w, foot, still)
    for start in (lay.PLL, lay.PRR):
        block = space.w[start : start + lay.BLOCK].reshape(15, lay.ROW)[:, :15]
        assert np.array_equal(block, block.T)


def test_the_other_foot_is_untouched_to_the_bit_while_the_feet_are_uncorrelated():
    space = moving(4)
    space.w[lay.PLR : lay.PLR + lay.BLOCK] = 0.0
    before = space.w.copy()
    zupt(space.w, 0)
    right = slice(lay.FOOT, 2 * lay.FOOT)
    assert np.array_equal(space.w[right], before[right])
    assert np.array_equal(
        space.w[lay.PRR : lay.PLR + lay.BLOCK], before[lay.PRR : lay.PLR + lay.BLOCK]
    )
    assert not np.array_equal(space.w[: lay.FOOT], before[: lay.FOOT])


@given(seeds)
@settings(max_examples=40, deadline=None)
def test_an_exact_measurement_taken_twice_teaches_nothing_the_second_time(seed):
    """After an equality constraint P is singular; a second one must not divide by what is left."""
    space = random_workspace(seed)
    estimate = JointEstimate(space, interpreted())
    row = {i: float(np.sin(i + seed)) for i in range(30)}
    estimate.update([row], [0.3], [0.0])
    settled = space.w.copy()
    estimate.update([row], [0.3], [0.0])
    assert np.allclose(space.w[: lay.STATE], settled[: lay.STATE], atol=1e-9)


def test_the_same_exact_row_twice_in_one_update_counts_once():
    once, twice = random_workspace(9), random_workspace(9)
    row = {0: 1.0, 4: 0.3, 15: -1.0}
    JointEstimate(once, interpreted()).update([row], [0.2], [0.0])
    JointEstimate(twice, interpreted()).update([row, row], [0.2, 0.2], [0.0, 0.0])
    assert np.allclose(once.w[: lay.STATE], twice.w[: lay.STATE], atol=1e-9)


def test_nothing_is_learnt_where_nothing_is_uncertain():
    space = random_workspace(10)
    set_covariance(space, np.zeros((30, 30)))
    before = space.w.copy()
    estimate = JointEstimate(space, interpreted())
    _, nis = estimate.update([{0: 1.0}], [0.5], [0.0])
    assert nis == 0.0
    assert np.array_equal(space.w[: lay.STATE], before[: lay.STATE])
