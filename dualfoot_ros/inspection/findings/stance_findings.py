"""Findings on the stances of a walk: missed, or impossible."""

from __future__ import annotations

from collections.abc import Iterator

from ..walk_facts import LEAST_HOLE_S, StepFacts, WalkFacts
from .finding import Finding, Severity
from .finding_kinds import FindingKind

LONGEST_STRIDE_M = 2.2
TWICE = 2.0  # times the median stride, from LEAST_DOUBLE_M on
LEAST_DOUBLE_M = 1.5  # a shorter stride may follow shuffling
LEAST_MISSED = 2
UNEQUAL = 2  # steps by which the feet may differ, or a share of them
UNEQUAL_SHARE = 0.05
WITHOUT_STANCE_S = 2.0
UNUSUAL = 1.5  # times the usual swing
MOVING_SHARE = 0.75
LEAST_STRIDES = 4
REMEDY = (
    "try a higher stance.threshold, or a shorter stance.min_stance; the track is wrong from there "
    "on"
)
TIME_REMEDY = (
    "check the time of the samples (the sampling rate, the unit of the stamps), the units and the "
    "scale of accelerometer and gyro; the track is wrong"
)
HOLE_REMEDY = (
    "check the link of the sensor and the load of the host; what was walked there is bridged, and "
    "the track is less certain from there on"
)


def find_missed_stances(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding for each foot that has fewer stances than the other one makes it have.

    Who starts and stops with the same foot makes two half strides with it each time, and one
    stride less with the other: half strides count as halves.
    """
    strides = {foot: steps.strides for foot, steps in facts.feet.items()}
    paced = {foot: steps.paced for foot, steps in facts.feet.items()}
    fewer = min(paced, key=lambda foot: paced[foot])
    for foot, steps in facts.feet.items():
        short = max(paced.values()) - steps.paced if foot == fewer else 0.0
        unequal = short > max(UNEQUAL, UNEQUAL_SHARE * max(paced.values()))
        missed = max(steps.missed, round(short) if unequal else 0)
        if missed >= LEAST_MISSED:
            why, remedy = _reason(steps.without_stance_hole_s)
            yield Finding(
                FindingKind.MISSED_STANCES,
                Severity.WARNING,
                f"{foot} foot: about {missed} stances are missed (left {strides['left']} and "
                f"right {strides['right']} steps){why}",
                remedy,
                foot,
            )


def find_long_strides(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding for each foot with a stride that nobody makes."""
    for foot, steps in facts.feet.items():
        double = max(LEAST_DOUBLE_M, TWICE * steps.median_stride_m)
        if steps.strides and steps.longest_stride_m > min(LONGEST_STRIDE_M, double):
            text, remedy = _describe_stride(steps)
            yield Finding(
                FindingKind.LONG_STRIDE, Severity.WARNING, f"{foot} foot: {text}", remedy, foot
            )


def _describe_stride(steps: StepFacts) -> tuple[str, str]:
    """Return text and remedy about strides that nobody makes: all of them, or the longest."""
    usual = f"{steps.median_stride_m:.2f} m"
    if steps.strides >= LEAST_STRIDES and steps.median_stride_m > LONGEST_STRIDE_M:
        return f"strides of {usual} in the median, which nobody makes", TIME_REMEDY
    why, remedy = _reason(steps.longest_hole_s, ", so a stance is missed in it")
    text = (
        f"a stride of {steps.longest_stride_m:.2f} m, {steps.longest_at_s:.1f} s after the start "
        "of the track"
    )
    return f"{text}, where {usual} are usual{why}" if steps.strides > 1 else text + why, remedy


def _reason(hole_s: float, else_why: str = "") -> tuple[str, str]:
    """Return why a stance is not there, in a hole of ``hole_s`` or in none, and the remedy."""
    if hole_s < LEAST_HOLE_S:
        return else_why, REMEDY
    return f": {hole_s:.2f} s of samples are missing there", HOLE_REMEDY


def find_time_without_stance(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding for each foot that has no stance for seconds of walking."""
    for foot, steps in facts.feet.items():
        unusual = steps.without_stance_s > UNUSUAL * steps.usual_swing_s
        if steps.without_stance_s > WITHOUT_STANCE_S and unusual:
            why, remedy = _reason(steps.without_stance_hole_s)
            yield Finding(
                FindingKind.NO_STANCE,
                Severity.WARNING,
                f"{foot} foot: no stance for {steps.without_stance_s:.1f} s, from "
                f"{steps.without_stance_at_s:.1f} s after the start of the track on{why}",
                remedy,
                foot,
            )


def find_stance_share(facts: WalkFacts) -> Iterator[Finding]:
    """Yield a finding for each foot that seems to stand while it moves."""
    for foot, steps in facts.feet.items():
        if steps.strides >= LEAST_STRIDES and steps.moving_share > MOVING_SHARE:
            yield Finding(
                FindingKind.STANCE_SHARE,
                Severity.WARNING,
                f"{foot} foot: it stands in {steps.moving_share:.0%} of each step, so swings are "
                "taken for stances",
                "try a lower stance.threshold, and check the unit of the angular rate",
                foot,
            )
