"""The stamps at which pairs are wanted, as they become known."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Protocol

from .pairing_config import AlignerConfig

BEFORE_ALL = -(1 << 63)


class Grid(Protocol):
    """Stamps of the common grid, in increasing order."""

    def admit(self, foot: str, stamp_ns: int, lost_ns: Sequence[int] = ()) -> None:
        """Learn that ``foot`` has a sample at ``stamp_ns``, and has lost some before it."""

    def head(self, newest_ns: int) -> int | None:
        """Return the next stamp a pair is wanted at, or None when none is known yet."""

    def advance(self, until_ns: int) -> int:
        """Drop the head, and all that is before ``until_ns``; return how many were dropped."""

    def forget(self, foot: str) -> None:
        """Forget the stamps of a foot whose clock was set."""


def grid_of(config: AlignerConfig) -> Grid:
    """Return the grid that ``config`` asks for."""
    return UniformGrid(config) if config.rate > 0 else ReferenceGrid(config)


class ReferenceGrid:
    """The stamps of one foot, and in its long holes those of the other.

    Samples of the reference that were lost in a short hole have stamps that divide it evenly.
    """

    def __init__(self, config: AlignerConfig) -> None:
        self._reference = config.reference
        self._max_gap_ns, self._tolerance_ns = config.max_gap_ns, config.tolerance_ns
        self._other: deque[int] = deque()
        self._done_ns = BEFORE_ALL
        self._restart()

    def _restart(self) -> None:
        self._own: deque[int] = deque()
        self._holes: deque[tuple[int, int]] = deque()
        self._newest_ns = BEFORE_ALL

    def admit(self, foot: str, stamp_ns: int, lost_ns: Sequence[int] = ()) -> None:
        """Take the stamps; one before the last pair comes too late."""
        own = foot == self._reference
        for each_ns in (*lost_ns, stamp_ns):
            self._append(self._own if own else self._other, each_ns)
        if not own:
            return
        if stamp_ns - self._newest_ns > self._max_gap_ns:
            self._holes.append((self._newest_ns, stamp_ns))
        self._newest_ns = stamp_ns

    def _append(self, pending: deque[int], stamp_ns: int) -> None:
        if stamp_ns > self._done_ns + self._tolerance_ns:
            pending.append(stamp_ns)

    def head(self, newest_ns: int) -> int | None:
        """Return the oldest stamp that is not dropped yet."""
        other = self._head_of_other()
        if other is not None and (not self._own or other < self._own[0]):
            return other
        return self._own[0] if self._own else None

    def _head_of_other(self) -> int | None:
        """Return the next stamp of the other foot that no sample of the reference is near.

        One that is newer than all of the reference may prove to be in a hole.
        """
        pending, holes = self._other, self._holes
        while pending:
            stamp_ns = pending[0]
            while holes and stamp_ns >= holes[0][1] - self._tolerance_ns:
                holes.popleft()
            end_of_known = holes[0][0] if holes else self._newest_ns
            if stamp_ns > end_of_known + self._tolerance_ns:
                return stamp_ns
            pending.popleft()
        return None

    def advance(self, until_ns: int) -> int:
        """Drop the head and what is before ``until_ns``; return how many."""
        dropped = 0
        for pending in (self._own, self._other):
            while pending and pending[0] < until_ns:
                pending.popleft()
                dropped += 1
        self._done_ns = max(self._done_ns, until_ns - 1)
        return dropped

    def forget(self, foot: str) -> None:
        """Forget the stamps of a foot whose clock was set."""
        if foot == self._reference:
            self._restart()
        else:
            self._other.clear()


class UniformGrid:
    """Stamps of a fixed rate, anchored where the feet begin.

    The anchor is the first stamp at which both are there, or that of the foot which is there
    first when the other begins later by more than the longest gap.
    """

    def __init__(self, config: AlignerConfig) -> None:
        self._config = config
        self._first: dict[str, int] = {}
        self._anchor: int | None = None
        self._next = 0

    def admit(self, foot: str, stamp_ns: int, lost_ns: Sequence[int] = ()) -> None:
        """Learn when each foot starts."""
        self._first.setdefault(foot, stamp_ns)

    def head(self, newest_ns: int) -> int | None:
        """Return the next stamp, or None before it is known where the grid begins."""
        if self._anchor is None and self._first:
            waited = len(self._first) > 1 or (
                newest_ns - min(self._first.values()) > self._config.max_delay_ns
            )
            self._anchor = anchor(list(self._first.values()), self._config) if waited else None
        return None if self._anchor is None else self._stamp(self._anchor, self._next)

    def advance(self, until_ns: int) -> int:
        """Drop the head and what is before ``until_ns``; return how many."""
        assert self._anchor is not None
        start = self._next
        # A long hole is jumped in one go; two short of it, so that rounding cannot overshoot.
        jump = int((until_ns - self._anchor) * self._config.rate * 1e-9) - 2
        self._next = max(start + 1, jump)
        while self._stamp(self._anchor, self._next) < until_ns:
            self._next += 1
        return self._next - start

    def forget(self, foot: str) -> None:
        """Do nothing: the grid goes on."""

    def _stamp(self, start: int, k: int) -> int:
        return start + round(k * 1e9 / self._config.rate)


def anchor(first_ns: list[int], config: AlignerConfig) -> int:
    """Return where a uniform grid begins, from the first stamp of each foot that is there."""
    together = max(first_ns) - min(first_ns) <= config.max_gap_ns
    return max(first_ns) if together else min(first_ns)
