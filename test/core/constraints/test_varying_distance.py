"""The varying bound of Ma and Särkkä 2023, III-B, and feet adjacent."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig, Trajectory
from dualfoot_ros.core.constraints.varying_distance import (
    Strides,
    VaryingDistance,
    VaryingDistanceConfig,
    feet_adjacent,
)
from dualfoot_ros.simulation import Gait, WalkConfig, simulate
from dualfoot_ros.timing import align

from ..harness import simulated, walk
from .joint import MadeUpGait, apart, stance

PHASE = stance(0, 60, 90)
offsets = st.integers(-60, 60)


@given(offsets)
def test_the_bound_is_symmetric_about_feet_adjacent(offset):
    method = VaryingDistance(VaryingDistanceConfig())
    assert 0.2 < method.bounds()[0] < 0.6 < method.bounds()[1]
    assert method.bound(offset, PHASE) == method.bound(-offset, PHASE)


@given(offsets, offsets)
def test_the_bound_rises_away_from_feet_adjacent_and_stays_between_its_ends(a, b):
    config = VaryingDistanceConfig(minimum=0.2, maximum=0.9)
    method = VaryingDistance(config)
    near, far = sorted((abs(a), abs(b)))
    assert config.minimum <= method.bound(near, PHASE) <= method.bound(far, PHASE)
    assert method.bound(far, PHASE) <= config.maximum


def test_the_bound_is_the_minimum_at_feet_adjacent_and_the_maximum_at_the_ends():
    method = VaryingDistance(VaryingDistanceConfig(minimum=0.17, maximum=0.95))
    assert method.bound(0, PHASE) == pytest.approx(0.17, abs=1e-15)
    assert method.bound(35, PHASE) == pytest.approx(0.95, abs=2e-4)


def test_the_papers_sigma_is_five_samples_at_60_hz():
    """There the flipped Gaussian has risen by 1 - exp(-1/2) of the way five samples from FA."""
    at_60_hz = stance(0, 60, 90, rate=60.0)
    config = VaryingDistanceConfig(minimum=0.2, maximum=0.9)
    risen = (VaryingDistance(config).bound(5, at_60_hz) - 0.2) / 0.7
    assert risen == pytest.approx(1.0 - np.exp(-0.5), abs=1e-3)


def moving_period(others: slice) -> tuple[MadeUpGait, VaryingDistance]:
    """Return a gait in which the left foot moved over epochs 20..59."""
    still = np.zeros((2, 100), dtype=bool)
    still[0, :20] = still[0, 60:] = True
    still[1, others] = True
    samples = np.zeros((2, 100, 6))
    samples[0, 20:60, 4] = np.cos(np.linspace(-np.pi, np.pi, 40)) * 5.0
    return MadeUpGait(still, np.zeros((100, 2, 3)), samples, ended=(19, -1)), VaryingDistance(
        VaryingDistanceConfig(minimum=0.2, maximum=0.9)
    )


def test_every_epoch_of_the_moving_period_is_bounded_once_the_foot_has_landed():
    gait, method = moving_period(slice(0, 100))
    requests = method.on_stance_start(stance(0, 60, 68), gait)
    assert [r.epoch for r in requests] == list(range(20, 60))
    assert all(r.roll_back for r in requests)
    distances = []
    for request in requests:
        _, estimate = apart(1, 2.0)
        request.apply(estimate)
        distances.append(np.linalg.norm(estimate.relative_position()))
    assert abs(int(np.argmin(distances)) + 20 - 39.5) <= 0.5
    assert min(distances) == pytest.approx(0.2)
    assert distances[0] == pytest.approx(0.9, abs=0.05)


def test_only_while_the_other_foot_stands():
    gait, method = moving_period(slice(30, 50))
    requests = method.on_stance_start(stance(0, 60, 68), gait)
    assert [r.epoch for r in requests] == list(range(30, 50))


def test_a_moving_period_that_is_no_step_or_is_forgotten_is_left_alone():
    gait, _ = moving_period(slice(0, 100))
    assert not VaryingDistance(VaryingDistanceConfig(max_swing=0.3)).on_stance_start(
        stance(0, 60, 68), gait
    )
    gait.oldest = 30
    assert not VaryingDistance(VaryingDistanceConfig()).on_stance_start(stance(0, 60, 68), gait)
    gait.oldest, gait.ended = 0, (-1, -1)
    assert not VaryingDistance(VaryingDistanceConfig()).on_stance_start(stance(0, 60, 68), gait)


@pytest.mark.parametrize("rate", (60.0, 100.0, 200.0))
def test_feet_adjacent_on_a_simulated_walk_is_near_the_true_moment(rate):
    made = simulated(rate=rate)
    passes = made.walk.passes
    samples = np.array(
        [np.hstack([foot.specific_force, foot.angular_rate]) for foot in (made.left, made.right)]
    )
    gait = MadeUpGait(np.zeros((2, samples.shape[1]), dtype=bool), samples=samples)
    late_s = []
    for true, side in zip(made.moment_ns, passes.standing_side, strict=True):
        foot = 1 if side > 0 else 0
        stances = (made.left_stances, made.right_stances)[foot]
        step = int(np.searchsorted(stances[:, 0], true))
        bounds = np.searchsorted(made.left.stamp_ns, [stances[step - 1, 1], stances[step, 0]])
        found = feet_adjacent(gait, foot, range(*bounds))
        late_s.append((made.left.stamp_ns[found] - true) * 1e-9)
    assert len(late_s) > 30
    assert abs(np.median(late_s)) < 0.05
    assert np.percentile(np.abs(late_s), 90) < 0.1


def test_on_a_walk_no_distance_is_beyond_the_bound_of_its_moment():
    bounds = {"varying_distance.minimum": 0.2, "varying_distance.maximum": 0.9}
    config = TrackerConfig.from_mapping({"method": "varying_distance", **bounds})
    run = DualFootTracker(config).run(*walk(25.0).series())
    found = run.of_kind(EventKind.CONSTRAINT)
    assert sum(event.accepted for event in found) > 20
    for event in found:
        assert event.detail["distance_after"] <= event.detail["target"] + 1e-12


def tracked(speed: float, **settings: float) -> Trajectory:
    """Return a walk with turns tracked with the method, its feet passing at 0.22 m."""
    gait = Gait(min_distance=0.22)
    made = simulate(WalkConfig(route="figure_eight", rate=60.0, speed=speed, gait=gait), seed=2)
    named = {f"varying_distance.{name}": value for name, value in settings.items()}
    config = TrackerConfig.from_mapping({"method": "varying_distance", **named})
    return DualFootTracker(config).run(*align(made.left, made.right))


def pulled(run: Trajectory) -> float:
    """Return by how much the feet were pulled in all, m."""
    found = [e.detail for e in run.of_kind(EventKind.CONSTRAINT) if e.accepted]
    return sum(each["distance"] - each["distance_after"] for each in found)


@pytest.mark.parametrize("speed", (0.9, 1.5))
def test_bounds_from_the_walk_leave_feet_alone_that_pass_farther_apart_than_the_papers(speed):
    learnt, papers = tracked(speed), tracked(speed, minimum=0.2, maximum=0.9)
    assert pulled(learnt) < 0.5 * pulled(papers)


def test_the_bound_at_the_ends_follows_the_strides():
    strides = Strides()
    assert strides.step_m() is None
    for k in range(4):
        strides.add(0, np.array([1.4 * k, 0.0, 0.0]))
    assert strides.step_m() == pytest.approx(0.7 * 1.3)
    strides.forget_places()
    strides.add(0, np.array([50.0, 0.0, 0.0]))
    assert strides.step_m() == pytest.approx(0.7 * 1.3)
