"""Spacing of a foot's samples, and the stamps of those that were lost in a short hole."""

from __future__ import annotations

from collections import deque

import numpy as np

from ...core import IntArray

WINDOW = 32  # intervals before the hole: a third of a second at 100 Hz
CHUNK = 16_384  # holes that are looked at together


class Spacing:
    """The intervals between the latest samples of a foot, as they come.

    Nothing is filled before ``WINDOW`` intervals are known, nor where they are too irregular to
    say how many samples are missing (bunched stamps): there the median is not the mean.
    """

    def __init__(self, max_gap_ns: int) -> None:
        self._max_gap_ns = max_gap_ns
        self._intervals: deque[int] = deque(maxlen=WINDOW)
        self._sum = 0
        self._last_ns: int | None = None

    def fill(self, stamp_ns: int) -> list[int]:
        """Take the next stamp; return those of the samples that are missing before it."""
        last_ns, self._last_ns = self._last_ns, stamp_ns
        if last_ns is None or stamp_ns - last_ns > self._max_gap_ns:
            return []
        width, found = stamp_ns - last_ns, list[int]()
        if len(self._intervals) == WINDOW:
            # Cheap: a hole is longer than the mean, wherever the spacing is regular.
            if width * WINDOW > self._sum:
                found = _stamps(last_ns, width, _median(self._intervals), self._sum)
            self._sum -= self._intervals[0]
        self._intervals.append(width)
        self._sum += width
        return found


def filled(stamp_ns: IntArray, max_gap_ns: int) -> IntArray:
    """Return the stamps that `Spacing.fill` gives for increasing ``stamp_ns`` (N,), in order."""
    intervals = np.diff(stamp_ns)
    at = np.flatnonzero(intervals <= max_gap_ns)
    widths = intervals[at]
    if len(widths) <= WINDOW:
        return np.empty(0, dtype=np.int64)
    sums = np.convolve(widths, np.ones(WINDOW, dtype=np.int64), "valid")[:-1]
    holes = np.flatnonzero(widths[WINDOW:] * WINDOW > sums)
    windows = np.lib.stride_tricks.sliding_window_view(widths, WINDOW)
    found: list[int] = []
    for first in range(0, len(holes), CHUNK):
        some = holes[first : first + CHUNK]
        medians = np.partition(windows[some], WINDOW // 2, axis=1)[:, WINDOW // 2]
        for k, median in zip(some.tolist(), medians.tolist(), strict=True):
            start = int(stamp_ns[at[k + WINDOW]])
            found += _stamps(start, int(widths[k + WINDOW]), median, int(sums[k]))
    return np.array(found, dtype=np.int64)


def _median(intervals: deque[int]) -> int:
    return sorted(intervals)[WINDOW // 2]


def _stamps(start_ns: int, width: int, median: int, total: int) -> list[int]:
    """Return the stamps that divide a hole evenly; none where nothing is missing."""
    if median <= 0 or 2 * width <= 3 * median or 2 * total > 3 * WINDOW * median:
        return []
    parts = (2 * width + median) // (2 * median)
    return [start_ns + k * width // parts for k in range(1, parts)]
