"""All findings on the tracks of a walk."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from ...core import LOST_HEADING_STD, Trajectory, stance_passings
from ..lateral_spacing import SideBySide, side_by_side
from ..walk_facts import WalkFacts, walk_facts
from .feet_findings import (
    find_exchanged,
    find_feet_apart,
    find_mirrored_foot,
    find_spacing,
    find_unequal_ways,
)
from .finding import Finding, Severity
from .finding_kinds import FindingKind
from .stance_findings import (
    find_long_strides,
    find_missed_stances,
    find_stance_share,
    find_time_without_stance,
)

LEAST_PASSINGS = 8

OF_WALK: Sequence[Callable[[WalkFacts], Iterator[Finding]]] = (
    find_missed_stances,
    find_long_strides,
    find_time_without_stance,
    find_stance_share,
    find_unequal_ways,
    find_mirrored_foot,
)
OF_PASSINGS: Sequence[Callable[[WalkFacts, SideBySide], Iterator[Finding]]] = (
    find_exchanged,
    find_spacing,
)


LOST_REMEDY = (
    "give the pose of the person anew (initialpose, set_pose); for hours of walking use an aid "
    "that knows the heading (aids.magnetic_heading, aids.straight_lines)"
)


def lost_heading(std: float) -> Finding:
    """Return the finding on a heading that is known to ``std`` (rad) and no better."""
    text = f"the heading is lost: it is off by {math.degrees(std):.0f} degrees (one sigma)"
    return Finding(FindingKind.LOST_HEADING, Severity.WARNING, text, LOST_REMEDY)


def walk_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings on a walk tracked with :func:`~.stance_statistics.unconstrained_config`.

    Which foot is on the left is observable in turns only, where the outer foot makes the longer
    way.  Without turns, or where the tracks have drifted too far, there is no finding on it.
    """
    facts = walk_facts(trajectory)
    for find in OF_WALK:
        yield from find(facts)
    passings = stance_passings(trajectory)
    if len(passings) < LEAST_PASSINGS:
        return
    feet = side_by_side(passings)
    for find_sideways in OF_PASSINGS:
        yield from find_sideways(facts, feet)


def coupled_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings on a walk whose tracks a method holds together."""
    yield from find_feet_apart(walk_facts(trajectory))
    yield from find_lost_heading(trajectory)


def find_lost_heading(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield a finding when the heading is lost at the end; nothing without covariances."""
    there = [foot for foot in (trajectory.left, trajectory.right) if foot.present[-1]]
    stds = [math.sqrt(foot.attitude_covariance[-1][2, 2]) for foot in there]
    std = sum(stds) / max(1, len(stds))
    if std > LOST_HEADING_STD:
        yield lost_heading(std)
