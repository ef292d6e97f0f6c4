"""Samples of two times, or of two sensors, that lie between each other.

When a clock is set back during a recording, and the recording is sorted by it, what came after the
step lies between the samples of before.  Then a sample is more like the one after the next, an
interval of the sensor away, than the next one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import BoolArray, FloatArray, ImuSeries, median, placed

LEAST = 12  # samples in a row
NEAR = 0.15  # of the interval, by which that to the sample after the next may differ from it
ROUGH = 0.5  # of the change to the next sample is the most of that to the one after the next


@dataclass(frozen=True)
class Overlaid:
    """Where it begins, s after the first sample, and how long it lasts, s."""

    start_s: float
    duration_s: float


def find_overlaid(series: ImuSeries) -> Overlaid | None:
    """Return the longest stretch of overlaid samples of a foot, None without one."""
    if len(series) < LEAST + 2:
        return None
    stamps = placed((series.stamp_ns - series.stamp_ns[0]) * 1e-9)
    two = stamps[2:] - stamps[:-2]
    for usual_s in (median(np.diff(stamps)), median(two)):  # overlaid: most
        first, last = _longest(np.abs(two - usual_s) < NEAR * usual_s)
        if last - first >= LEAST and _is_rough(series.angular_rate[first : last + 2]):
            return Overlaid(float(stamps[first]), float(stamps[last + 1] - stamps[first]))
    return None


def _longest(found: BoolArray) -> tuple[int, int]:
    """Return where the longest run of ``found`` begins and ends."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], found, [False]])))
    firsts, lasts = edges[::2], edges[1::2]
    longest = int(np.argmax(lasts - firsts)) if len(firsts) else None
    return (0, 0) if longest is None else (int(firsts[longest]), int(lasts[longest]))


def _is_rough(rate: FloatArray) -> bool:
    """Return whether samples two apart are more alike than those in a row."""
    one = float(np.abs(np.diff(rate, axis=0)).sum())
    return float(np.abs(rate[2:] - rate[:-2]).sum()) < ROUGH * one
