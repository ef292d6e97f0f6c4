"""Findings on the tracks of both feet against each other."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..lateral_spacing import SideBySide
from ..stance_statistics import TurnTaking
from ..walk_facts import WalkFacts
from .finding import Finding, Severity
from .finding_kinds import FindingKind

APART_M = 1.2
WAYS_SHARE = 0.1
WAYS_PER_TURN_M = 0.25  # the outer foot goes farther
LEAST_WAY_M = 10.0
MIRRORED = -0.5  # slope of one course over the other, 1 where they agree
SIGMAS = 3.0
SPACING_M = (0.05, 0.5)
SPACING_KNOWN_M = 0.05  # standard deviation beyond which nothing is said of the spacing
FARTHEST_EXCHANGED_M = -0.5
MOST_JUMPS = 2
OFF_TURN = 0.12  # of a cycle; real walks have up to 0.02, a limp rarely more than 0.1
LEAST_CYCLES = 8
ONE_SHOE = 0.45  # of a cycle: two sensors that stand together
STEADY = 0.8
LEAST_LEAD = 2  # strides of one foot while the other one stands: nobody makes them
LEAST_STARTS = 2  # starts and stops that agree
APART_REMEDY = (
    "find the offset with 'dualfoot sync BAG -o ALIGNED', or give it on import (--right-offset) "
    "or live (stamping.right_offset); a heavy limp looks alike"
)


def find_feet_apart(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding when tracks of coupled feet are apart where one foot passes the other."""
    if facts.widest_m > APART_M:
        yield Finding(
            FindingKind.FEET_APART,
            Severity.WARNING,
            f"the tracks of the feet are {facts.widest_m:.1f} m apart where one passes the other, "
            f"{facts.widest_at_s:.1f} s after the start of the track; at least one of them is "
            "wrong",
            "look at the other warnings, at units, axes and stamps of both sensors, and whether "
            "both are of this walk",
        )


def find_clocks_apart(turns: TurnTaking) -> Iterator[Finding]:
    """Yield a finding when the feet do not take turns, as their stamps say.

    Clocks that are a whole cycle apart show at starts and stops only, and not at all of them.
    """
    seem = "so the clocks of the sensors seem to be apart"
    steady = turns.cycles >= LEAST_CYCLES and turns.steadiness > STEADY
    leads, off = turns.leads, abs(turns.late_s) / turns.cycle_s
    if steady and OFF_TURN < off < ONE_SHOE:
        when = "late" if turns.late_s > 0.0 else "early"
        text = (
            f"the right foot stands {abs(turns.late_s):.2f} s too {when} for the steps of the "
            f"left one, {seem} by that, or by that and whole cycles of {turns.cycle_s:.2f} s"
        )
    elif (
        len(leads) >= LEAST_STARTS
        and len({lead > 0 for lead in leads}) == 1
        and max(map(abs, leads)) >= LEAST_LEAD
    ):
        foot = "left" if leads[0] > 0 else "right"
        text = (
            f"the {foot} foot makes up to {max(map(abs, leads))} strides before the other one "
            f"walks, or stands as early before it, {seem} by a stride or more"
        )
    else:
        return
    yield Finding(FindingKind.CLOCKS_APART, Severity.WARNING, text, APART_REMEDY)


def find_unequal_ways(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding when one foot goes much farther than the other."""
    left, right = (facts.feet[foot].way_m for foot in ("left", "right"))
    allowed = WAYS_SHARE * max(left, right) + WAYS_PER_TURN_M * abs(facts.turned_rad)
    if max(left, right) > LEAST_WAY_M and abs(left - right) > allowed:
        yield Finding(
            FindingKind.UNEQUAL_WAYS,
            Severity.WARNING,
            f"the feet go different ways: left {left:.1f} m, right {right:.1f} m",
            "check the scale of both accelerometers and gyros, missed stances, and that both "
            "recordings are of this walk",
        )


def find_mirrored_foot(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding when one foot turns left where the other turns right."""
    if facts.turns_alike < MIRRORED:
        yield Finding(
            FindingKind.MIRRORED_FOOT,
            Severity.WARNING,
            "the feet turn in opposite directions, so one track is the mirror image of the other",
            "one of the accelerometers may have the wrong sign: at rest it has to read +9.8 m/s^2 "
            "along the axis that points up",
        )


def find_spacing(facts: WalkFacts, feet: SideBySide) -> Iterator[Finding]:
    """Yield a finding when the feet pass each other in a distance that nobody walks with."""
    if not _is_trusted(facts, feet):
        return
    if _is_one_shoe(feet) or feet.spacing_m - SIGMAS * feet.std_m > SPACING_M[1]:
        yield Finding(
            FindingKind.SPACING,
            Severity.WARNING,
            f"the feet pass each other in a lateral distance of {feet.spacing_m:.2f} +- "
            f"{feet.std_m:.2f} m, where {SPACING_M[0]:g} to {SPACING_M[1]:g} m are possible",
            "check the scale of the sensors; with both on one shoe use the method rigid_pair",
        )


def find_exchanged(facts: WalkFacts, feet: SideBySide) -> Iterator[Finding]:
    """Yield a finding when the left foot is surely on the right of the right one.

    Surely: the tracks are whole, the distance is one of feet, and it has the same sign in both
    halves of the walk.
    """
    if not _is_trusted(facts, feet) or feet.sigmas >= -SIGMAS:
        return
    if feet.spacing_m > FARTHEST_EXCHANGED_M and feet.halves_agree:
        yield Finding(
            FindingKind.EXCHANGED_FEET,
            Severity.WARNING,
            f"left and right seem to be exchanged: in the turns of this walk "
            f"({math.degrees(feet.turned_rad):.0f} degrees) the left foot goes "
            f"{-feet.spacing_m:.2f} +- {feet.std_m:.2f} m on the right of the right one",
            "exchange --left-topic and --right-topic, or the files on import; if they are right, "
            "check the signs of both accelerometers (+9.8 m/s^2 upwards at rest)",
        )


def _is_one_shoe(feet: SideBySide) -> bool:
    return abs(feet.spacing_m) + SIGMAS * feet.std_m < SPACING_M[0]


def _is_trusted(facts: WalkFacts, feet: SideBySide) -> bool:
    """Return whether tracks are whole and consistent enough to compare them sideways."""
    whole = not any(steps.missed for steps in facts.feet.values())
    alike = not facts.turns_alike < -MIRRORED  # also where there are no turns to compare
    return whole and alike and feet.jumps <= MOST_JUMPS
