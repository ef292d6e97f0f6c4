"""What every transport promises: open, read, close; the thread and the patience are elsewhere."""

from __future__ import annotations

from collections import Counter
from typing import Protocol

POLL_S = 0.1
"""A read that finds nothing returns after so long, so that a stop is heeded."""

CHUNK = 4096


class Transport(Protocol):
    """A link to a device or a file.  Used by one thread."""

    description: str
    """What it is linked to, for messages."""

    counters: Counter[str]

    reopens: bool
    """Whether a lost link is opened again; a file is not."""

    silence_s: float
    """A link that brings nothing for so long is opened again; 0 never."""

    def open(self) -> None:
        """Make the link; raise :class:`OSError` when it cannot be made now."""
        ...

    def read(self) -> bytes | None:
        """Return the next bytes, none after about ``POLL_S``, or None at the end of a file.

        Raises
        ------
        OSError
            When the link is lost.
        """
        ...

    def close(self) -> None:
        """Give everything back; raises nothing, and may be called at any time, also twice."""
        ...
