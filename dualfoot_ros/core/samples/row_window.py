"""Rows of numbers of which new ones are added behind and old ones are dropped in front."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .series import FloatArray


class RowWindow:
    """The rows lie in a row in memory, so that they are an array without being copied."""

    def __init__(self, columns: int) -> None:
        self._memory = np.empty((2, columns))
        self._first = self._end = 0

    def append(self, row: Sequence[float] | FloatArray) -> None:
        """Add a row."""
        if self._end == len(self._memory):
            self._make_room()
        self._memory[self._end] = row
        self._end += 1

    def hold(self, rows: FloatArray) -> None:
        """Hold these rows in place of all others."""
        if len(rows) > len(self._memory):
            self._memory = np.empty((2 * len(rows), self._memory.shape[1]))
        self._first, self._end = 0, len(rows)
        self._memory[: self._end] = rows

    def drop_first(self) -> None:
        """Drop the oldest row."""
        self._first += 1

    def clear(self) -> None:
        """Drop all rows."""
        self._first = self._end = 0

    def rows(self) -> FloatArray:
        """Return all rows, the oldest first, until the next one is added."""
        return self._memory[self._first : self._end]

    def _make_room(self) -> None:
        """Move the rows to the front of memory, of which they take half at most."""
        kept = self.rows().copy()
        if 2 * len(kept) > len(self._memory):
            self._memory = np.empty((2 * len(self._memory), self._memory.shape[1]))
        self.hold(kept)
