"""The facts of an air pressure sensor's samples, and what there is to object to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ..core import PressureSeries
from ..core.aids import RANGE_PA, pressure_height
from .quality import Quality

HECTO = 100.0


@dataclass(frozen=True)
class PressureFacts:
    """What can be said of one sensor.

    Attributes
    ----------
    samples : all of them; ``out_of_range`` are no air pressure in Pa (or not finite),
        ``out_of_order`` have a stamp that is not later than all before
    start_s, end_s : s, first and last stamp
    rate_hz : Hz, from the median interval
    median : Pa
    lowest_m, highest_m : height of the standard atmosphere against the first second's, m, from
        means over a second
    noise_m : scatter of a single sample, m, from the second differences
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


def facts_of(series: PressureSeries) -> PressureFacts:
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


def pressure_findings(
    pressure: Mapping[str, PressureSeries], qualities: Mapping[str, Quality]
) -> Iterator[tuple[str, str]]:
    """Yield name and sentence of every objection; none keeps a recording from being used."""
    for worn, series in pressure.items():
        facts, name = facts_of(series), wearer(worn)
        if facts.out_of_range:
            yield (
                "pressure_range",
                f"pressure of {name}: {facts.out_of_range} of {facts.samples} samples are no air "
                f"pressure in Pa (the median is {facts.median:.6g}){_unit_advice(facts.median)}",
            )
        if facts.out_of_order:
            yield (
                "pressure_stamps",
                f"pressure of {name}: {facts.out_of_order} duplicate or out-of-order stamps are "
                "left out",
            )
        apart = [
            foot
            for foot, q in qualities.items()
            if facts.end_s < q.start_s or facts.start_s > q.end_s
        ]
        if apart:
            yield (
                "pressure_clock",
                f"pressure of {name} (from {facts.start_s:.3f} to {facts.end_s:.3f} s) shares no "
                f"time with the {' and the '.join(apart)} foot; stamp it by the same clock",
            )


def wearer(worn: str) -> str:
    """Return where a sensor is worn, in words."""
    return "the body" if worn == "both" else f"the {worn} foot"


def _unit_advice(median: float) -> str:
    if RANGE_PA[0] < median * HECTO < RANGE_PA[1]:
        return ", so they are in hPa; publish Pa, as sensor_msgs/FluidPressure has it"
    return "; they are left out"


def _means(heights: np.ndarray, size: int) -> np.ndarray:
    """Return the means of successive groups of ``size`` (at least one group)."""
    size = min(max(1, size), max(1, len(heights)))
    count = len(heights) // size
    return heights[: count * size].reshape(count, size).mean(axis=1)
