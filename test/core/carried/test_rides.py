"""Lift, vehicle, escalator, walkway: found, said, and covered by the uncertainty."""

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, FloorKind, TrackerConfig
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording.importers import ImportOptions, import_recording

from ..following import live, same_bits
from ..harness import quick_engine, walk
from .rides import STANDING, WALKING, pairs, ride, tracked

ALL = [(name, False) for name in STANDING] + [(name, True) for name in WALKING]
KINDS = {
    "lift": FloorKind.LIFT,
    "lift down": FloorKind.LIFT,
    "fast lift": FloorKind.LIFT,
    "vehicle": FloorKind.VEHICLE,
    "escalator": FloorKind.WALKWAY,
    "walkway": FloorKind.WALKWAY,
}


@pytest.mark.parametrize(("name", "walking"), ALL)
def test_a_ride_is_said_once_when_it_begins_and_once_when_it_is_over(name, walking):
    rides = tracked(name, walking=walking).rides
    assert [(each.kind, each.over) for each in rides] == [
        (KINDS[name], False),
        (KINDS[name], True),
    ]


@pytest.mark.parametrize(("name", "walking"), ALL)
def test_the_uncertainty_contains_the_error_of_a_ride(name, walking):
    found = tracked(name, walking=walking)
    assert (np.abs(found.error) < 2.5 * found.sigma + 0.1).all()


@pytest.mark.parametrize(("name", "height"), [("lift", 4.0), ("lift down", -4.0)])
def test_the_height_of_a_lift_is_followed(name, height):
    found = tracked(name)
    last = found.rides[-1]
    assert last.velocity[2] * last.seconds == pytest.approx(height, abs=0.5)
    assert abs(found.error[2]) < 0.5


@pytest.mark.parametrize(("name", "walking"), [a for a in ALL if a[0] in WALKING])
def test_the_way_of_a_walkway_is_followed(name, walking):
    along = tracked(name, walking=walking).error[0]  # across it, the heading of the start errs
    assert abs(along) < 1.5


def test_without_constraints_a_ride_is_found_as_well():
    found = tracked("walkway", method="zupt")
    assert [each.over for each in found.rides] == [False, True]
    assert (np.abs(found.error) < 2.5 * found.sigma + 0.1).all()


def test_on_a_walkway_a_standing_person_moves():
    found = tracked("walkway").trajectory
    on = next(e for e in found.events if e.kind is EventKind.CARRIED)
    k = int(np.searchsorted(found.left.stamp_ns, on.detected_ns + 5_000_000_000))
    speed = np.hypot(*found.left.velocity[k, :2])
    assert speed == pytest.approx(0.65, abs=0.1)
    moved = found.left.position[k + 60] - found.left.position[k]
    assert np.hypot(*moved[:2]) == pytest.approx(speed, abs=0.02)


def test_a_ride_has_the_same_bits_live_and_offline():
    for name in ("lift", "walkway"):
        given = pairs(ride(name))
        offline = DualFootTracker(engine=quick_engine().name)
        found = live(DualFootTracker(engine=quick_engine().name), given)
        same_bits(found, offline.run(*given.series()))


def test_a_floor_is_not_looked_for_when_that_is_switched_off():
    made = ride("lift")
    config = TrackerConfig.from_mapping({"floor.watch": False})
    found = DualFootTracker(config, engine=quick_engine().name).run(made.left, made.right)
    assert not [e for e in found.events if e.kind is EventKind.CARRIED]
    assert found.left.position[-1, 2] < 1.0


def test_the_covariance_of_a_ride_stays_positive():
    found = tracked("walkway").trajectory
    for foot in (found.left, found.right):
        for covariance in (foot.position_covariance, foot.velocity_covariance):
            assert np.linalg.eigvalsh(covariance[::50]).min() > 0.0
    assert np.linalg.eigvalsh(found.relative_covariance[::50]).min() > -1e-9


def test_no_real_walk_is_carried(dual_feet):
    for path in sorted(dual_feet.glob("rectangle_*/*.mat"))[::4]:
        found = track(import_recording(ImportOptions(sources=(path,))))
        assert not [e for e in found.events if e.kind is EventKind.CARRIED], path.name


def test_a_constraint_to_a_wrong_distance_is_no_walkway():
    hard = {"spacing_vector.spacing": 0.5, "spacing_vector.spacing_std": 0.0}
    for settings in ({}, hard):
        config = TrackerConfig.from_mapping({"method": "spacing_vector", **settings})
        found = live(DualFootTracker(config, engine=quick_engine().name), walk(20.0))
        assert not [e for e in found.events if e.kind is EventKind.CARRIED]
