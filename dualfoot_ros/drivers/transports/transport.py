"""Base class of the transports: links to devices, and files."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter

POLL_S = 0.1
"""A read that finds nothing returns after so long, so that the thread can be stopped."""

CHUNK = 4096


class Transport(ABC):
    """A link to a device, or a file; used by one thread, which opens, reads and closes it.

    Attributes
    ----------
    description : what it is linked to, for messages
    counters : what it counts itself
    reopens : whether a lost link is opened again; a file is not
    silence_s : a link that brings nothing for so long is opened again; 0 never
    speed : speed at which samples are handed on, as a multiple of real time by the device's own
        clock; 0 as they come
    connectionless : whether any device may send here, so that the samples of several can mix
    sender : address of the device that sent what was read last; "" on a link to one device
    peers : addresses that bytes are taken from; empty for any
    strangers : datagrams by the address of a sender that is not among the peers
    """

    reopens: bool = True
    silence_s: float = 0.0
    speed: float = 0.0
    connectionless: bool = False

    def __init__(self, description: str) -> None:
        self.description = description
        self.counters: Counter[str] = Counter()
        self.sender = ""
        self.peers: frozenset[str] = frozenset()
        self.strangers: dict[str, int] = {}

    @abstractmethod
    def open(self) -> None:
        """Make the link; raise :class:`OSError` when it cannot be made now."""

    @abstractmethod
    def read(self) -> bytes | None:
        """Return the next bytes, none after about ``POLL_S``, or None at the end of a file.

        Raises
        ------
        OSError
            When the link is lost.
        """

    @abstractmethod
    def close(self) -> None:
        """Give everything back; raises nothing, and may be called at any time, also twice."""
