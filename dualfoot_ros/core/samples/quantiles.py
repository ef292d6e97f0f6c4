"""Quantiles without what numpy checks for one."""

from __future__ import annotations

import math

import numpy as np

from .series import FloatArray


def quantile(values: FloatArray, share: float) -> float:
    """Return what np.quantile does of finite values (N,), N > 0.

    That takes ten times as long for few values.
    """
    place = (len(values) - 1) * share
    number = math.floor(place)
    above = min(number + 1, len(values) - 1)
    ordered = np.partition(values, (number, above))
    low, high = float(ordered[number]), float(ordered[above])
    part = place - number
    return low + (high - low) * part if 2 * part < 1 else high - (high - low) * (1.0 - part)


def median(values: FloatArray) -> float:
    """Return what np.median does of values (N,), N > 0: nan where one is.

    That imports numpy's masked arrays, to ask whether these are some.
    """
    above = len(values) // 2
    ordered = np.partition(values, ((len(values) - 1) // 2, above, len(values) - 1))
    if math.isnan(ordered[-1]):
        return math.nan
    middle = ordered[above] if len(values) % 2 else (ordered[above - 1] + ordered[above]) / 2.0
    return float(middle)
