"""The last stand of a recorded walk, which tells of the gyro biases that it started with."""

from __future__ import annotations

import math

import numpy as np

from ..config import TrackerConfig
from ..samples.series import FloatArray, ImuSeries, IntArray
from .foot_stand import FootStand, FootStandstill
from .prior import BiasPrior
from .window import WindowSlider

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
    stamps: IntArray = series.stamp_ns
    first = int(stamps.searchsorted(stamps[-1] - round(SEARCHED_S * 1e9))) if len(stamps) else 0
    slider, stand = WindowSlider(config.alignment.window), FootStand(config.alignment)
    found: FootStandstill | None = None
    for k in range(first, len(stamps)):
        window = slider.add(int(stamps[k]), sample(series, k))
        if window is None:
            continue
        if window.motion(config.alignment, config.gravity) is None and window.quiet(
            config.alignment
        ):
            stand.add(window)
            continue
        found = _result(stand) or found
        stand.clear()
    return _result(stand) or found


def _result(stand: FootStand) -> FootStandstill | None:
    return stand.result() if stand.seconds >= SHORTEST_S else None


def sample(series: ImuSeries, index: int) -> FloatArray:
    """Return specific force and angular rate (6,) of one sample."""
    return np.concatenate([series.specific_force[index], series.angular_rate[index]])
