"""The magnetic field at a foot in figures."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core import FEET, ImuSeries
from ..core.aids import RANGE_T
from ..recording import Recording

BAND = (0.05, 0.5, 0.95)


class FieldFacts(NamedTuple):
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


def recorded_fields(recording: Recording) -> dict[str, FieldFacts]:
    """Return the facts of the magnetic field of each foot that has one recorded."""
    series = {foot: recording.imu(foot) for foot in FEET}
    facts = {foot: field_facts(s) for foot, s in series.items() if s is not None}
    return {foot: known for foot, known in facts.items() if known is not None}
