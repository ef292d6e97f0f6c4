"""The samples of an air pressure sensor in figures."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core import FloatArray, PressureSeries
from ..core.aids import RANGE_PA, pressure_height


class PressureFacts(NamedTuple):
    """The samples of one sensor in figures.

    Attributes
    ----------
    samples : all samples
    out_of_range : samples that are no air pressure in Pa, or not finite
    out_of_order : samples whose stamp is not later than all before
    start_s, end_s : s, first and last stamp
    rate_hz : Hz, from the median interval
    median : Pa
    lowest_m, highest_m : m, height in the standard atmosphere relative to the first second, from
        means over one second
    noise_m : m, standard deviation of a single sample, from the second differences
    """

    samples: int
    out_of_range: int
    out_of_order: int
    start_s: float
    end_s: float
    rate_hz: float
    median: float
    lowest_m: float
    highest_m: float
    noise_m: float


def pressure_facts(series: PressureSeries) -> PressureFacts:
    """Return the facts of ``series``, which has at least one sample."""
    stamps, pressure = series.stamp_ns, series.pressure
    within = (pressure > RANGE_PA[0]) & (pressure < RANGE_PA[1])
    latest = np.maximum.accumulate(stamps)
    interval = float(np.median(np.diff(stamps))) if len(series) > 1 else 0.0
    heights = np.array([pressure_height(p) for p in pressure[within].tolist()])
    means = _means(heights, 1 if interval <= 0 else round(1e9 / interval))
    bend = np.diff(heights, 2)
    finite = pressure[np.isfinite(pressure)]
    return PressureFacts(
        samples=len(series),
        out_of_range=int((~within).sum()),
        out_of_order=int((stamps[1:] <= latest[:-1]).sum()),
        start_s=int(stamps[0]) * 1e-9,
        end_s=int(stamps[-1]) * 1e-9,
        rate_hz=1e9 / interval if interval > 0 else float("nan"),
        median=float(np.median(finite)) if len(finite) else float("nan"),
        lowest_m=float(means.min() - means[0]) if len(means) else float("nan"),
        highest_m=float(means.max() - means[0]) if len(means) else float("nan"),
        noise_m=float(np.sqrt(np.mean(bend**2) / 6.0)) if len(bend) else float("nan"),
    )


def wearer_words(worn: str) -> str:
    """Return in words where a sensor is worn: "left", "right" or "both" (the body)."""
    return "the body" if worn == "both" else f"the {worn} foot"


def _means(heights: FloatArray, size: int) -> FloatArray:
    """Return the means of successive groups of ``size`` (at least one group)."""
    size = min(max(1, size), max(1, len(heights)))
    count = len(heights) // size
    means: FloatArray = heights[: count * size].reshape(count, size).mean(axis=1)
    return means
