"""Correlation of two signals over every lag, each on an even grid of its own clock."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, ImuSeries, IntArray

STEP_S = 0.005  # grid of all signals
SMOOTH_S = 0.04  # a quarter of the shortest feature of a step
LEAST_ENERGY = 0.5  # share of the calmer signal's energy that an overlap must have to count fully


@dataclass(frozen=True)
class Signal:
    """A signal of one foot.

    Attributes
    ----------
    start_ns : stamp of the first value
    values : (N,) one every ``STEP_S``
    """

    start_ns: int
    values: FloatArray

    def part(self, begin: int, end: int) -> Signal:
        """Return the values ``begin`` to ``end`` (exclusive)."""
        begin = max(begin, 0)
        return Signal(self.start_ns + round(begin * STEP_S * 1e9), self.values[begin:end])


@dataclass(frozen=True)
class Correlation:
    """Agreement (M,) of two signals; ``lag_s`` (M,) is what to add to the second one's stamps."""

    lag_s: FloatArray
    value: FloatArray

    def peak(self, index: int) -> tuple[float, float]:
        """Return lag and height of the parabola through a maximum and its neighbours."""
        if not 0 < index < len(self.value) - 1:
            return float(self.lag_s[index]), float(self.value[index])
        before, top, after = (float(v) for v in self.value[index - 1 : index + 2])
        bend = before - 2.0 * top + after
        shift = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
        lag = float(self.lag_s[index]) + shift * (self.lag_s[1] - self.lag_s[0])
        return float(lag), top - 0.25 * (before - after) * shift

    def maximum_near(self, lag_s: float, within_s: float) -> tuple[float, float] | None:
        """Return lag and height of the highest value near ``lag_s``; None if it is at the edge."""
        near = np.flatnonzero(np.abs(self.lag_s - lag_s) <= within_s)
        if len(near) < 3:
            return None
        index = int(near[np.argmax(self.value[near])])
        return None if index in (near[0], near[-1]) else self.peak(index)


def signal_of(series: ImuSeries, values: FloatArray, smooth_s: float = SMOOTH_S) -> Signal:
    """Return ``values`` (N,) at the stamps of ``series`` as a smooth signal on an even grid.

    Samples that are not finite or whose stamps do not increase are left out.
    """
    from scipy.ndimage import gaussian_filter1d

    stamps = series.stamp_ns
    newest = np.maximum.accumulate(stamps)
    good = np.isfinite(values) & (stamps >= newest)
    good[1:] &= stamps[1:] > newest[:-1]
    stamps, values = stamps[good], values[good]
    if len(stamps) < 2:
        return Signal(int(stamps[0]) if len(stamps) else 0, np.zeros(len(stamps)))
    time_s = (stamps - stamps[0]) * 1e-9
    grid = np.arange(0.0, time_s[-1], STEP_S)
    even = np.interp(grid, time_s, values)
    return Signal(int(stamps[0]), gaussian_filter1d(even, smooth_s / STEP_S))


def correlate(first: Signal, second: Signal) -> Correlation:
    """Return the normalised correlation of two signals that are not negative, at every lag.

    Each lag is normalised by the energies of the parts that overlap, so that a recording cut
    short is no worse; an overlap with little energy counts less.
    """
    from scipy.signal import correlate as sums

    a, b = first.values, second.values
    shift = np.arange(-(len(b) - 1), len(a))
    return _normalised(first, second, shift, sums(a, b))


def correlate_near(first: Signal, second: Signal, lag_s: float, within_s: float) -> Correlation:
    """Return what :func:`correlate` does, at lags near ``lag_s`` only, and one more each way."""
    a, b = first.values, second.values
    middle = lag_s - (first.start_ns - second.start_ns) * 1e-9
    low = max(math.floor((middle - within_s) / STEP_S) - 1, -(len(b) - 1))
    high = min(math.ceil((middle + within_s) / STEP_S) + 1, len(a) - 1)
    if low > high:
        return Correlation(np.empty(0), np.empty(0))
    wanted = np.arange(-high, len(a) - low)  # of the second signal, zero beyond its ends
    inside = (wanted >= 0) & (wanted < len(b))
    beside = np.where(inside, b[np.clip(wanted, 0, len(b) - 1)], 0.0)
    product = np.correlate(beside, a, mode="valid")[::-1]
    return _normalised(first, second, np.arange(low, high + 1), product)


def _normalised(
    first: Signal, second: Signal, shift: IntArray, product: FloatArray
) -> Correlation:
    """Return the correlation from the products of the values that overlap at each ``shift``."""
    a, b = first.values, second.values
    energy_a = _energy(a, np.maximum(shift, 0), np.minimum(shift + len(b), len(a)))
    energy_b = _energy(b, np.maximum(-shift, 0), np.minimum(len(a) - shift, len(b)))
    least = LEAST_ENERGY * min(float(a @ a), float(b @ b)) + 1e-12
    value = product / np.sqrt(np.maximum(energy_a, least) * np.maximum(energy_b, least))
    start_s = (first.start_ns - second.start_ns) * 1e-9
    return Correlation(np.asarray(shift * STEP_S + start_s, dtype=np.float64), value)


def _energy(values: FloatArray, first: IntArray, end: IntArray) -> FloatArray:
    """Return the sums of squares of ``values`` from each ``first`` to each ``end``."""
    so_far = np.concatenate(([0.0], np.cumsum(values * values)))
    energy: FloatArray = so_far[end] - so_far[first]
    return energy
