"""Stuck sensors: values that do not change although a sensor that measures would change them.

No real sensor gives the same six numbers for long, not even at rest; their last digits are noise.
A coarse one may hold a single axis while it lies still, so an axis counts as stuck only while
another axis of its triad moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..core import STANDARD_GRAVITY, BoolArray, FloatArray, ImuSeries

LEAST_S = 0.2  # a sensor that repeats itself while it cannot be at rest
LEAST_AT_REST_S = 3.0
LEAST_AXIS_S = 1.0
LEAST_SAMPLES = 10
AT_REST = (1.0, 0.2)  # m/s^2 from gravity, rad/s
MOVES = (2.0, 1.0)  # m/s^2, rad/s, by which another axis moves meanwhile
TRIADS = ("specific force", "angular rate")
HELD = 0.3  # share of one value in a standstill; noise of several digits gives a hundredth
NOISY = 0.1  # another axis of the triad that has less than this of one value is not coarse


class Channel(StrEnum):
    """One axis of a sensor, or all of it; the values are its name for people and in JSON."""

    FORCE_X = "specific force x"
    FORCE_Y = "specific force y"
    FORCE_Z = "specific force z"
    RATE_X = "angular rate x"
    RATE_Y = "angular rate y"
    RATE_Z = "angular rate z"
    SENSOR = "sensor"


AXES = tuple(channel for channel in Channel if channel is not Channel.SENSOR)
"""The six axes in the order of the columns: specific force, then angular rate."""


@dataclass(frozen=True)
class Stuck:
    """A channel that repeats itself.

    Attributes
    ----------
    what : the axis, or the whole sensor
    times : how often it got stuck
    first_s : s, when it first did, from the first sample
    longest_s : s
    share : of all samples
    """

    what: Channel
    times: int
    first_s: float
    longest_s: float
    share: float


Triads = tuple[FloatArray, FloatArray]
Run = tuple[int, int]
"""First and last sample of a stretch."""


def find_stuck(series: ImuSeries) -> tuple[Stuck, ...]:
    """Return what is stuck in the usable samples of one foot: the sensor, or single axes."""
    if len(series) < 2 * LEAST_SAMPLES:
        return ()
    triads = series.specific_force, series.angular_rate
    seconds = (series.stamp_ns - series.stamp_ns[0]) * 1e-9
    same = [column for triad in triads for column in (triad[1:] == triad[:-1]).T]
    sensor = _runs(np.logical_and.reduce(same))
    whole = [run for run in sensor if _is_stuck(triads, seconds, run)]
    if whole:
        return (_summarise(Channel.SENSOR, whole, seconds),)
    return tuple(_stuck_axes(triads, seconds, same))


def _stuck_axes(triads: Triads, seconds: FloatArray, same: Sequence[BoolArray]) -> Iterator[Stuck]:
    for axis, channel in enumerate(AXES):
        runs = [
            run for run in _runs(same[axis]) if _others_move(triads[axis // 3], seconds, axis, run)
        ]
        if runs:
            yield _summarise(channel, runs, seconds)


class Held(NamedTuple):
    """An axis that holds a value at rest: triad (0, 1), "x", "y" or "z", value, share of it."""

    triad: int
    axis: str
    value: float
    share: float


def held_at_rest(still: ImuSeries) -> tuple[Held, ...]:
    """Return the axes that measure nothing in a standstill: stuck there, or at a limit.

    At rest nothing but noise moves a value.  An axis that holds its value all the time, or has
    its greatest or smallest one in a large part of it, while the noise of another one moves that,
    is stuck or clipped; so is a triad of which none moves.
    """
    if len(still) < 2 * LEAST_SAMPLES:
        return ()
    held: list[Held] = []
    for triad, values in enumerate((still.specific_force, still.angular_rate)):
        modes = [_mode(column) for column in values.T]
        if min(share for _, share, _ in modes) < NOISY or all(s == 1.0 for _, s, _ in modes):
            held += [
                Held(triad, axis, value, share)
                for axis, (value, share, at_end) in zip("xyz", modes, strict=True)
                if share > HELD and at_end
            ]
    return tuple(held)


def _mode(column: FloatArray) -> tuple[float, float, bool]:
    """Return the most frequent value, its share, and whether it is the least or the greatest."""
    values, counts = np.unique(column, return_counts=True)
    most = int(np.argmax(counts))
    return float(values[most]), float(counts[most] / len(column)), most in (0, len(values) - 1)


def _runs(same: BoolArray) -> list[Run]:
    """Return the long stretches of samples of which each is the ``same`` (N - 1,) as the next."""
    if np.count_nonzero(same) < LEAST_SAMPLES - 1:
        return []
    edges = np.flatnonzero(np.diff(np.concatenate(([0], same.astype(np.int8), [0]))))
    runs = edges.reshape(-1, 2)
    long = runs[runs[:, 1] - runs[:, 0] + 1 >= LEAST_SAMPLES]
    return [(first, last) for first, last in long.tolist()]


def _is_stuck(triads: Triads, seconds: FloatArray, run: Run) -> bool:
    first, last = run
    force, rate = (values[first] for values in triads)
    off = abs(float(np.linalg.norm(force)) - STANDARD_GRAVITY)
    rest = off < AT_REST[0] and float(np.abs(rate).max()) < AT_REST[1]
    return bool(seconds[last] - seconds[first] >= (LEAST_AT_REST_S if rest else LEAST_S))


def _others_move(triad: FloatArray, seconds: FloatArray, axis: int, run: Run) -> bool:
    """Return whether another axis of the ``triad`` (N, 3) moves while ``axis`` does not."""
    first, last = run
    if seconds[last] - seconds[first] < LEAST_AXIS_S:
        return False
    span = np.ptp(triad[first : last + 1], axis=0)
    return bool(span.max() > MOVES[axis // 3])


def _summarise(channel: Channel, runs: list[Run], seconds: FloatArray) -> Stuck:
    return Stuck(
        channel,
        len(runs),
        float(seconds[runs[0][0]]),
        max(float(seconds[last] - seconds[first]) for first, last in runs),
        sum(last - first + 1 for first, last in runs) / len(seconds),
    )
