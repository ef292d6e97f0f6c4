"""The line under all arrivals: offset and skew with an uncertainty that means something."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.timing.clock_envelope import LowerEnvelope, posterior


def cloud(skew=0.0, height=0.0, count=120, spacing=0.5, delay=0.005, seed=0):
    rng = np.random.default_rng(seed)
    time = spacing * (np.arange(count) + rng.random(count))
    return np.column_stack([time, height + skew * time + rng.exponential(delay, count)])


@settings(max_examples=60, deadline=None)
@given(
    skew=st.floats(-0.02, 0.02),
    height=st.floats(-10.0, 10.0),
    seed=st.integers(0, 10_000),
)
def test_offset_and_skew_of_exponential_delays_are_found(skew, height, seed):
    points = cloud(skew, height, seed=seed)
    line = posterior(points, 0.005, 1e-4)
    assert line.skew == pytest.approx(skew, abs=6e-5)
    assert line.at(60.0) == pytest.approx(height + skew * 60.0, abs=1.5e-3)


def test_the_uncertainty_is_the_scatter_of_the_estimates():
    scaled = []
    for seed in range(200):
        line = posterior(cloud(3e-4, 0.1, seed=seed), 0.005, 1e-4)
        scaled.append((line.at(60.0) - 0.1 - 3e-4 * 60.0) / line.std_at(60.0))
    assert abs(np.mean(scaled)) < 0.25
    assert 0.8 < np.std(scaled) < 1.25


@settings(max_examples=30, deadline=None)
@given(shift=st.floats(-100.0, 100.0), tilt=st.floats(-0.01, 0.01))
def test_a_shift_and_a_tilt_of_all_points_move_the_line_by_just_that(shift, tilt):
    points = cloud()
    moved = points + np.column_stack([np.zeros(len(points)), shift + tilt * points[:, 0]])
    # A wide prior, so that the tilt is not held against the line.
    before, after = posterior(points, 0.005, 1.0), posterior(moved, 0.005, 1.0)
    assert after.skew - before.skew == pytest.approx(tilt, abs=2e-6)
    assert after.at(30.0) - before.at(30.0) == pytest.approx(shift + 30.0 * tilt, abs=1e-4)


def test_slow_arrivals_change_nothing():
    points = cloud()
    slow = np.column_stack([points[:, 0], points[:, 1] + 5.0])
    envelope, other = LowerEnvelope(0.5, 240, 1e-4), LowerEnvelope(0.5, 240, 1e-4)
    for quick, late in zip(points, slow, strict=True):
        envelope.add(*quick)
        other.add(*quick)
        other.add(*late)
    assert envelope.line == other.line


def test_memory_is_that_of_the_horizon():
    envelope = LowerEnvelope(0.5, 20, 1e-4)
    for k in range(10_000):
        envelope.add(0.05 * k, 0.01)
    assert len(envelope.points) == 20
    assert envelope.span_s == pytest.approx(9.5, abs=0.5)


def test_a_warming_crystal_is_followed_by_a_short_horizon():
    time = np.arange(0.0, 600.0, 0.1)
    drift = 0.5 * 3e-8 * time**2  # 0.03 ppm a second, 18 ppm in all
    rng = np.random.default_rng(1)
    envelope = LowerEnvelope(0.5, 240, 1e-4)
    for t, y in zip(time, drift + rng.exponential(0.01, len(time)), strict=True):
        envelope.add(float(t), float(y))
    assert envelope.line.at(600.0) == pytest.approx(drift[-1], abs=5e-4)
    assert envelope.line.skew == pytest.approx(3e-8 * 540.0, abs=1e-5)
