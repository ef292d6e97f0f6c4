"""Xbus: acceleration and rate of turn in messages of their own, as at high rate, made one sample.

Samples are at the stamps of the rate of turn.  Each waits for the next acceleration, so that the
specific force can be interpolated to its stamp.
"""

from __future__ import annotations

from collections import Counter, deque
from typing import NamedTuple

from ...core import Increments, Refusal, Vector

WRAP = 1 << 32  # of SampleTimeFine
MOST_WAITING = 64  # rates of turn between two accelerations
LONGEST_STEP = 1000  # ticks of 0.1 ms between two accelerations; across more is not interpolated


class Turn(NamedTuple):
    """A rate of turn and what came with it: ticks, counter, rad/s, field, what it is."""

    ticks: int | None
    counter: int | None
    rate: Vector
    field: Vector | None
    kind: Increments | None = None


class ApartHalves:
    """Joins messages with one half of a sample each; both need SampleTimeFine."""

    def __init__(self, counters: Counter[str]) -> None:
        """Count rates without acceleration, and accelerations without any rate, as incomplete."""
        self._counters = counters
        self.reset()

    def reset(self) -> None:
        """Forget what waits."""
        self._waiting: deque[Turn] = deque()
        self._force: tuple[int, Vector] | None = None
        self._sees_rates = False

    def add_rate(self, turn: Turn) -> None:
        """Take a rate of turn."""
        self._sees_rates = True
        if self._force is None or len(self._waiting) >= MOST_WAITING:
            self._counters[Refusal.INCOMPLETE] += 1
            return
        self._waiting.append(turn)

    def add_force(self, ticks: int, force: Vector) -> list[tuple[Turn, Vector]]:
        """Take an acceleration; return the rates of turn before it, with the force at each."""
        before, self._force = self._force, (ticks, force)
        self._counters[Refusal.INCOMPLETE] += before is not None and not self._sees_rates
        waiting = list(self._waiting)
        self._waiting.clear()
        if before is None:
            return []
        step = (ticks - before[0]) % WRAP
        if not 0 < step <= LONGEST_STEP:
            self._counters[Refusal.INCOMPLETE] += len(waiting)
            return []
        return [(turn, _between(before, step, force, turn.ticks or 0)) for turn in waiting]


def _between(before: tuple[int, Vector], step: int, force: Vector, ticks: int) -> Vector:
    """Return the force at ``ticks``, which is ``step`` ticks at most behind ``before``."""
    share = min(1.0, ((ticks - before[0]) % WRAP) / step)
    x, y, z = (a + share * (b - a) for a, b in zip(before[1], force, strict=True))
    return x, y, z
