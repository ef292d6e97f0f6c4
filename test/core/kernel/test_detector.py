"""The stance detector's statistic against its formula, and the moment it leads to."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.constraints.method import StancePhase
from dualfoot_ros.core.kernel import Workspace
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.detector import glrt

from .states import configured

CONFIG = TrackerConfig(method="zupt")


def filled(samples: np.ndarray, g: float, bias: np.ndarray) -> Workspace:
    """Return a workspace whose history ends with the (N, 12) samples."""
    space = configured(CONFIG, 100.0, 0.2)
    for k, row in enumerate(samples):
        o = lay.RINGS + lay.SAMPLE * (k % space.ring) + 1
        space.w[o : o + 12] = row
    space.n[lay.N_EPOCH] = len(samples) - 1
    for foot in range(2):
        constants = lay.C_FOOT + foot * lay.C_STRIDE
        space.w[constants + lay.C_STILL_RATE : constants + lay.C_STILL_RATE + 3] = bias
        space.w[constants + lay.C_STILL_NORM] = g
    return space


@given(st.integers(0, 10_000), st.integers(1, 60), st.sampled_from((0, 1)))
@settings(max_examples=50, deadline=None)
def test_the_statistic_is_the_glrt_of_skog_over_the_newest_window(seed, count, foot):
    rng = np.random.default_rng(seed)
    samples = rng.normal(size=(count, 12)) + np.repeat([5.0, 0.1, 5.0, 0.1], 3)
    g, bias = 9.8, rng.normal(size=3) * 0.05
    space = filled(samples, g, bias)
    window = samples[-int(space.n[lay.N_WINDOW]) :, 6 * foot : 6 * foot + 6]
    f, w = window[:, :3], window[:, 3:] - bias
    up = f.mean(axis=0) / np.linalg.norm(f.mean(axis=0))
    force = ((f - g * up) ** 2).sum(axis=1) / CONFIG.stance.force_std**2
    rate = (w**2).sum(axis=1) / CONFIG.stance.gyro_std**2
    assert glrt(space.w, space.n, foot) == pytest.approx((force + rate).mean(), rel=1e-9)


@pytest.mark.parametrize("tilt", ([0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, -1.0, 0.0]))
def test_a_foot_at_rest_has_no_statistic_whatever_its_tilt_and_bias(tilt):
    bias = np.array([0.02, -0.03, 0.01])
    row = np.concatenate([9.8 * np.array(tilt), bias] * 2)
    space = filled(np.tile(row, (30, 1)), 9.8, bias)
    assert abs(glrt(space.w, space.n, 0)) < 1e-6


@given(st.integers(0, 1000), st.integers(1, 200), st.floats(0.0, 1.0), st.integers(0, 6))
def test_the_minimum_distance_moment_is_equation_31_less_the_lag_of_the_window(
    first, length, kappa, half_window
):
    last = first + length
    stance = StancePhase(0, first, last, float(half_window), last + 20, 0.005, 0.0)
    expected = (1.0 - kappa) * first + kappa * last - half_window
    assert abs(stance.moment(kappa) - expected) <= 0.5
