"""Samples of a foot from two topics, specific force and angular rate, joined by their stamps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core import FloatArray, ImuSeries, Increments, IntArray
from . import message_tables as messages

LONGEST_HOLE = 2.5  # median intervals of the accelerometer; across more is not interpolated


class Samples(NamedTuple):
    """Samples of a foot, and the log times (N,) ns of their messages."""

    series: ImuSeries
    log_ns: IntArray


def join(rate: messages.Table, force: messages.Table, kind: Increments | None = None) -> Samples:
    """Return samples at the stamps of the angular rate, the specific force interpolated there.

    Messages without stamps are joined by their log times.  Where the specific force is missing,
    there is no sample.
    """
    stamps = bool(np.ptp(rate.stamp_ns)) if len(rate.stamp_ns) else False
    at_ns, known_ns = (t.stamp_ns if stamps else t.log_ns for t in (rate, force))
    known, first = np.unique(known_ns, return_index=True)
    if len(known) < 2:
        there = np.zeros(len(at_ns), dtype=bool)
        forces = np.empty((0, 3))
    else:
        there = _has_neighbours(at_ns, known)
        forces = _interpolate(at_ns[there], known, force.force[first])
    rates = rate.rate[there]
    return Samples(
        ImuSeries(rate.stamp_ns[there], forces, rates, increments=kind), rate.log_ns[there]
    )


def _has_neighbours(at_ns: IntArray, known_ns: IntArray) -> np.ndarray:
    """Return (N,) whether a time is within ``known_ns`` (M,), and in no hole of it."""
    right = np.searchsorted(known_ns, at_ns)
    inside = (right < len(known_ns)) & ((right > 0) | (at_ns == known_ns[0]))
    right = np.clip(right, 1, len(known_ns) - 1)
    exact = (known_ns[right] == at_ns) | (known_ns[right - 1] == at_ns)
    steps = np.diff(known_ns)
    close = steps[right - 1] <= LONGEST_HOLE * np.median(steps)
    there: np.ndarray = inside & (exact | close)
    return there


def _interpolate(at_ns: IntArray, known_ns: IntArray, vectors: FloatArray) -> FloatArray:
    origin = known_ns[0]  # relative, as a float holds no nanoseconds since 1970
    at, known = (at_ns - origin).astype(float), (known_ns - origin).astype(float)
    return np.column_stack([np.interp(at, known, column) for column in vectors.T])
