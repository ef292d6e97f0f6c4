"""The line under all arrivals is kept up with every one, in bounded memory."""

import numpy as np
import pytest

from dualfoot_ros.timing.clock.envelope import LowerEnvelope

from .test_line import cloud


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
