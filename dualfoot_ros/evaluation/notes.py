"""Sentences that go with the figures: what was refused, what could not be compared."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..core import Refusal, refusal_of
from .metrics.markers import MarkerErrors

LEFT_OUT = (
    Refusal.NOT_FINITE,
    Refusal.OUT_OF_RANGE,
    Refusal.DUPLICATE,
    Refusal.OUT_OF_ORDER,
    Refusal.IN_GAP,
)
FIELDS_LEFT_OUT = (Refusal.FIELD_OUT_OF_RANGE, Refusal.FIELD_OUT_OF_ORDER)
PRESSURES_LEFT_OUT = (Refusal.PRESSURE_OUT_OF_RANGE, Refusal.PRESSURE_OUT_OF_ORDER)


def refusal_notes(counters: Mapping[str, int]) -> Iterator[str]:
    """Say which samples were left out, and how often the samples had gaps."""
    for name, count in counters.items():
        reason, foot = refusal_of(name.rpartition(".")[2]) or (None, "")
        whose = f" of the {foot} foot" if foot else ""
        if count and reason in LEFT_OUT:
            unit = "sample" if foot else "pair"
            yield f"{_many(count, unit)}{whose} left out: {reason.words}"
        elif count and reason in (Refusal.GAP, Refusal.GAPS):
            yield f"{_many(count, 'gap')} in the samples{whose}"


def pressure_notes(counters: Mapping[str, int]) -> Iterator[str]:
    """Say whether air pressure was there, and whether the barometer aid could use it."""
    unused, used = counters.get(Refusal.PRESSURE_UNUSED, 0), counters.get("pressures", 0)
    without = counters.get(Refusal.STANCES_WITHOUT_PRESSURE, 0)
    if unused:
        yield (
            f"{_many(unused, 'sample')} of air pressure not used; with aids.barometer=true they "
            "give the height"
        )
    if without and not used:
        yield (
            "aids.barometer is on but there is no air pressure, so it did nothing; record "
            "sensor_msgs/FluidPressure on /left/pressure and /right/pressure, or on /pressure"
        )
    elif without:
        yield (
            f"{_many(without, 'stance')} had too few samples of air pressure; check that it is "
            "stamped by the clock of the feet, its rate, and aids.barometer_samples"
        )
    for reason in PRESSURES_LEFT_OUT:
        if count := counters.get(reason, 0):
            yield f"{_many(count, 'sample')} of air pressure left out: {reason.words}"


def field_notes(counters: Mapping[str, int]) -> Iterator[str]:
    """Say whether a magnetic field was there, and how much of it could be used."""
    unused = counters.get(Refusal.FIELD_UNUSED, 0)
    if unused:
        yield (
            f"{_many(unused, 'sample')} of the magnetic field not used; outdoors, with "
            "aids.magnetic_heading=true, they hold the heading"
        )
    without = counters.get(Refusal.STANCES_WITHOUT_FIELD, 0)
    if without:
        yield (
            f"{_many(without, 'stance')} without a magnetic field; check that each foot has one "
            "and that it is stamped by the clock of the samples"
        )
    before = counters.get(Refusal.STANCES_BEFORE_FIELD_REFERENCE, 0)
    disturbed = counters.get(Refusal.STANCES_IN_DISTURBED_FIELD, 0)
    if before or disturbed:
        yield (
            f"magnetic heading: {_many(before, 'stance')} until the field of the start was known, "
            f"{disturbed} left out because it was disturbed"
        )
    for reason in FIELDS_LEFT_OUT:
        if count := counters.get(reason, 0):
            yield f"{_many(count, 'sample')} of the magnetic field left out: {reason.words}"


def marker_notes(reports: Mapping[str, MarkerErrors]) -> Iterator[str]:
    """Say for which foot stances and markers do not correspond."""
    for foot, report in reports.items():
        if report.stances != report.markers:
            yield (
                f"{report.stances} stances of the {foot} foot for {report.markers} markers, so "
                "none is compared; see stance.threshold if the walk did step on every marker"
            )


def _many(count: int, unit: str) -> str:
    return f"{count} {unit}" if count == 1 else f"{count} {unit}s"
