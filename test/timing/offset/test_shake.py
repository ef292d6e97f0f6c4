"""A shake is taken for one only where it is one, and the gait may contradict it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.simulation import ClockConfig, WalkConfig, simulate
from dualfoot_ros.timing import TimingError, offset_by_motion
from dualfoot_ros.timing.offset import motion_offset as motion
from dualfoot_ros.timing.offset.shake import find_shakes

OFFSET_S = 12.5


def walked(seed, **config):
    clocks = ClockConfig(), ClockConfig(offset=OFFSET_S)
    return simulate(WalkConfig(**config), clock=clocks, seed=seed)


def with_shake(walk, late_s=0.0, regularity=0.03):
    """Return both feet of a walk, shaken by hand while standing; the right one late."""
    rng = np.random.default_rng(0)
    turns = np.cumsum(0.5 * (1.0 + regularity * rng.standard_normal(14)))
    axis = np.array([1.0, 0.3, 0.2]) + 0.25 * rng.standard_normal((14, 3))
    mounted = np.eye(3), Rotation.from_euler("xyz", [100, -40, 20], degrees=True).as_matrix()
    series = []
    for foot, turn, late in (("left", mounted[0], 0.0), ("right", mounted[1], late_s)):
        true = getattr(walk, f"{foot}_truth").stamp_ns
        time = (true - walk.left_truth.stamp_ns[0]) * 1e-9 - late - 1.5
        phase = np.interp(time, turns, np.arange(14.0))
        envelope = np.clip(np.minimum(time - turns[0], turns[-1] - time) / 0.3, 0.0, 1.0)
        rate = np.array([np.interp(phase, np.arange(14.0), 5.0 * axis[:, k]) for k in range(3)]).T
        rate = rate * (np.sin(6.283 * phase) * envelope)[:, None] @ turn
        measured = getattr(walk, foot)
        series.append(replace(measured, angular_rate=measured.angular_rate + rate))
    return series


@pytest.mark.parametrize(
    ("route", "laps", "seed"),
    [("track", 1, 3), ("rectangle", 6, 1), ("rectangle", 6, 3)],
)
def test_one_of_hundreds_of_equal_steps_is_no_shake(route, laps, seed):
    walk = walked(seed, route=route, laps=laps, rate=60.0)
    assert find_shakes(walk.left, walk.right) == []


def test_who_asks_for_a_shake_where_there_is_none_is_refused():
    walk = walked(1, route="L")
    with pytest.raises(TimingError, match="no shake"):
        offset_by_motion(walk.left, walk.right, "shake")


@pytest.mark.parametrize("regularity", [0.0, 0.1])
def test_a_shake_before_a_walk_is_found_however_regular(regularity):
    left, right = with_shake(walked(1, route="L", standing=14.0), regularity=regularity)
    found = offset_by_motion(left, right)
    assert found.method == "shake"
    assert found.offset_ns * 1e-9 == pytest.approx(-OFFSET_S, abs=1e-4)
    assert found.notes == ()


def test_a_shake_by_which_the_feet_swing_together_yields_to_the_gait():
    left, right = with_shake(walked(1, route="L", standing=14.0), late_s=0.57)
    found = offset_by_motion(left, right)
    assert found.method == "motion"
    assert found.offset_ns * 1e-9 == pytest.approx(-OFFSET_S, abs=0.02)
    assert any("contradicts" in note for note in found.notes)
    asked = offset_by_motion(left, right, "shake")
    assert asked.method == "shake"
    assert any("contradicts" in note for note in asked.notes)


def test_a_shake_tells_the_cycle_the_gait_is_wrong_about(monkeypatch):
    left, right = with_shake(walked(1, route="L", standing=14.0))

    gait = motion.offset_by_gait

    def a_cycle_off(*feet):
        found = gait(*feet)
        return replace(found, offset_ns=found.offset_ns + round(1e9 * found.detail["cycle_s"]))

    monkeypatch.setattr(motion, "offset_by_gait", a_cycle_off)
    found = offset_by_motion(left, right)
    assert found.method == "shake"
    assert found.offset_ns * 1e-9 == pytest.approx(-OFFSET_S, abs=1e-4)
    assert any("contradicts" in note for note in found.notes)
