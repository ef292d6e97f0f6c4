"""Findings on what a track started from: a restless or short stand, or none at all."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from ...core import Event, EventKind
from .finding import Finding, Severity
from .finding_kinds import FindingKind

MINUTE_S = 60.0
HALF_TURN_DEG = 180.0
STARTS = {
    "restless_stand": "the track starts from a short or restless stand",
    "first_stance": "nobody stood before the walk, so the track starts from its first stances",
}
REMEDY = (
    "stand still with both feet for some seconds, now or at the end; keep the gyro biases of "
    "these sensors (--bias-memory, parameter bias_memory of fusion)"
)


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
        REMEDY,
    )
