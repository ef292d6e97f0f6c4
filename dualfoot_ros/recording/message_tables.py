"""Messages of one topic as arrays: fast where all have one layout, one by one where not."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..core import FloatArray, IntArray, RecordingError, new_array
from . import cdr
from .storage.bag_source import Block
from .storage.log_order import recorded_order
from .topics import FIELD_TYPE, IMU_TYPE, PRESSURE_TYPE, TRUTH_TYPE, VECTOR_TYPE

IMU_DOUBLES = 37  # orientation, its covariance, rate, covariance, specific force, covariance
FIELD_DOUBLES = 12  # field, its covariance
VECTOR_DOUBLES = 3
PRESSURE_DOUBLES = 2  # pressure, its variance
TRUTH_DOUBLES = 85  # pose (3 + 4), covariance (36), twist (3 + 3), covariance (36)
RATE = slice(13, 16)
FORCE = slice(25, 28)
MOST_ROOM = 1 << 22  # rows for which room is made because a bag says that it has as many


class _Layout(NamedTuple):
    doubles: int
    texts: int
    kept: tuple[slice, ...]


_LAYOUT = {
    IMU_TYPE: _Layout(IMU_DOUBLES, 1, (RATE, FORCE)),
    VECTOR_TYPE: _Layout(VECTOR_DOUBLES, 1, (slice(3),)),
    FIELD_TYPE: _Layout(FIELD_DOUBLES, 1, (slice(3),)),
    PRESSURE_TYPE: _Layout(PRESSURE_DOUBLES, 1, (slice(1),)),
    TRUTH_TYPE: _Layout(TRUTH_DOUBLES, 2, (slice(7), slice(43, 46))),
}


class Table(NamedTuple):
    """All messages of one topic: stamps (N,) ns, parts (N, K) of them, strings of the first.

    ``log_ns`` (N,) are the times at which the messages were logged.  ``parts`` are, by type, rate
    (3) and specific force (3), a vector or field (3), pressure (1), or pose (7) and velocity (3).
    """

    stamp_ns: IntArray
    parts: tuple[FloatArray, ...]
    texts: list[str]
    log_ns: IntArray

    @property
    def rate(self) -> FloatArray:
        """Angular rate (N, 3) of a topic of samples, or all of a topic of vectors."""
        return self.parts[0]

    @property
    def force(self) -> FloatArray:
        """Specific force (N, 3) of a topic of samples, or all of a topic of vectors."""
        return self.parts[-1]


class _Rows:
    """Arrays one below the other in a single one, which grows where its room was too little.

    Thousands of small ones, put together at the end, would leave as much memory that is free and
    of no use: the heap is full of holes then.
    """

    def __init__(self, room: int) -> None:
        self._room, self._count = min(room, MOST_ROOM), 0
        self._array: NDArray[Any] | None = None

    def add(self, rows: NDArray[Any]) -> None:
        """Add rows (K, ...) at the end."""
        end = self._count + len(rows)
        if self._array is None or end > len(self._array):
            larger = new_array((max(self._room, 2 * end), *rows.shape[1:]), rows.dtype)
            if self._array is not None:
                larger[: self._count] = self._array[: self._count]
            self._array = larger
        self._array[self._count : end] = rows
        self._count = end

    def all(self) -> NDArray[Any]:
        """Return what was added; there is something."""
        assert self._array is not None
        return self._array[: self._count]


class TableBuilder:
    """A table in the making: every block is decoded when it comes, and only its values stay."""

    def __init__(self, msgtype: str, topic: str, expected: int = 0) -> None:
        """Begin the table of a topic of which so many messages are ``expected``."""
        self._topic, self._layout = topic, _LAYOUT[msgtype]
        self._stamps, self._logged = _Rows(expected), _Rows(expected)
        self._parts = [_Rows(expected) for _ in self._layout.kept]
        self._files: list[tuple[int, int]] = []  # number of the file, and of messages in a row
        self._texts: list[str] = []
        self._count = 0
        self._sorted = True

    def add(self, block: Block) -> None:
        """Decode the messages of a block.

        Raises
        ------
        RecordingError
            When a message cannot be decoded; names the topic and which message it is.
        """
        layout = self._layout
        fast = cdr.decode(block.rows, layout.doubles, layout.texts, layout.kept)
        stamps, parts, texts = fast or self._one_by_one(block)
        self._texts = self._texts or texts
        self._stamps.add(stamps)
        for rows, part in zip(self._parts, parts, strict=True):
            rows.add(part)
        self._logged.add(block.log_ns)
        self._sorted = self._sorted and block.file is None
        self._files.append((block.file or 0, len(stamps)))
        self._count += len(stamps)

    def table(self) -> Table:
        """Return what was decoded, in the order of the recording."""
        if not self._count:
            return self._empty()
        stamps, logged = self._stamps.all(), self._logged.all()
        parts = tuple(rows.all() for rows in self._parts)
        if self._sorted:
            return Table(stamps, parts, self._texts, logged)
        files = np.repeat(*np.array(self._files, dtype=np.int64).T)
        if bool((np.diff(logged) >= 0).all() and (np.diff(files) >= 0).all()):
            return Table(stamps, parts, self._texts, logged)
        order = recorded_order(logged, files)
        parts = tuple(part[order] for part in parts)
        return Table(stamps[order], parts, self._texts, logged[order])

    def _empty(self) -> Table:
        """Return the table of a topic without messages."""
        none, nothing = np.empty(0, dtype=np.int64), np.empty((0, self._layout.doubles))
        parts = tuple(nothing[:, kept] for kept in self._layout.kept)
        return Table(none, parts, [""] * self._layout.texts, none)

    def _one_by_one(self, block: Block) -> tuple[IntArray, list[FloatArray], list[str]]:
        doubles, texts, kept = self._layout
        stamps = np.empty(len(block.rows), dtype=np.int64)
        values = np.empty((len(block.rows), doubles))
        strings: list[str] = []
        for i, data in enumerate(block.rows):
            try:
                stamps[i], values[i], found = cdr.decode_one(bytes(data), doubles, texts)
            except ValueError as error:
                raise RecordingError(
                    f"message {self._count + i} of topic '{self._topic}' is damaged ({error}); "
                    "record again or cut the bag before it"
                ) from error
            strings = strings or found
        return stamps, [values[:, part] for part in kept], strings
