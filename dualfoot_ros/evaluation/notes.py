"""Sentences that go with the figures: what was refused, what could not be compared."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from .metrics.markers import MarkerErrors

REFUSED = {
    "not_finite": "values that are not finite",
    "out_of_range": "values no foot-mounted sensor gives",
    "duplicate": "a stamp that was there already",
    "out_of_order": "a stamp older than the one before",
    "in_gap": "a gap in the samples",
}
FIELD_REFUSED = {
    "field_out_of_range": "not finite, or no field of the earth in T",
    "field_out_of_order": "a stamp that is not later than the one before",
}
PRESSURE_REFUSED = {
    "pressure_out_of_range": "no air pressure in Pa",
    "pressure_out_of_order": "a stamp that is not later than the one before",
}


def refusal_notes(counters: Mapping[str, int]) -> Iterator[str]:
    """Say which samples were left out, and how often the samples had gaps."""
    for name, count in counters.items():
        source, _, what = name.rpartition(".")
        foot, _, rest = what.partition("_")
        if foot in ("left", "right"):
            what, whose = rest, f" of the {foot} foot"
        else:
            whose = ""
        if count and what in REFUSED:
            unit = "sample" if source and whose else "pair"
            yield f"{_many(count, unit)}{whose} left out: {REFUSED[what]}"
        elif count and what in ("gap", "gaps"):
            yield f"{_many(count, 'gap')} in the samples{whose}"


def pressure_notes(counters: Mapping[str, int]) -> Iterator[str]:
    """Say whether air pressure was there, and whether the barometer aid could use it."""
    unused, used = counters.get("pressure_unused", 0), counters.get("pressures", 0)
    without = counters.get("stances_without_pressure", 0)
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
    for name, why in PRESSURE_REFUSED.items():
        if counters.get(name, 0):
            yield f"{_many(counters[name], 'sample')} of air pressure left out: {why}"


def field_notes(counters: Mapping[str, int]) -> Iterator[str]:
    """Say whether a magnetic field was there, and how much of it could be used."""
    unused = counters.get("field_unused", 0)
    if unused:
        yield (
            f"{_many(unused, 'sample')} of the magnetic field not used; outdoors, with "
            "aids.magnetic_heading=true, they hold the heading"
        )
    without = counters.get("stances_without_field", 0)
    if without:
        yield (
            f"{_many(without, 'stance')} without a magnetic field; check that each foot has one "
            "and that it is stamped by the clock of the samples"
        )
    before = counters.get("stances_before_field_reference", 0)
    disturbed = counters.get("stances_in_disturbed_field", 0)
    if before or disturbed:
        yield (
            f"magnetic heading: {_many(before, 'stance')} until the field of the start was known, "
            f"{disturbed} left out because it was disturbed"
        )
    for name, why in FIELD_REFUSED.items():
        if counters.get(name, 0):
            yield f"{_many(counters[name], 'sample')} of the magnetic field left out: {why}"


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
