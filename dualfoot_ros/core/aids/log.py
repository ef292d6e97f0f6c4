"""What a sensor has measured lately, by its stamps."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import Generic, TypeVar

from ..samples.pair_gate import BACK_NS

T = TypeVar("T")

KEEP_NS = 60_000_000_000


class Log(Generic[T]):
    """Values over time, in the order of their stamps."""

    def __init__(self) -> None:
        """Start with nothing measured."""
        self._stamps: list[int] = []
        self._values: list[T] = []

    def put(self, stamp_ns: int, value: T) -> bool:
        """Take a value; return whether its stamp follows.

        A stamp far before the newest one begins a new recording, or shows that the newest was
        wrong: what is not before it is forgotten.
        """
        if self._stamps and stamp_ns <= self._stamps[-1]:
            if self._stamps[-1] - stamp_ns < BACK_NS:
                return False
            kept = bisect_left(self._stamps, stamp_ns)
            del self._stamps[kept:], self._values[kept:]
        self._stamps.append(stamp_ns)
        self._values.append(value)
        return True

    def trim(self) -> None:
        """Forget what is too old to be asked for, now and then.

        The age is against the stamp before the newest, as that one alone may be wrong.
        """
        if len(self._stamps) > 1 and self._stamps[-2] - self._stamps[0] > 2 * KEEP_NS:
            old = bisect_left(self._stamps, self._stamps[-2] - KEEP_NS)
            del self._stamps[:old], self._values[:old]

    def between(self, first_ns: int, last_ns: int) -> list[T]:
        """Return the values from ``first_ns`` to ``last_ns``, both included."""
        first, stop = bisect_left(self._stamps, first_ns), bisect_right(self._stamps, last_ns)
        return self._values[first:stop]
