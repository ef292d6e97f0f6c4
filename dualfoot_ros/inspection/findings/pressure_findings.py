"""Findings on the sensors of air pressure; all are warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...core import PressureSeries
from ...core.aids import RANGE_PA
from ..pressure_facts import PressureFacts, pressure_facts, wearer_words
from ..quality import Quality
from .finding import Finding, Severity
from .finding_kinds import FindingKind

HECTO = 100.0


def pressure_findings(
    pressure: Mapping[str, PressureSeries], qualities: Mapping[str, Quality]
) -> Iterator[Finding]:
    """Yield the findings on the sensors, by where they are worn."""
    for worn, series in pressure.items():
        facts = pressure_facts(series)
        yield from find_pressure_range(worn, facts)
        yield from find_pressure_stamps(worn, facts)
        yield from find_pressure_clock(worn, facts, qualities)


def find_pressure_range(worn: str, facts: PressureFacts) -> Iterator[Finding]:
    """Yield a finding when samples are no air pressure in Pa."""
    if not facts.out_of_range:
        return
    text = (
        f"pressure of {wearer_words(worn)}: {facts.out_of_range} of {facts.samples} samples are "
        f"no air pressure in Pa (the median is {facts.median:.6g})"
    )
    remedy = ""
    if RANGE_PA[0] < facts.median * HECTO < RANGE_PA[1]:
        text = f"{text}, so they are in hPa"
        remedy = "publish Pa, as sensor_msgs/FluidPressure has it"
    else:
        text = f"{text}; they are left out"
    yield Finding(FindingKind.PRESSURE_RANGE, Severity.WARNING, text, remedy, worn)


def find_pressure_stamps(worn: str, facts: PressureFacts) -> Iterator[Finding]:
    """Yield a finding when stamps repeat or go back."""
    if facts.out_of_order:
        yield Finding(
            FindingKind.PRESSURE_STAMPS,
            Severity.WARNING,
            f"pressure of {wearer_words(worn)}: {facts.out_of_order} duplicate or out-of-order "
            "stamps are left out",
            about=worn,
        )


def find_pressure_clock(
    worn: str, facts: PressureFacts, qualities: Mapping[str, Quality]
) -> Iterator[Finding]:
    """Yield a finding when the sensor shares no time with a foot."""
    apart = [
        foot
        for foot, quality in qualities.items()
        if facts.end_s < quality.start_s or facts.start_s > quality.end_s
    ]
    if apart:
        yield Finding(
            FindingKind.PRESSURE_CLOCK,
            Severity.WARNING,
            f"pressure of {wearer_words(worn)} (from {facts.start_s:.3f} to {facts.end_s:.3f} s) "
            f"shares no time with the {' and the '.join(apart)} foot",
            "stamp it by the same clock",
            worn,
        )
