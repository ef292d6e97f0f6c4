"""Findings on floors that carried the person, from the events of a walk."""

import pytest

from dualfoot_ros.core import Event, EventKind, FloorKind, Ride
from dualfoot_ros.inspection import FindingKind, Severity, ride_findings

SECOND = 1_000_000_000


def event(stamp_s, kind=FloorKind.LIFT, velocity=(0.0, 0.0, 0.0), seconds=0.0, over=False):
    ride = Ride(kind, velocity, 0.0, 0.05, seconds, over)
    stamp = round(stamp_s * SECOND)
    return Event(EventKind.CARRIED, stamp, "both", stamp, payload=ride)


def aligned(stamp_s=0.0):
    return Event(EventKind.ALIGNED, round(stamp_s * SECOND), "both", 0)


def test_a_walk_without_rides_has_no_finding():
    assert list(ride_findings([aligned()])) == []


@pytest.mark.parametrize(("climb", "words"), [(0.8, "12.0 m up"), (-0.8, "12.0 m down")])
def test_a_lift_is_told_with_its_way_and_time(climb, words):
    over = event(45.0, velocity=(0.0, 0.0, climb), seconds=15.0, over=True)
    (found,) = ride_findings([aligned(10.0), event(30.0), over])
    assert (found.kind, found.severity) == (FindingKind.CARRIED, Severity.WARNING)
    assert words in found.text
    assert "from 20.0 s" in found.text and "for 15.0 s" in found.text


def test_each_ride_is_a_finding_of_its_own():
    rides = [
        event(30.0, FloorKind.WALKWAY, (0.6, 0.0, 0.0)),
        event(50.0, FloorKind.WALKWAY, (0.6, 0.0, 0.0), 20.0, over=True),
        event(80.0, FloorKind.VEHICLE),
    ]
    first, second = ride_findings([aligned(), *rides])
    assert "0.60 m/s" in first.text and "vehicle" in second.text
    assert first.key != second.key
    assert first.remedy != second.remedy


def test_the_newest_event_alone_says_whether_a_ride_goes_on():
    assert len(list(ride_findings([event(30.0)]))) == 1
    assert list(ride_findings([event(45.0, seconds=15.0, over=True)])) == []
