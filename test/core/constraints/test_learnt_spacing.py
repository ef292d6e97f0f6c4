"""The spacing learnt from the walk: turns show it, and its sigma is honest where none do."""

import numpy as np
import pytest

from dualfoot_ros.core import EventKind, TrackerConfig
from dualfoot_ros.core.constraints.learnt_spacing import PRIOR_M, PRIOR_STD_M, SpacingLearner
from dualfoot_ros.core.results.payloads import Passing
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import WalkConfig, simulate


def learner_after(made):
    """Return a learner that saw the passings of the default track of a simulated walk."""
    run, learner = track(Recording(made.left, made.right), TrackerConfig()), SpacingLearner()
    for event in run.of_kind(EventKind.CONSTRAINT):
        if isinstance(event.payload, Passing):
            before, after = (np.array(x[:2]) for x in (event.payload.before, event.payload.after))
            learner.add(before, after, event.payload.heading)
    return learner


@pytest.mark.parametrize("route", ["rectangle", "figure_eight", "track"])
def test_the_spacing_of_a_simulated_walk_is_within_two_and_a_half_sigma(route):
    seeds = range(2 if route == "track" else 3)
    for seed in seeds:
        made = simulate(WalkConfig(route=route, rate=60.0), seed=seed)
        found = learner_after(made)
        assert abs(found.spacing_m - 0.148) < 2.5 * found.std_m, seed
        assert found.std_m < PRIOR_STD_M


def test_a_straight_line_says_nothing_of_it():
    learner = SpacingLearner()
    for _ in range(200):
        learner.add(np.array([0.0, 0.35]), np.array([0.0, 0.35]), 0.0)
    assert abs(learner.spacing_m - PRIOR_M) < PRIOR_STD_M
    assert learner.std_m > 0.8 * PRIOR_STD_M


def circling(turns, ahead_m, spacing_m=0.12, seed=0):
    """Return a learner after laps of 300 passings (+1 counter-clockwise, -1 clockwise each).

    One foot runs ahead by ``ahead_m`` a passing, as strides that are measured too long make it.
    """
    learner, rng = SpacingLearner(), np.random.default_rng(seed)
    placement, heading = np.array([0.05, -0.03]), 0.0
    for way in turns:
        for _ in range(300):
            heading += way * 2.0 * np.pi / 300
            ahead = np.array([np.cos(heading), np.sin(heading)])
            placement += ahead_m * ahead
            free = placement + spacing_m * np.array([-ahead[1], ahead[0]])
            free += rng.normal(0.0, 0.02, 2)
            learner.add(free, free, heading)
    return learner


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("ahead_m", [-0.004, 0.0, 0.004])
def test_a_foot_that_runs_ahead_in_circles_is_not_taken_for_a_spacing(way, ahead_m):
    learner = circling([way] * 11, ahead_m)
    assert abs(learner.spacing_m - 0.12) < 2.5 * learner.std_m
    assert learner.spacing_m > 0.05


def test_both_ways_round_tell_it_from_a_spacing():
    one_way, both_ways = circling([1, 1, 1, 1], 0.004), circling([1, -1, 1, -1], 0.004)
    assert both_ways.std_m < 0.8 * one_way.std_m
    assert both_ways.spacing_m == pytest.approx(0.12, abs=0.03)
