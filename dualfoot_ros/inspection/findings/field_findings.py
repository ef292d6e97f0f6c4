"""Findings on the magnetic fields at the feet; all are warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..field_facts import FieldFacts
from .finding import Finding, Severity
from .finding_kinds import FindingKind

EARTH_T = (2e-5, 7e-5)  # bounds of the earth's field anywhere, with some margin
UNITS_T = {"uT": 1e-6, "nT": 1e-9, "G": 1e-4, "mG": 1e-7}


def field_findings(fields: Mapping[str, FieldFacts]) -> Iterator[Finding]:
    """Yield the findings on the fields, by foot."""
    for foot, facts in fields.items():
        yield from find_field_stamps(foot, facts)
        yield from find_field_range(foot, facts)


def find_field_stamps(foot: str, facts: FieldFacts) -> Iterator[Finding]:
    """Yield a finding when no field belongs to a sample."""
    if not facts.samples:
        yield Finding(
            FindingKind.FIELD_STAMPS,
            Severity.WARNING,
            f"magnetic field of the {foot} foot: none has the stamp of a sample, so none is used",
            "give it the stamp of the sample it was measured with",
            foot,
        )


def find_field_range(foot: str, facts: FieldFacts) -> Iterator[Finding]:
    """Yield a finding when samples are no field of the earth in T."""
    if not facts.out_of_range:
        return
    text = (
        f"magnetic field of the {foot} foot: {facts.out_of_range} of {facts.samples} samples are "
        f"no field of the earth in T (the median is {facts.median_t:.3g})"
    )
    unit = _guess_unit(facts.median_t)
    text = f"{text}, so they are in {unit}" if unit else f"{text}; they are left out"
    remedy = "publish T, as sensor_msgs/MagneticField has it" if unit else ""
    yield Finding(FindingKind.FIELD_RANGE, Severity.WARNING, text, remedy, foot)


def _guess_unit(median: float) -> str | None:
    """Return the unit in which ``median`` is a field of the earth, None if there is none."""
    for unit, size in UNITS_T.items():
        if EARTH_T[0] < median * size < EARTH_T[1]:
            return unit
    return None
