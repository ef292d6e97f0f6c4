"""Facts and findings on the magnetic field at a foot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ..core import ImuSeries
from ..core.aids import RANGE_T
from .finding import Finding, FindingKind, Severity

EARTH_T = (2e-5, 7e-5)  # bounds of the earth's field anywhere, with some margin
UNITS_T = {"uT": 1e-6, "nT": 1e-9, "G": 1e-4, "mG": 1e-7}
BAND = (0.05, 0.5, 0.95)


@dataclass(frozen=True)
class FieldFacts:
    """The magnetic field of one foot in figures.

    Attributes
    ----------
    samples : samples of the foot that have a field, out of ``all_samples``
    out_of_range : those of them that are no field of the earth in T, or not finite
    low_t, median_t, high_t : 5 %, 50 % and 95 % quantile of the field's magnitude, T; nan for none
    """

    samples: int
    all_samples: int
    out_of_range: int
    low_t: float
    median_t: float
    high_t: float


def field_facts(series: ImuSeries) -> FieldFacts | None:
    """Return the facts of the field of ``series``, None where no field was recorded."""
    field = series.field
    if field is None:
        return None
    sizes = np.linalg.norm(field.tesla, axis=1)
    within = (sizes > RANGE_T[0]) & (sizes < RANGE_T[1])
    finite = sizes[np.isfinite(sizes)]
    low, median, high = np.quantile(finite, BAND) if len(finite) else (float("nan"),) * 3
    sizes_t = float(low), float(median), float(high)
    return FieldFacts(len(field), len(series), int((~within).sum()), *sizes_t)


def field_findings(fields: Mapping[str, FieldFacts]) -> Iterator[Finding]:
    """Yield the findings on the fields; all are warnings."""
    for foot, facts in fields.items():
        if not facts.samples:
            yield Finding(
                FindingKind.FIELD_STAMPS,
                Severity.WARNING,
                f"magnetic field of the {foot} foot: none has the stamp of a sample, so none is "
                "used",
                "give it the stamp of the sample it was measured with",
            )
        if facts.out_of_range:
            yield _out_of_range(foot, facts)


def _out_of_range(foot: str, facts: FieldFacts) -> Finding:
    text = (
        f"magnetic field of the {foot} foot: {facts.out_of_range} of {facts.samples} samples are "
        f"no field of the earth in T (the median is {facts.median_t:.3g})"
    )
    for unit, size in UNITS_T.items():
        if EARTH_T[0] < facts.median_t * size < EARTH_T[1]:
            return Finding(
                FindingKind.FIELD_RANGE,
                Severity.WARNING,
                f"{text}, so they are in {unit}",
                "publish T, as sensor_msgs/MagneticField has it",
            )
    return Finding(FindingKind.FIELD_RANGE, Severity.WARNING, f"{text}; they are left out")
