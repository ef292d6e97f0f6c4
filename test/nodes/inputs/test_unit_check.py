import numpy as np
import pytest

from dualfoot_ros.nodes.inputs.unit_check import WINDOW, UnitCheck


def said_about(samples):
    warned = []
    check = UnitCheck(warned.append, "left")
    for values in samples:
        check.add(list(values))
    assert [finding.sentence for finding in check.findings] == warned
    return warned


def standing(force, rate=0.01):
    return [(0.0, 0.0, force, 0.0, 0.0, rate)] * (3 * WINDOW)


def test_standing_in_si_units_is_no_reason_for_suspicion():
    assert said_about(standing(9.8)) == []


def test_gravity_of_about_one_is_said_once_to_be_g():
    (sentence,) = said_about(standing(1.0))
    assert "units.specific_force" in sentence and "the left foot" in sentence


def test_rates_beyond_full_scale_are_said_once_to_be_degrees():
    walking = [(0.0, 0.0, 9.8, 0.0, 300.0 * np.sin(k / 9.0), 0.0) for k in range(5 * WINDOW)]
    (sentence,) = said_about(walking)
    assert "deg/s" in sentence


def test_a_single_shock_beyond_full_scale_is_no_unit():
    assert said_about([(0.0, 0.0, 9.8, 50.0, 0.0, 0.0), *standing(9.8)]) == []


def test_specific_force_without_gravity_is_said():
    (sentence,) = said_about(standing(0.05))
    assert "gravity seems to be removed" in sentence


@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
def test_what_is_not_finite_is_left_to_others(bad):
    assert said_about([(bad, 0.0, 0.0, 0.0, 0.0, 0.0)] * (2 * WINDOW)) == []


def test_a_real_walk_is_no_reason_for_suspicion():
    from dualfoot_ros.simulation import WalkConfig, simulate

    left = simulate(WalkConfig(route="straight", speed=1.8), seed=2).left
    assert said_about(np.hstack([left.specific_force, left.angular_rate])) == []
