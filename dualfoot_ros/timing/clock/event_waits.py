"""How long notifications waited for an event of the link: those that bound the line of a clock."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .line import Line

Point = tuple[float, float]  # time, offset plus wait, s


@dataclass
class _Bin:
    """The notifications of a bin that tell most, whole intervals taken off but for one."""

    number: int
    least: Point | None = None  # the shortest wait
    short: Point | None = None  # the longest wait short of an interval
    over: Point | None = None  # the shortest beyond one


class EventWaits:
    """Keep of every bin the waits nearest to nothing and, from both sides, to an interval.

    They bound a line from above and from below (:func:`~.line.fit_between`).  Whole intervals
    that a wait had before are taken off: events failed then, whatever the line.
    """

    def __init__(self, bin_s: float, bins: int) -> None:
        self._bin_s = bin_s
        self._bins: deque[_Bin] = deque(maxlen=bins)
        self.interval_s = 0.0

    def __len__(self) -> int:
        return len(self._bins)

    @property
    def least(self) -> FloatArray:
        """The shortest waits (n, 2): time, offset plus wait, s."""
        return _array([b.least for b in self._bins])

    @property
    def longest(self) -> FloatArray:
        """The waits (n, 2) nearest to an interval."""
        return _array([p for b in self._bins for p in (b.short, b.over)])

    def clear(self) -> None:
        """Forget all: the link has no events, or others."""
        self._bins.clear()

    def add(self, time_s: float, delayed_s: float, interval_s: float, line: Line) -> None:
        """Take a notification, ``delayed_s`` its event minus its device stamp."""
        self.interval_s = interval_s
        number = math.floor(time_s / self._bin_s)
        if not self._bins or number > self._bins[-1].number:
            self._bins.append(_Bin(number))
        kept = self._bins[-1]

        def wait(point: Point) -> float:
            return point[1] - line.at(point[0])

        point = (time_s, delayed_s)
        kept.least = min(kept.least or point, point, key=wait)
        failed = max(math.floor(wait(point) / interval_s), 0)
        short = (time_s, delayed_s - failed * interval_s)
        kept.short = max(kept.short or short, short, key=wait)
        if failed:
            over = (time_s, short[1] + interval_s)
            kept.over = min(kept.over or over, over, key=wait)


def _array(points: list[Point | None]) -> FloatArray:
    return np.array([p for p in points if p is not None]).reshape(-1, 2)
