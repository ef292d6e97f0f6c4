"""The facts of a foot's magnetic field, and what there is to object to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ..core import ImuSeries
from ..core.aids import RANGE_T

EARTH_T = (2e-5, 7e-5)  # what the size of the earth's field is anywhere, with some room
UNITS_T = {"uT": 1e-6, "nT": 1e-9, "G": 1e-4, "mG": 1e-7}
BAND = (0.05, 0.5, 0.95)


@dataclass(frozen=True)
class FieldFacts:
    """What can be said of one foot's magnetic field.

    Attributes
    ----------
    samples : samples of the foot that have a field, out of ``all_samples``
    out_of_range : of them no magnetic field of the earth in T (or not finite)
    low_t, median_t, high_t : size of the field, T: 5 % are below, half, and 95 %; nan for none
    """

    samples: int
    all_samples: int
    out_of_range: int
    low_t: float
    median_t: float
    high_t: float


def facts_of(series: ImuSeries) -> FieldFacts | None:
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


def field_findings(fields: Mapping[str, FieldFacts]) -> Iterator[tuple[str, str]]:
    """Yield name and sentence of every objection; none keeps a recording from being used."""
    for foot, facts in fields.items():
        if not facts.samples:
            yield (
                "field_stamps",
                f"magnetic field of the {foot} foot: none has the stamp of a sample, so none is "
                "used; give it the stamp of the sample it was measured with",
            )
        if facts.out_of_range:
            yield (
                "field_range",
                f"magnetic field of the {foot} foot: {facts.out_of_range} of {facts.samples} are "
                f"none of the earth in T (the median is {facts.median_t:.3g})"
                f"{_unit_advice(facts.median_t)}",
            )


def _unit_advice(median_t: float) -> str:
    for unit, size in UNITS_T.items():
        if EARTH_T[0] < median_t * size < EARTH_T[1]:
            return f", so they are in {unit}; publish T, as sensor_msgs/MagneticField has it"
    return "; they are left out"
