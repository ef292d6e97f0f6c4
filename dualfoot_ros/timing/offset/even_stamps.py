"""Even stamps of a sensor that samples regularly, from times that jitter or come in bursts.

The number of a sample is taken as the time of the device's own clock, and the times at which the
samples were stamped or logged as arrivals: what makes them late is taken off, and samples that
were lost leave their gap.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core import FloatArray, IntArray, TimingError
from .arrival import LEAST_S, offset_by_arrival

LEAST_SAMPLES = 20
LAG = 60  # samples at least, over which the interval is measured
LAG_SHARE = 0.05  # of the samples
WINDOW = 60  # samples before and behind a hole that tell how many are missing
LEAST_WINDOW = 30  # of these; a hole nearer to the start or the end is not looked for
SURE = 0.75  # interval by which all have to be late for one that is missing
HOLE = 1.5  # intervals


class EvenStamps(NamedTuple):
    """Stamps (N,) ns at regular intervals, the interval, and the number of samples missing."""

    stamp_ns: IntArray
    interval_ns: float
    missing: int


def even_stamps(foot: str, time_ns: IntArray) -> EvenStamps:
    """Return even stamps for samples of ``foot`` that came at ``time_ns`` (N,), in their order.

    Raises
    ------
    TimingError
        When there are too few samples, the times do not grow, or the clock jumps within them.
    """
    if len(time_ns) < LEAST_SAMPLES or not np.ptp(time_ns):
        raise TimingError(
            f"the {foot} foot has {len(time_ns)} samples over {1e-9 * _span(time_ns):.1f} s; "
            f"{LEAST_SAMPLES} that grow in time are needed to even out their stamps"
        )
    relative = (time_ns - time_ns[0]).astype(np.float64)
    interval = _interval(foot, relative)
    numbers = np.arange(len(time_ns)) + _missing_before(relative, interval)
    interval = float(np.polyfit(numbers, relative, 1)[0]) if interval > 0 else interval
    stamps = _on_clock(foot, np.rint(numbers * interval).astype(np.int64), time_ns)
    fitted = float(stamps[-1] - stamps[0]) / float(numbers[-1])
    return EvenStamps(stamps, fitted, int(numbers[-1]) + 1 - len(time_ns))


def _span(time_ns: IntArray) -> float:
    return float(np.ptp(time_ns)) if len(time_ns) else 0.0


def _interval(foot: str, time: FloatArray) -> float:
    """Return the sampling interval in ns, from the mean step over many samples, without holes."""
    lag = min(max(LAG, int(LAG_SHARE * len(time))), len(time) // 2)
    steps = (time[lag:] - time[:-lag]) / lag
    middle = float(np.median(steps))
    if middle <= 0.0:
        raise TimingError(f"the times of the {foot} foot do not grow; record again")
    usual = steps[(steps > 0.75 * middle) & (steps < 1.25 * middle)]
    return float(np.mean(usual))


def _missing_before(time: FloatArray, interval: float) -> IntArray:
    """Return the number (N,) of samples that were lost before each one.

    A late sample is followed by others that are early again; a lost one moves all that follow.
    Both the earliest and the middle ones have to say so.
    """
    late = time - interval * np.arange(len(time))
    missing = np.zeros(len(time), dtype=np.int64)
    for at in np.flatnonzero(np.diff(time) > HOLE * interval) + 1:
        if not LEAST_WINDOW <= at <= len(time) - LEAST_WINDOW:
            continue
        before, behind = late[max(0, at - WINDOW) : at], late[at : at + WINDOW]
        lost = int((np.min(behind) - np.min(before)) / interval + 1.0 - SURE)
        if lost > 0:
            middle = np.median(behind) - np.median(before)
            lost = min(lost, int(middle / interval + 1.0 - SURE))
        if lost > 0:
            missing[at:] += lost
            late[at:] -= lost * interval
    return missing


def _on_clock(foot: str, device_ns: IntArray, time_ns: IntArray) -> IntArray:
    """Return the device's times on the clock of ``time_ns``, under whose arrivals they run."""
    if int(device_ns[-1]) >= 1e9 * LEAST_S:
        return offset_by_arrival(foot, device_ns, time_ns).apply(device_ns)
    slope, start = np.polyfit(device_ns.astype(np.float64), (time_ns - time_ns[0]) * 1.0, 1)
    stamps: IntArray = time_ns[0] + np.rint(start + slope * device_ns).astype(np.int64)
    return stamps
