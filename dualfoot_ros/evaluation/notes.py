"""Sentences that go with the figures: what was refused, what could not be compared."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..core import Refusal, TrackerConfig, refusal_of
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


def field_notes(counters: Mapping[str, int], used: bool = True) -> Iterator[str]:
    """Say whether a magnetic field was there, and how much of it could be used.

    ``used`` says that it was at one stance at least.
    """
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
    if before and not used:
        yield (
            f"magnetic heading: no reference was found in {_many(before, 'stance')}, as the field "
            "differed from stance to stance (indoors it is that of the building), so it did "
            "nothing"
        )
    elif before or disturbed:
        yield (
            f"magnetic heading: {_many(before, 'stance')} until the field of the start was known, "
            f"{disturbed} left out because it was disturbed"
        )
    for reason in FIELDS_LEFT_OUT:
        if count := counters.get(reason, 0):
            yield f"{_many(count, 'sample')} of the magnetic field left out: {reason.words}"


def config_notes(config: TrackerConfig) -> Iterator[str]:
    """Say what of a configuration makes it worse than the default, as in the papers' presets."""
    if config.zupt.lever_arm == 0.0 and config.zupt.lever_back == 0.0:
        yield (
            "the zero velocity holds at the sensor, as in the papers, and not at the pivot of the "
            "foot, so strides come out some percent short: 1.6 to 2.5 times the marker error of "
            "the default on the rectangles of the dual-feet set; zupt.lever_arm and "
            "zupt.lever_back cure it"
        )
    if config.heading.source == "first_strides" and config.heading.from_stance == 0:
        yield (
            "the heading is that of the very first stride of each foot, as in the paper, which "
            "is short and changes the width, so the feet start degrees apart: up to five times "
            "the marker error of the default; heading.from_stance=1 and heading.to_stance=3 cure "
            "it"
        )
    hard = [
        name
        for spec in config.constraint.specs(f"{config.method}.")
        if (name := spec.name).endswith(("distance_std", "spacing_std"))
        and config.to_mapping()[name] == 0.0
    ]
    if hard:
        yield (
            f"the constraint is hard ({hard[0]} is 0), as in the paper, while the distance of the "
            "feet varies by 2 cm a step, so it turns the tracks and claims too much: up to ten "
            "times the marker error of the default; 0.1 is that of idc, 0.15 of spacing_vector"
        )


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
