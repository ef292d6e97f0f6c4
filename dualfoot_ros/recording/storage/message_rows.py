"""Messages of one length where they stand in a buffer: only what is asked for is copied."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ...core import IntArray

Bytes = NDArray[np.uint8]


class MessageRows:
    """Messages (N,) of ``length`` bytes that begin at ``starts`` in a buffer."""

    def __init__(self, buffer: bytes, starts: IntArray, length: int) -> None:
        """Look at the messages; they are all within ``buffer``."""
        self._buffer, self._starts, self.length = buffer, starts, length

    @classmethod
    def of(cls, messages: Sequence[bytes] | MessageRows) -> MessageRows | None:
        """Return messages one behind the other; None where their lengths differ."""
        if isinstance(messages, MessageRows):
            return messages
        length = len(messages[0])
        if any(len(message) != length for message in messages):
            return None
        return cls(b"".join(messages), np.arange(len(messages)) * length, length)

    def __len__(self) -> int:
        """Return the number of messages."""
        return len(self._starts)

    def __getitem__(self, number: int) -> bytes:
        """Return one message."""
        start = int(self._starts[number])
        return self._buffer[start : start + self.length]

    def __iter__(self) -> Iterator[bytes]:
        """Yield one message after the other."""
        return (self[number] for number in range(len(self)))

    def columns(self, first: int, last: int) -> Bytes:
        """Return the bytes (N, last - first) from ``first`` to before ``last`` of each message."""
        return rows_at(self._buffer, self._starts + first, last - first)


def rows_at(buffer: bytes, starts: IntArray, width: int) -> Bytes:
    """Return the ``width`` bytes (N, width), at least one, that begin at each of ``starts``.

    They are taken as items of that size: a row of bytes takes twice as long.
    """
    count = max(0, len(buffer) - width + 1)
    items = np.ndarray((count,), dtype=f"V{width}", buffer=buffer, strides=(1,))
    return items[starts].view(np.uint8).reshape(len(starts), width)
