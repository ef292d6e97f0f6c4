"""The last stand of a recorded walk, which tells of the gyro biases that it started with."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..config import TrackerConfig
from ..groups import AlignmentConfig
from ..samples.series import ImuSeries, IntArray
from .foot_stand import FootStand, FootStandstill
from .prior import BiasPrior
from .whole_windows import WholeWindows
from .window import Window

SEARCHED_S = 60.0  # stretch at the end of the walk that is looked at
SHORTEST_S = 2.0  # of a stand that counts
LEAST_STD = 1e-4  # rad/s, what a bias changes by while a person walks and stands


def bias_after(series: ImuSeries, config: TrackerConfig) -> BiasPrior | None:
    """Return what the last stand of ``series`` tells of the gyro bias at its start, or None.

    The bias drifts from the start to the stand by its driving noise, which is added.
    """
    still = last_stand(series, config)
    if still is None:
        return None
    between_s = (still.end_ns - int(series.stamp_ns[0])) * 1e-9
    drift = config.noise.gyro_bias * math.sqrt(max(between_s, 0.0))
    return BiasPrior(still.angular_rate, math.hypot(still.rate_std, LEAST_STD, drift))


def last_stand(series: ImuSeries, config: TrackerConfig) -> FootStandstill | None:
    """Return what the last quiet stand of one foot tells, if there is one in the last minute."""
    for windows in _runs_of_quiet_windows(series, config):
        stand = FootStand(config.alignment)
        for window in reversed(windows):
            stand.add(window)
        if stand.seconds >= SHORTEST_S:
            return stand.result()
    return None


def _runs_of_quiet_windows(series: ImuSeries, config: TrackerConfig) -> Iterator[list[Window]]:
    """Yield the windows of each stand of the last minute, the newest stand and window first.

    What lies before the stand that is looked for is not worked out.
    """
    run: list[Window] = []
    quiet = config.alignment
    for windows in _newest_windows(series, quiet):
        low = windows.scatter_below(quiet.quiet_force_std, quiet.quiet_rate_std).tolist()
        for k in range(len(windows) - 1, -1, -1):
            if low[k] and (window := windows.window(k)).motion(quiet, config.gravity) is None:
                run.append(window)
            elif run:
                yield run
                run = []
    if run:
        yield run


def _newest_windows(series: ImuSeries, config: AlignmentConfig) -> Iterator[WholeWindows]:
    """Return the windows of the last minute of a foot, in parts from its end."""
    stamps: IntArray = series.stamp_ns
    first = int(stamps.searchsorted(stamps[-1] - round(SEARCHED_S * 1e9))) if len(stamps) else 0
    values = np.hstack([series.specific_force[first:], series.angular_rate[first:]])
    return WholeWindows.newest_first(stamps[first:], values, config.window)
