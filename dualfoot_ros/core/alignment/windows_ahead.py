"""Windows that end among samples which have not been taken yet, all made at once."""

from __future__ import annotations

from bisect import bisect_left
from typing import NamedTuple

import numpy as np

from ..samples.series import BoolArray, FloatArray, IntArray

FEWEST_SAMPLES = 5  # of a window
TOGETHER = 256  # windows whose samples are laid side by side: some megabytes


class WindowsAhead(NamedTuple):
    """What a slider would hold and give if it took some samples.

    Attributes
    ----------
    held : how many of the samples the slider holds already
    stamp_ns, rows : (N,), (N, 6) samples, those that are held first
    begins : (N,) first sample of a window that would end with each
    ends : (W,) the last samples of the windows
    dues_ns : (W,) when the next one may end
    """

    held: int
    stamp_ns: IntArray
    rows: FloatArray
    begins: IntArray
    ends: list[int]
    dues_ns: list[int]

    def moments(self) -> tuple[FloatArray, FloatArray]:
        """Return mean and scatter (W, 6) of the windows."""
        ends = np.array(self.ends, dtype=np.int64)
        return moments(self.rows, self.begins[ends], ends)


def window_begins(stamp_ns: IntArray, length_ns: int) -> tuple[IntArray, BoolArray]:
    """Return the first sample (N,) of a window that ends with each, and which can be one.

    A window ends with a sample when one leaves it there and enough are in it.
    """
    begins: IntArray = np.searchsorted(stamp_ns, stamp_ns - length_ns, side="right")
    full = np.diff(begins, prepend=0) > 0
    full &= np.arange(len(stamp_ns)) - begins + 1 >= FEWEST_SAMPLES
    return begins, full


def window_ends(
    stamp_ns: IntArray, full: BoolArray, step_ns: int, due_ns: int | None = None
) -> tuple[list[int], list[int]]:
    """Return the samples with which windows end, a slide apart, and when the next ones may.

    ``stamp_ns`` (N,) rise, ``full`` (N,) are those with which one can, and ``due_ns`` is when the
    first one may.
    """
    ends, dues = [], []
    can = np.flatnonzero(full)
    rows, stamps = can.tolist(), stamp_ns[can].tolist()
    at = 0 if due_ns is None else bisect_left(stamps, due_ns)
    while at < len(rows):
        due_ns = max(due_ns or stamps[at], stamps[at] - step_ns) + step_ns
        ends.append(rows[at])
        dues.append(due_ns)
        at = bisect_left(stamps, due_ns, at + 1)
    return ends, dues


def moments(values: FloatArray, first: IntArray, last: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return mean and scatter (W, 6) of windows of samples (N, 6), summed as `Window.of` does."""
    mean, std = np.empty((len(first), 6)), np.empty((len(first), 6))
    counts = last - first + 1
    for count in set(counts.tolist()):
        alike = np.flatnonzero(counts == count)
        for at in np.array_split(alike, -(-len(alike) // TOGETHER)):
            block = values[first[at] + np.arange(count)[:, None]]
            mean[at] = block.sum(axis=0) / len(block)
            off = block - mean[at]
            std[at] = np.sqrt((off * off).sum(axis=0) / len(block))
    return mean, std
