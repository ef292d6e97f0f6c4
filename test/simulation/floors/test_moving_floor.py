"""Floors that move under the simulated walker."""

import numpy as np
import pytest

from dualfoot_ros.simulation import (
    MovingFloorConfig,
    SimulationError,
    WalkConfig,
    on_moving_floor,
    walk,
)

NOWHERE, FORWARD = np.zeros(3), np.eye(3)
STOP = WalkConfig(route="straight", standing=3.0, stops=1, stop_duration=14.0)


@pytest.fixture(scope="module")
def plain():
    return walk(STOP, 0)


@pytest.fixture(scope="module")
def stand_s(plain):
    """Begin and end of the stop, s."""
    prints = plain.footprints
    row = 2 + int(np.argmax(prints.heel_off_s[3:] - prints.flat_s[2:-1]))
    return float(prints.flat_s[row]), float(prints.heel_off_s[row + 1])


def at(walked, foot, time_s):
    """Return the motion of a shoe at a time."""
    return walked.shoes[foot].poses(np.array([time_s]), NOWHERE, FORWARD)


def way(moved, plain, foot, time_s):
    """Return by how much (3,) m the floor has carried a shoe."""
    return at(moved, foot, time_s).position[0] - at(plain, foot, time_s).position[0]


def test_a_lift_takes_both_feet_up_by_its_way(plain, stand_s):
    moved = on_moving_floor(plain, MovingFloorConfig(kind="lift", way=4.0))
    for foot in range(2):
        assert np.allclose(way(moved, plain, foot, stand_s[0]), 0.0, atol=1e-9)
        assert np.allclose(way(moved, plain, foot, stand_s[1]), [0.0, 0.0, 4.0], atol=1e-6)


def test_a_lift_accelerates_as_it_is_told(plain, stand_s):
    config = MovingFloorConfig(kind="lift", way=-4.0, speed=1.5, acceleration=1.2)
    moved = on_moving_floor(plain, config)
    time_s = np.arange(*stand_s, 0.01)
    carried = moved.shoes[0].poses(time_s, NOWHERE, FORWARD)
    still = plain.shoes[0].poses(time_s, NOWHERE, FORWARD)
    gained = carried.velocity[:, 2] - still.velocity[:, 2]
    assert gained.min() == pytest.approx(-1.5, abs=1e-3)
    assert np.abs(np.gradient(gained, 0.01)).max() == pytest.approx(1.2, abs=0.02)


def test_a_standing_foot_has_the_velocity_of_the_walkway(plain, stand_s):
    moved = on_moving_floor(plain, MovingFloorConfig(kind="walkway", speed=0.7))
    middle = 0.5 * sum(stand_s)
    for foot in range(2):
        velocity = at(moved, foot, middle).velocity - at(plain, foot, middle).velocity
        assert np.allclose(np.linalg.norm(velocity), 0.7, atol=1e-6)
        after = plain.duration_s - 0.2
        velocity = at(moved, foot, after).velocity - at(plain, foot, after).velocity
        assert np.allclose(velocity, 0.0, atol=1e-6)


def test_an_escalator_climbs_between_its_level_ends(plain, stand_s):
    moved = on_moving_floor(plain, MovingFloorConfig(kind="escalator", speed=0.5))
    middle = 0.5 * sum(stand_s)
    velocity = at(moved, 0, middle).velocity - at(plain, 0, middle).velocity
    assert velocity[0, 2] == pytest.approx(0.25, abs=1e-6)
    ends = [way(moved, plain, foot, plain.duration_s - 0.2)[2] for foot in range(2)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-9)
    assert 2.0 < ends[0] < 5.0


def test_the_feet_step_on_and_off_one_after_the_other():
    plain = walk(WalkConfig(route="straight", standing=3.0), 0)
    moved = on_moving_floor(plain, MovingFloorConfig(kind="walkway", walking=True))
    ends = [way(moved, plain, foot, plain.duration_s - 0.2) for foot in range(2)]
    assert np.allclose(ends[0], ends[1], atol=1e-9)
    assert np.hypot(*ends[0][:2]) > 10.0


@pytest.mark.parametrize("kind", ["lift", "walkway"])
def test_a_floor_to_stand_on_needs_a_stop(kind):
    with pytest.raises(SimulationError, match="stops is 0"):
        on_moving_floor(walk(WalkConfig(route="straight"), 0), MovingFloorConfig(kind=kind))


def test_a_stop_that_is_too_short_for_the_way_is_refused(plain):
    with pytest.raises(SimulationError, match="stop_duration is 14 s"):
        on_moving_floor(plain, MovingFloorConfig(kind="lift", way=40.0))
