"""Findings on what a tracker itself says of a walk: its start, floors, lost feet, and its end."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from ...core import FEET, LOST_HEADING_STD, Event, EventKind, Trajectory
from .finding import Finding, Severity
from .finding_kinds import FindingKind
from .rate_findings import rate_findings
from .ride_findings import ride_findings

MINUTE_S = 60.0
HALF_TURN_DEG = 180.0
STARTS = {
    "restless_stand": "the track starts from a short or restless stand",
    "first_stance": "nobody stood before the walk, so the track starts from its first stances",
}
RESTLESS_REMEDY = (
    "stand still with both feet for some seconds, now or at the end; keep the gyro biases of "
    "these sensors (--bias-memory, parameter bias_memory of fusion)"
)
LOST_FOOT_REMEDY = (
    "look for spikes, shocks, clipping or a stuck sensor there; its track goes on beside the "
    "other foot, less certain"
)
LOST_REMEDY = (
    "give the pose of the person anew (initialpose, set_pose); for hours of walking use an aid "
    "that knows the heading (aids.magnetic_heading, aids.straight_lines)"
)


def tracker_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings that hold for any method, for two feet and for one alone."""
    yield from start_findings(trajectory.events)
    yield from ride_findings(trajectory.events)
    yield from rate_findings(trajectory)
    yield from lost_foot_findings(trajectory.events)
    yield from end_findings(trajectory)


def start_findings(events: Iterable[Event]) -> Iterator[Finding]:
    """Yield what is to be said about the alignments among ``events``."""
    for event in events:
        if event.kind is EventKind.ALIGNED and event.detail["start"] in STARTS:
            yield restless_start(event.detail["start"], event.detail["gyro_bias_std"])


def restless_start(start: str, bias_std: float) -> Finding:
    """Return the finding on a start, with the heading error to expect after a minute."""
    degrees = math.degrees(bias_std * MINUTE_S)
    expected = f"{degrees:.0f} degrees" if degrees < HALF_TURN_DEG else "any size"
    return Finding(
        FindingKind.RESTLESS_START,
        Severity.WARNING,
        f"{STARTS[start]}: the gyro bias is known to {math.degrees(bias_std):.2g} deg/s, and the "
        f"heading may be off by {expected} after a minute of walking (one sigma)",
        RESTLESS_REMEDY,
    )


def lost_foot_findings(events: Sequence[Event]) -> Iterator[Finding]:
    """Yield a finding on each foot that was lost, from the events of a walk or the newest one."""
    start_ns = next((e.stamp_ns for e in events if e.kind is EventKind.ALIGNED), None)
    for foot in FEET:
        lost = [e for e in events if e.kind is EventKind.LOST and e.foot == foot]
        if not lost:
            continue
        text = f"{foot} foot: it landed faster than a foot can: its samples were wrong or missing"
        if start_ns is not None:
            first_s = (lost[0].stamp_ns - start_ns) * 1e-9
            text += f", first {first_s:.1f} s after the start of the track"
            text += f", {len(lost)} times in all" if len(lost) > 1 else ""
        yield Finding(FindingKind.LOST_FOOT, Severity.WARNING, text, LOST_FOOT_REMEDY, about=foot)


def lost_heading(std: float) -> Finding:
    """Return the finding on a heading that is known to ``std`` (rad) and no better."""
    text = f"the heading is lost: it is off by {math.degrees(std):.0f} degrees (one sigma)"
    return Finding(FindingKind.LOST_HEADING, Severity.WARNING, text, LOST_REMEDY)


def end_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield a finding when the heading is lost at the end of a track."""
    if trajectory.heading_std > LOST_HEADING_STD:
        yield lost_heading(trajectory.heading_std)
