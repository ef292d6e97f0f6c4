"""The stamps at which pairs are wanted, as they become known."""

from __future__ import annotations

from collections import deque
from typing import Protocol

from ...core import FEET
from .pairing_config import AlignerConfig


class Grid(Protocol):
    """Stamps of the common grid, in increasing order."""

    def admit(self, foot: str, stamp_ns: int) -> None:
        """Learn that ``foot`` has a sample at ``stamp_ns``."""

    def head(self) -> int | None:
        """Return the next stamp a pair is wanted at, or None when none is known yet."""

    def advance(self, until_ns: int) -> int:
        """Drop the head, and all that is before ``until_ns``; return how many were dropped."""


def grid_of(config: AlignerConfig) -> Grid:
    """Return the grid that ``config`` asks for."""
    return UniformGrid(config.rate) if config.rate > 0 else ReferenceGrid(config.reference)


class ReferenceGrid:
    """The stamps of one foot."""

    def __init__(self, reference: str) -> None:
        self._reference = reference
        self._pending: deque[int] = deque()

    def admit(self, foot: str, stamp_ns: int) -> None:
        """Take the stamp when it is one of the reference foot."""
        if foot == self._reference:
            self._pending.append(stamp_ns)

    def head(self) -> int | None:
        """Return the oldest stamp of the reference foot that is not dropped yet."""
        return self._pending[0] if self._pending else None

    def advance(self, until_ns: int) -> int:
        """Drop the head and what is before ``until_ns``; return how many."""
        before = len(self._pending)
        self._pending.popleft()
        while self._pending and self._pending[0] < until_ns:
            self._pending.popleft()
        return before - len(self._pending)


class UniformGrid:
    """Stamps of a fixed rate, anchored at the first stamp at which both feet are there."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        self._first: dict[str, int] = {}
        self._next = 0

    def admit(self, foot: str, stamp_ns: int) -> None:
        """Learn when each foot starts."""
        self._first.setdefault(foot, stamp_ns)

    def head(self) -> int | None:
        """Return the next stamp, or None before both feet are there."""
        return self._stamp(self._next) if len(self._first) == len(FEET) else None

    def advance(self, until_ns: int) -> int:
        """Drop the head and what is before ``until_ns``; return how many."""
        start = self._next
        # A long hole is jumped in one go; two short of it, so that rounding cannot overshoot.
        jump = int((until_ns - max(self._first.values())) * self._rate * 1e-9) - 2
        self._next = max(start + 1, jump)
        while self._stamp(self._next) < until_ns:
            self._next += 1
        return self._next - start

    def _stamp(self, k: int) -> int:
        return max(self._first.values()) + round(k * 1e9 / self._rate)
