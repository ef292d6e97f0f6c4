"""Samples of a foot that were lost in a short hole: when they were, and what they would have been.

The values are on the cubic through the two samples before the hole and the two after it
(Lagrange's form, for any stamps).  The line through the neighbours cuts the peaks of a rate by
h^2 / 8 of its second derivative, so that it loses more of a foot's turning than the filter can
make up for; the cubic loses a third of that at 100 Hz.  A force changes so fast when a foot lands
that the cubic of a longer hole goes farther astray than the line.  So longer holes are left to
the line, as is one that lacks the second sample on either side, or has it so near to the first one
that the cubic is steep: stamps of arrivals are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from ...core import BoolArray, FloatArray, ImuSeries, IntArray
from .interpolation import Number
from .pairing_config import AlignerConfig
from .sample_spacing import filled

Stamps = TypeVar("Stamps", int, IntArray)

LONGEST_NS = 40_000_000  # from the sample before a hole to that after it


def cubic(stamps: Sequence[Number], values: Sequence[Sequence[Number]]) -> list[Number]:
    """Return the value at 0 of the cubic through four samples, number by number.

    ``stamps`` are the four times of the samples, less that at which the value is wanted.
    """
    a, b, c, d = stamps
    shares = (
        b * c * d / ((b - a) * (c - a) * (d - a)),
        a * c * d / ((a - b) * (c - b) * (d - b)),
        a * b * d / ((a - c) * (b - c) * (d - c)),
        a * b * c / ((a - d) * (b - d) * (c - d)),
    )
    return [
        shares[0] * p + shares[1] * q + shares[2] * r + shares[3] * s
        for p, q, r, s in zip(*values, strict=True)
    ]


def is_curved(
    first: Stamps, before: Stamps, after: Stamps, count: Stamps, config: AlignerConfig
) -> bool | BoolArray:
    """Return whether the hole between ``before`` and ``after`` is curved, if a sample follows.

    ``first`` is the stamp of the sample before ``before``; all are ns, or many of each, and
    ``count`` is the number of samples that are lost.
    """
    short = after - before <= LONGEST_NS
    return short & can_guide(before - first, after - before, count, config)


def can_guide(
    interval: Stamps, hole: Stamps, count: Stamps, config: AlignerConfig
) -> bool | BoolArray:
    """Return whether two samples an ``interval`` apart, ns, guide the cubic into a ``hole``.

    They do not where they are nearer than half an interval of the ``count`` lost samples.
    """
    return (interval <= config.max_gap_ns) & (2 * (count + 1) * interval >= hole)


class Restored(NamedTuple):
    """The samples of a foot, and those lost in short holes as far as they can be restored.

    Attributes
    ----------
    series : N samples
    lost : (N,) which of them were lost
    stamp_ns : (M,) of all samples, those included that were lost and are not restored
    """

    series: ImuSeries
    lost: BoolArray
    stamp_ns: IntArray

    @classmethod
    def of(cls, series: ImuSeries, config: AlignerConfig) -> Restored:
        """Restore what was lost between increasing stamps."""
        lost = filled(series.stamp_ns, config.max_gap_ns)
        stamps = np.sort(np.concatenate([series.stamp_ns, lost]))
        at, around = _around(series.stamp_ns, lost, config)
        if config.holds or not len(at):
            return cls(series, np.zeros(len(series), dtype=bool), stamps)
        places = around[2]
        made = np.insert(np.zeros(len(series), dtype=bool), places, True)
        return cls(_with(series, at, around), made, stamps)


def _with(series: ImuSeries, at: IntArray, around: list[IntArray]) -> ImuSeries:
    """Return a series with samples ``at`` the stamps (K,) besides, each from four ``around``."""
    measured = np.hstack([series.specific_force, series.angular_rate])
    since = [(series.stamp_ns[k] - at).astype(np.float64) for k in around]
    curved = np.column_stack(cubic(since, [list(measured[k].T) for k in around]))
    places = around[2]
    return replace(
        series,
        stamp_ns=np.insert(series.stamp_ns, places, at),
        specific_force=np.insert(series.specific_force, places, curved[:, :3], axis=0),
        angular_rate=np.insert(series.angular_rate, places, curved[:, 3:], axis=0),
        magnetic_field=_field(series, at, around),
    )


def _around(
    stamps: IntArray, lost: IntArray, config: AlignerConfig
) -> tuple[IntArray, list[IntArray]]:
    """Return the lost stamps whose holes are curved, and the four samples around each."""
    after = np.searchsorted(stamps, lost)
    inside = (after >= 2) & (after + 1 < len(stamps))
    after = after[inside]
    around = [after + k for k in (-2, -1, 0, 1)]
    first, before, behind, last = (stamps[k] for k in around)
    count = np.bincount(after)[after]
    good = is_curved(first, before, behind, count, config)
    good &= can_guide(last - behind, behind - before, count, config)
    return lost[inside][good], [k[good] for k in around]


def _field(series: ImuSeries, at: IntArray, around: list[IntArray]) -> FloatArray | None:
    """Return the magnetic field of all samples (N, 3), or None; on the line where it was lost."""
    field = series.magnetic_field
    if field is None:
        return None
    low, high = around[1], around[2]
    width = series.stamp_ns[high] - series.stamp_ns[low]
    share = ((at - series.stamp_ns[low]) / width)[:, None]
    line = field[low] + (field[high] - field[low]) * share
    return np.insert(field, high, line, axis=0)
