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
        return windows(self._buffer, last - first)[self._starts + first]


def windows(buffer: bytes, width: int) -> Bytes:
    """Return every ``width`` bytes (L, width) of a buffer that follow each other, uncopied.

    ``sliding_window_view`` takes twenty times as long, and is called thousands of times.
    """
    count = max(0, len(buffer) - width + 1)
    return np.ndarray((count, width), dtype=np.uint8, buffer=buffer, strides=(1, 1))
