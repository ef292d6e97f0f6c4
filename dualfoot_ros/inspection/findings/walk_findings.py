"""All findings on the tracks of a walk."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ...core import Trajectory, stance_passings
from ..lateral_spacing import SideBySide, side_by_side
from ..stance_statistics import turn_taking
from ..walk_facts import WalkFacts, walk_facts
from .feet_findings import (
    find_clocks_apart,
    find_exchanged,
    find_feet_apart,
    find_mirrored_foot,
    find_spacing,
    find_unequal_ways,
)
from .finding import Finding
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


def walk_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings on a walk tracked with :func:`~.stance_statistics.unconstrained_config`.

    Which foot is on the left is observable in turns only, where the outer foot makes the longer
    way.  Without turns, or where the tracks have drifted too far, there is no finding on it.
    """
    facts = walk_facts(trajectory)
    for find in OF_WALK:
        yield from find(facts)
    if not any(steps.missed for steps in facts.feet.values()):
        yield from find_clocks_apart(turn_taking(trajectory))
    passings = stance_passings(trajectory)
    if len(passings) < LEAST_PASSINGS:
        return
    feet = side_by_side(passings)
    for find_sideways in OF_PASSINGS:
        yield from find_sideways(facts, feet)


def coupled_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings on a walk whose tracks a method holds together."""
    yield from find_feet_apart(walk_facts(trajectory))
