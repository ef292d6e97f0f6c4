"""Findings on the tracks of a walk: whether left and right sensor are exchanged."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ...core import Trajectory, stance_passings
from ..lateral_spacing import side_by_side
from .finding import Finding, Severity
from .finding_kinds import FindingKind

SIGMAS = 3.0
LEAST_PASSINGS = 8


def walk_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings on a walk tracked with :func:`~.stance_statistics.free_config`.

    Which foot is on the left is observable in turns only, where the outer foot makes the longer
    way.  Without turns, or where the tracks have drifted too far, there is no finding.
    """
    passings = stance_passings(trajectory)
    if len(passings) < LEAST_PASSINGS:
        return
    feet = side_by_side(passings)
    if feet.sigmas < -SIGMAS:
        yield Finding(
            FindingKind.EXCHANGED_FEET,
            Severity.WARNING,
            f"left and right seem to be exchanged: in the turns of this walk "
            f"({math.degrees(feet.turned_rad):.0f} degrees) the left foot goes "
            f"{-feet.spacing_m:.2f} +- {feet.std_m:.2f} m on the right of the right one",
            "exchange --left-topic and --right-topic, or the files on import",
        )
