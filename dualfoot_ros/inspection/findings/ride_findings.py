"""Findings on floors that carried the person."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ...core import Event, EventKind, FloorKind, Ride
from .finding import Finding, Severity
from .finding_kinds import FindingKind

LIFT_REMEDY = "the height is known less well; aids.barometer measures it"
VEHICLE_REMEDY = "where to is unknown; give the position anew, or begin a new recording"
WALKWAY_REMEDY = "the track follows its velocity, and its uncertainty has grown"
REMEDIES = {
    FloorKind.LIFT: LIFT_REMEDY,
    FloorKind.VEHICLE: VEHICLE_REMEDY,
    FloorKind.WALKWAY: WALKWAY_REMEDY,
}


def ride_findings(events: Sequence[Event]) -> Iterator[Finding]:
    """Yield one finding a ride, from the events of a walk, or from the newest event alone."""
    rides = [event for event in events if event.kind is EventKind.CARRIED]
    start_ns = next((e.stamp_ns for e in events if e.kind is EventKind.ALIGNED), None)
    for k, event in enumerate(rides):
        ride, after = event.payload, rides[k + 1] if k + 1 < len(rides) else None
        if not isinstance(ride, Ride) or ride.over:
            continue
        end = after.payload if after is not None else None
        known = end if isinstance(end, Ride) and end.over else ride
        text = f"the person is carried by {_floor(known)}"
        if start_ns is not None:
            text += f" from {(event.stamp_ns - start_ns) * 1e-9:.1f} s of the track on"
        if known.over:
            text += f" for {known.seconds:.1f} s"
        yield Finding(
            FindingKind.CARRIED, Severity.WARNING, text, REMEDIES[ride.kind], about=str(k)
        )


def _floor(ride: Ride) -> str:
    """Return what carries the person, in words."""
    x, y, up = ride.velocity
    if ride.kind is FloorKind.VEHICLE:
        return "a vehicle"
    if ride.kind is FloorKind.WALKWAY:
        return f"a walkway or an escalator at {math.hypot(x, y):.2f} m/s"
    if not ride.over:
        return "a lift"
    climbed = up * ride.seconds
    return f"a lift, {abs(climbed):.1f} m {'up' if climbed > 0.0 else 'down'},"
