"""Spans of a walk between two instants at which a foot is quiet, found by its accelerometer alone.

The gyro is what is to be checked with them, so that it has no say in where a foot stands.  A foot
is quiet where its specific force hardly changes and has the size of gravity, once a gait cycle.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from ..core import (
    STANDARD_GRAVITY,
    FloatArray,
    ImuSeries,
    IntArray,
    median,
    new_array,
    placed,
    row_lengths,
)

WINDOW_S = 0.1  # over which the specific force is to be steady
APART_S = 0.5  # two quiet instants are not closer than the half of it
QUIETEST = 0.05  # share of the windows that tells what the sensor reads as gravity
UNQUIET = 0.5
"""m/s^2, scatter and distance from gravity of a window that is not used: stances have 0.1 to 0.4,
the middle of a slow swing 0.5 to 0.9."""
SWING = 4.0  # m/s^2 from gravity, which a swing exceeds somewhere
SPAN_S = (0.4, 2.0)  # a gait cycle
IRREGULAR_S = 0.05  # a span whose stamps miss more is not used
RATE_HZ = 100.0  # samples are averaged to about this
MOST_SPANS = 24
TOGETHER = 1 << 11  # windows at once: what they need stays in the cache of the processor


@dataclass(frozen=True)
class Spans:
    """K gait cycles of one foot, from quiet instant to quiet instant, of at most L samples each.

    Attributes
    ----------
    force, rate : (L, K, 3) m/s^2 and rad/s; zero beyond the end of a span
    within : (L, K, 1) 1 for the samples of a span, 0 beyond its end
    duration_s : (K,) s
    first, last : (K, 3) m/s^2, specific force at the quiet instants
    step_s : s, interval of the samples
    """

    force: FloatArray
    rate: FloatArray
    within: FloatArray
    duration_s: FloatArray
    first: FloatArray
    last: FloatArray
    step_s: float

    def __len__(self) -> int:
        """Return the number of spans."""
        return len(self.duration_s)


def quiet_spans(series: ImuSeries) -> Spans:
    """Return up to MOST_SPANS gait cycles, spread over the samples of one foot."""
    series = _average(series)
    size = max(3, round(WINDOW_S * series.rate_hz)) if len(series) > 1 else 0
    if not size or len(series) < 2 * size:
        return _gather(series, [], np.zeros((0, 3)), 1)
    means, unrest = _windows(series.specific_force, size)
    starts = _quiet_instants(unrest, max(2, round(APART_S * series.rate_hz)))
    pairs = _cycles(series, starts, size)
    if len(pairs) > MOST_SPANS:
        chosen = np.linspace(0, len(pairs) - 1, MOST_SPANS).astype(int)
        pairs = [pairs[k] for k in chosen]
    return _gather(series, pairs, means, size)


def _average(series: ImuSeries) -> ImuSeries:
    """Return means of so many samples that about RATE_HZ remain."""
    rate = series.rate_hz if len(series) > 1 else float("nan")
    size = max(1, round(rate / RATE_HZ)) if np.isfinite(rate) else 1
    if size == 1:
        return series
    count = len(series) // size * size
    force, turn = (
        placed(_sum([v[k:count:size] for k in range(size)]) / size)
        for v in (series.specific_force, series.angular_rate)
    )
    return ImuSeries(series.stamp_ns[size - 1 : count : size], force, turn)


def _windows(force: FloatArray, size: int) -> tuple[FloatArray, FloatArray]:
    """Return mean (N - size + 1, 3) and unrest (N - size + 1,) m/s^2 of every window."""
    count = len(force) - size + 1
    means, scatter = new_array((count, 3)), np.empty(count)
    for start in range(0, count, TOGETHER):
        part = slice(start, min(start + TOGETHER, count))
        rows = [force[part.start + k : part.stop + k] for k in range(size)]
        means[part] = _sum(rows) / size
        off = [row - means[part] for row in rows]
        scatter[part] = np.sqrt((_sum([each * each for each in off]) / size).sum(axis=1))
    norms = row_lengths(means)
    few = max(1, round(QUIETEST * len(scatter)))
    gravity = median(norms[np.argpartition(scatter, few - 1)[:few]])
    return means, scatter + np.abs(norms - gravity)


def _sum(arrays: list[FloatArray]) -> FloatArray:
    """Return the sum of arrays, one after the other."""
    total = arrays[0].copy()
    for each in arrays[1:]:
        total += each
    return total


def _quiet_instants(unrest: FloatArray, apart: int) -> IntArray:
    """Return the windows that are the quietest within ``apart`` windows, and quiet."""
    least = _least_within(np.pad(unrest, apart, constant_values=np.inf), 2 * apart + 1)
    found: list[int] = []
    for k in np.flatnonzero((unrest == least) & (unrest < UNQUIET)).tolist():
        if not found or k - found[-1] >= apart // 2:
            found.append(k)
    return np.array(found, dtype=np.int64)


def _least_within(values: FloatArray, size: int) -> FloatArray:
    """Return the least (N - size + 1,) of each ``size`` values: of two stretches, doubled."""
    least, length = values, 1
    while 2 * length <= size:
        least, length = np.minimum(least[:-length], least[length:]), 2 * length
    rest = size - length
    return np.minimum(least[: len(least) - rest], least[rest:])


def _cycles(series: ImuSeries, starts: IntArray, size: int) -> list[tuple[int, int]]:
    """Return the pairs of successive windows with one step between their middles."""
    off = np.abs(row_lengths(series.specific_force) - STANDARD_GRAVITY)
    stamps, rate_hz = (series.stamp_ns[starts + size // 2]).tolist(), series.rate_hz
    return [
        (a, b)
        for (a, b), (first, last) in zip(
            itertools.pairwise(starts.tolist()), itertools.pairwise(stamps), strict=True
        )
        if _lasts_a_step((last - first) * 1e-9, (b - a) / rate_hz)
        and off[a + size // 2 : b + size // 2].max() > SWING
    ]


def _lasts_a_step(duration_s: float, due_s: float) -> bool:
    """Return whether a span lasts as long as a step, and no sample is missing in it."""
    return SPAN_S[0] < duration_s < SPAN_S[1] and abs(duration_s - due_s) <= IRREGULAR_S


def _gather(
    series: ImuSeries, pairs: list[tuple[int, int]], means: FloatArray, size: int
) -> Spans:
    """Return the samples between the windows of each pair, side by side."""
    longest = max((b - a for a, b in pairs), default=0)
    force, rate = (np.zeros((longest, len(pairs), 3)) for _ in range(2))
    within = np.zeros((longest, len(pairs), 1))
    for k, (a, b) in enumerate(pairs):
        used = slice(a + size // 2 + 1, b + size // 2 + 1)
        force[: b - a, k] = series.specific_force[used]
        rate[: b - a, k] = series.angular_rate[used]
        within[: b - a, k] = 1.0
    step_s = 1.0 / series.rate_hz if pairs else float("nan")
    duration = np.array([b - a for a, b in pairs], dtype=float) * (step_s if pairs else 1.0)
    first, last = (means[[pair[end] for pair in pairs]].reshape(-1, 3) for end in (0, 1))
    return Spans(force, rate, within, duration, first, last, step_s)
