"""Accelerometer and gyro that were sampled apart, brought on the stamps of the gyro."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....core import BoolArray, FloatArray, IntArray

APART_SHARE = 0.2  # of the rows have the one or the other only: two streams in one table
LONGEST_STEP = 2.5  # usual steps; a longer gap is not bridged


@dataclass(frozen=True)
class Stream:
    """The vectors (N, 3) of one quantity, in the unit of the file, with stamps (N,) in ns."""

    stamp_ns: IntArray
    values: FloatArray


def are_apart(force: BoolArray, rate: BoolArray) -> bool:
    """Return whether rows hold either force or rate; the arguments (N, 3) say what is empty."""
    no_force, no_rate = force.all(axis=1), rate.all(axis=1)
    return len(force) > 0 and float((no_force ^ no_rate).mean()) > APART_SHARE


def join(force: Stream, rate: Stream) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return stamps of the gyro, forces interpolated to them, and rates.

    Stamps of the gyro outside of those of the accelerometer, or in a gap of it, are left out.
    """
    force, rate = _in_order(force), _in_order(rate)
    if len(force.stamp_ns) < 2 or not len(rate.stamp_ns):
        none = np.empty((0, 3))
        return np.empty(0, dtype=np.int64), none, none
    start = force.stamp_ns[0]
    known, wanted = force.stamp_ns - start, rate.stamp_ns - start
    after = np.clip(np.searchsorted(known, wanted), 1, len(known) - 1)
    gap = known[after] - known[after - 1]
    usable: BoolArray = (wanted >= known[0]) & (wanted <= known[-1])
    usable &= gap <= LONGEST_STEP * np.median(np.diff(known))
    columns = [np.interp(wanted[usable], known, force.values[:, k]) for k in range(3)]
    return rate.stamp_ns[usable], np.column_stack(columns), rate.values[usable]


def _in_order(stream: Stream) -> Stream:
    """Return the samples that are finite, each later than all before it."""
    finite = np.isfinite(stream.values).all(axis=1)
    stamps, values = stream.stamp_ns[finite], stream.values[finite]
    order = np.argsort(stamps, kind="stable")
    stamps, values = stamps[order], values[order]
    new = np.concatenate(([True], np.diff(stamps) > 0)) if len(stamps) else np.ones(0, dtype=bool)
    return Stream(stamps[new], values[new])
