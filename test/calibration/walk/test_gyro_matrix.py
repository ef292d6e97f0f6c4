"""Gyro matrices from walks: simulated sensors are recovered as far as the fit says."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.walk.filter_terms import symmetric
from dualfoot_ros.calibration.walk.foot_walk import foot_walk
from dualfoot_ros.calibration.walk.gyro_matrix import fit_matrix
from dualfoot_ros.calibration.walk.left_out import leave_each_out
from dualfoot_ros.calibration.walk.observability import advice, turns, weakest
from dualfoot_ros.calibration.walk.self_test import self_test
from dualfoot_ros.core import DualFootTracker
from dualfoot_ros.inspection import unconstrained_config
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import align

from .simulated import PIVOT, true_elements, walks

SEEDS = range(3)
FEET = ("left", "right")


def both_walks(seed, foot):
    """Return two walks of one sensor."""
    return [walks(seed)[foot], walks(seed, speed=0.9)[foot]]


@cache
def fitted(seed, foot, count=2):
    """Return the fit of a sensor from its first or both walks."""
    return fit_matrix(both_walks(seed, foot)[:count], PIVOT)


@pytest.fixture(scope="module")
def fits():
    """Return the fit of each sensor from two walks, by seed and foot."""
    return {(seed, foot): fitted(seed, foot) for seed in SEEDS for foot in FEET}


def test_simulated_sensors_are_recovered_within_the_stated_uncertainty(fits):
    nees = []
    for (seed, foot), fit in fits.items():
        error = fit.elements - true_elements(seed, foot)
        nees.append(error @ np.linalg.solve(fit.covariance[:6, :6], error) / 6.0)
    assert 0.2 < np.mean(nees) < 2.5, nees


def test_scale_factors_come_out_better_than_they_were(fits):
    true = np.array([true_elements(*sensor)[:3] for sensor in fits])
    left = np.array([fit.elements[:3] for fit in fits.values()]) - true
    assert np.sqrt((left**2).mean()) < 0.85 * np.sqrt((true**2).mean())


def test_a_known_matrix_put_on_the_samples_comes_back(fits):
    test = self_test(both_walks(0, "left"), fits[0, "left"])
    assert test.passed and np.abs(test.put).max() > 0.003
    assert test.error < 0.0008


def test_the_uncertainty_shrinks_with_every_walk(fits):
    one = fitted(1, "left", 1)
    two = fits[1, "left"]
    gained = one.covariance[:6, :6] - two.covariance[:6, :6]
    assert np.linalg.eigvalsh(gained).min() > -1e-8
    assert (two.elements_std <= one.noise.matrix).all()


def test_walks_of_one_sensor_agree_and_those_of_another_do_not():
    mine = both_walks(2, "right")
    other = replace(mine[1], rate=mine[1].rate @ (np.eye(3) + symmetric([0.03] * 6)).T)
    agree = leave_each_out(fitted(2, "right"))
    differ = leave_each_out(fit_matrix([mine[0], other], PIVOT))
    assert max(each.agreement for each in agree) < 2.0
    assert min(each.agreement for each in differ) > 2.0
    assert min(each.explained for each in agree) > max(each.explained for each in differ)


def test_one_walk_leaves_nothing_out():
    assert leave_each_out(fitted(1, "left", 1)) == ()


def test_a_straight_walk_is_told_what_walk_would_be_better():
    walk = walks(0, "straight")["left"]
    fit = fit_matrix([walk], PIVOT)
    said = list(advice(fit, turns([walk])))
    assert any("poorly observed" in each for each in said)
    assert any("figure of eight, both ways round" in each for each in said)
    assert weakest(fit).std > 0.9 * fit.noise.matrix


def test_turns_to_both_sides_are_counted():
    turned = turns([walks(0)["left"], walks(0)["right"]])
    assert turned.left == pytest.approx(turned.right, rel=0.2)
    assert turned.left > 2.0 * np.pi


def test_a_false_stance_in_the_swing_hardly_changes_the_fit():
    walk = walks(1)["left"]
    stance = walk.stance.copy()
    swing = np.flatnonzero(~stance)[60 * 5]
    stance[swing : swing + 5] = True
    disturbed = fit_matrix([replace(walk, stance=stance)], PIVOT)
    plain = fitted(1, "left", 1)
    assert (np.abs(disturbed.elements - plain.elements) < 0.5 * plain.elements_std).all()


def test_a_walk_of_a_few_steps_is_refused():
    made = simulate(WalkConfig(route="standing", rate=60.0, standing=6.0), seed=0)
    left, right = align(made.left, made.right)
    config = unconstrained_config()
    tracks = DualFootTracker(config).run(left, right)
    with pytest.raises(CalibrationError, match="stances of the left foot were found; needed"):
        foot_walk(left, tracks, "left", config)
