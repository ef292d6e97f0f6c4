"""Faults injected into simulated walks are named; walks of several gaits show nothing."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker
from dualfoot_ros.inspection import (
    FindingKind,
    coupled_findings,
    findings_of,
    unconstrained_config,
    walk_findings,
)
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import align

SHORT = {"standing": 4.0, "final_standing": 1.0}


def findings(left, right):
    found = list(findings_of(Recording(left, right)))
    pairs = align(left, right)
    found += walk_findings(DualFootTracker(unconstrained_config()).run(*pairs))
    found += coupled_findings(DualFootTracker().run(*pairs))
    return {finding.kind for finding in found}


@pytest.fixture(scope="module")
def walk():
    return simulate(WalkConfig.from_mapping({"route": "rectangle", "rate": 60.0, **SHORT}), seed=5)


@pytest.mark.parametrize(
    "gait",
    [
        {"route": "figure_eight", "rate": 60.0},
        {"route": "L", "rate": 200.0, "speed": 1.7},
        {"speed": 0.6},
        {"mounting": "heel"},
        {"gait": {"wobble": 0.3, "roll_over": 0.12}},
        {"route": "straight", "gait": {"tremor": 0.04, "footprint_std": 0.05, "cycle_std": 0.05}},
    ],
    ids=str,
)
def test_walks_of_several_gaits_show_nothing(gait):
    made = simulate(WalkConfig.from_mapping({**SHORT, **gait}), seed=11)
    assert findings(made.left, made.right) == set()


def force(series, by):
    return replace(series, specific_force=series.specific_force @ np.asarray(by).T)


def shaken(series):
    """Return the series with 4 s in which the gyro shakes, so that no stance is found."""
    rate, at = series.angular_rate.copy(), len(series) // 2
    part = slice(at, at + round(4.0 * series.rate_hz))
    rate[part] += np.random.default_rng(0).normal(0.0, 3.0, rate[part].shape)
    return replace(series, angular_rate=rate)


def test_stances_that_are_missed_are_told_in_every_way(walk):
    kinds = findings(shaken(walk.left), walk.right)
    assert {FindingKind.MISSED_STANCES, FindingKind.LONG_STRIDE, FindingKind.NO_STANCE} <= kinds


def test_a_negated_accelerometer_makes_a_mirrored_foot(walk):
    assert FindingKind.MIRRORED_FOOT in findings(force(walk.left, -np.eye(3)), walk.right)


def test_a_negated_axis_of_the_accelerometer_is_told_by_the_gyro(walk):
    assert FindingKind.RATE_AXES in findings(force(walk.left, np.diag([1, 1, -1])), walk.right)


def test_an_accelerometer_ten_percent_too_small_is_told_by_gravity(walk):
    assert FindingKind.GRAVITY in findings(force(walk.left, 0.9 * np.eye(3)), walk.right)


def test_exchanged_feet_are_told_and_nothing_else(walk):
    assert findings(walk.right, walk.left) == {FindingKind.EXCHANGED_FEET}


def test_exchanged_feet_are_not_told_of_tracks_that_miss_stances(walk):
    assert FindingKind.EXCHANGED_FEET not in findings(shaken(walk.right), walk.left)


def test_the_foot_of_another_walk_does_not_fit(walk):
    other = simulate(WalkConfig.from_mapping({"route": "straight", "rate": 60.0, **SHORT}), seed=2)
    kinds = findings(walk.left, other.right)
    assert {FindingKind.FEET_APART} <= kinds
