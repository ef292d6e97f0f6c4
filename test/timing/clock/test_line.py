"""The line of a clock: its mean and spread are those of the likelihood."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.timing.clock.line import EVENT_STD_S, FAILED, STEEPEST, LinesBelow, fit_between

INTERVAL = 0.04


def cloud(skew=0.0, height=0.0, count=120, spacing=0.5, delay=0.005, seed=0):
    rng = np.random.default_rng(seed)
    time = spacing * (np.arange(count) + rng.random(count))
    return np.column_stack([time, height + skew * time + rng.exponential(delay, count)])


def waits(skew=0.0, height=0.0, count=60, seed=0, failed=0.1):
    """Return notifications (n, 2) that waited up to an interval, and more where events failed."""
    rng = np.random.default_rng(seed)
    time = 0.5 * (np.arange(count) + rng.random(count))
    wait = INTERVAL * (rng.random(count) + rng.geometric(1.0 - failed, count) - 1)
    return np.column_stack([time, height + skew * time + wait])


@settings(max_examples=60, deadline=None)
@given(
    skew=st.floats(-0.02, 0.02),
    height=st.floats(-10.0, 10.0),
    seed=st.integers(0, 10_000),
)
def test_offset_and_skew_of_exponential_delays_are_found(skew, height, seed):
    line = LinesBelow(cloud(skew, height, seed=seed)).fit(0.005, 1e-4)
    assert line.skew == pytest.approx(skew, abs=6e-5)
    assert line.at(60.0) == pytest.approx(height + skew * 60.0, abs=1.5e-3)


def test_the_uncertainty_is_the_scatter_of_the_estimates():
    scaled = []
    for seed in range(200):
        line = LinesBelow(cloud(3e-4, 0.1, seed=seed)).fit(0.005, 1e-4)
        scaled.append((line.at(60.0) - 0.1 - 3e-4 * 60.0) / line.std_at(60.0))
    assert abs(np.mean(scaled)) < 0.25
    assert 0.8 < np.std(scaled) < 1.25


def test_between_its_uncertainty_is_the_scatter_too():
    scaled = []
    for seed in range(200):
        points = waits(3e-4, 0.1, seed=seed)
        line = fit_between(points, points, INTERVAL, LinesBelow(points).fit(0.02, 1e-3), 1e-3)
        scaled.append((line.at(30.0) - 0.1 - 3e-4 * 30.0) / line.std_at(30.0))
    assert abs(np.mean(scaled)) < 0.25
    assert 0.8 < np.std(scaled) < 1.25


@pytest.mark.parametrize("seed", range(6))
def test_between_equals_the_sum_over_a_fine_grid_of_lines(seed):
    points = waits(2e-4, 0.01, count=12, seed=seed)
    line = fit_between(points, points, INTERVAL, LinesBelow(points).fit(0.02, 1e-3), 1e-3)
    center = points[:, 0].mean()
    skew = np.linspace(line.skew - 0.012, line.skew + 0.012, 1601)
    height = np.linspace(-0.08, 0.08, 1601)[:, None] + line.height_s
    log_p = np.tile(-np.log1p((skew / 1e-3) ** 2), (len(height), 1))
    for time, delayed in points:
        delay = delayed - height - skew * (time - center)
        log_p += np.where(delay < 0.0, -np.inf, np.log(FAILED) * (delay > INTERVAL))
    p = np.exp(log_p)
    p /= p.sum()
    mean = float((p * height).sum())
    std = float((p * (height - mean) ** 2).sum()) ** 0.5
    assert line.skew == pytest.approx(float((p * skew).sum()), abs=3e-5)
    assert line.height_s == pytest.approx(mean, abs=2e-4)
    assert line.height_var**0.5 == pytest.approx(np.hypot(std, EVENT_STD_S), rel=0.05)


def test_in_step_an_interval_of_lines_is_as_likely():
    """Waits that never change say no more than that the clock is within an interval."""
    points = np.column_stack([np.arange(0.0, 30.0, 0.5), np.full(60, 0.3)])
    line = fit_between(points, points, INTERVAL, LinesBelow(points).fit(0.005, 1e-6), 1e-6)
    assert line.at(15.0) == pytest.approx(0.3 - INTERVAL / 2.0, abs=0.001)
    assert line.std_at(15.0) == pytest.approx(INTERVAL / 12.0**0.5, rel=0.05)


@settings(max_examples=30, deadline=None)
@given(shift=st.floats(-100.0, 100.0), tilt=st.floats(-0.01, 0.01))
def test_a_shift_and_a_tilt_of_all_points_move_the_line_by_just_that(shift, tilt):
    # Wide priors, so that the tilt is not held against the line.
    for fit, points in ((_below, cloud()), (_between, waits())):
        moved = points + np.column_stack([np.zeros(len(points)), shift + tilt * points[:, 0]])
        before, after = fit(points), fit(moved)
        assert after.skew - before.skew == pytest.approx(tilt, abs=3e-6)
        assert after.at(30.0) - before.at(30.0) == pytest.approx(shift + 30.0 * tilt, abs=1e-4)


def _below(points):
    return LinesBelow(points).fit(0.005, 1.0)


def _between(points):
    return fit_between(points, points, INTERVAL, _below(points), 1.0)


def test_a_stall_tilts_no_line():
    points = cloud(1e-4, count=80)
    stalled = np.column_stack([np.arange(40.0, 60.0, 0.5), np.arange(20.0, 0.0, -0.5)])
    line = LinesBelow(np.concatenate([points, stalled])).fit(0.005, 1e-4)
    assert abs(line.skew) < STEEPEST / 100.0
    assert line.skew == pytest.approx(1e-4, abs=6e-5)
