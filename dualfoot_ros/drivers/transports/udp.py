"""UDP: bind a port and take datagrams, from listed peers only where a list is given."""

from __future__ import annotations

import ipaddress
import socket
from collections import Counter
from dataclasses import dataclass

from ...core import Parameters, SourceError, parameter
from .address import Address, resolve
from .senders import MAX_SENDERS
from .transport import POLL_S

MAX_DATAGRAM = 65535
RECEIVE_BUFFER = 1 << 20  # bytes; a stall of a second or two loses nothing


@dataclass(frozen=True)
class UdpOptions(Parameters):
    """Options of a UDP source."""

    peers: str = parameter("", "IP addresses to take datagrams from, with commas; empty: any")


class UdpTransport:
    """Take datagrams on one port.

    ``sender`` is the address and port of the newest datagram.  Datagrams of others than the
    peers are counted as ``foreign``, and ``strangers`` holds their addresses.
    """

    reopens = True
    silence_s = 0.0  # there is no link that could be dead

    def __init__(self, address: Address, options: UdpOptions | None = None) -> None:
        """Name what to bind; nothing is opened yet.

        Raises
        ------
        SourceError
            When a peer is no IP address.
        """
        self.description = f"UDP {address}"
        self.counters: Counter[str] = Counter()
        self.sender = ""
        self.strangers: dict[str, int] = {}
        self._address = address
        self.peers = frozenset(_peers((options or UdpOptions()).peers))
        self._socket: socket.socket | None = None

    def open(self) -> None:
        """Bind the port; raise :class:`OSError` when it is taken or the address not ours."""
        family, address = resolve(self._address, socket.SOCK_DGRAM)
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER)
        self._socket.settimeout(POLL_S)
        self._socket.bind(address)

    def read(self) -> bytes:
        """Return one datagram."""
        assert self._socket is not None
        try:
            data, sender = self._socket.recvfrom(MAX_DATAGRAM)
        except TimeoutError:
            return b""
        host = sender[0].partition("%")[0]
        if self.peers and host not in self.peers:
            self._refuse(host)
            return b""
        self.sender = str(Address(host, sender[1]))
        self.counters["datagrams"] += 1
        return data

    def _refuse(self, host: str) -> None:
        self.counters["foreign"] += 1
        if host in self.strangers or len(self.strangers) < MAX_SENDERS:
            self.strangers[host] = self.strangers.get(host, 0) + 1

    @property
    def port(self) -> int:
        """The port that is bound: of use where 0 asked for any."""
        return 0 if self._socket is None else int(self._socket.getsockname()[1])

    def close(self) -> None:
        """Give the port back."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None


def _peers(text: str) -> list[str]:
    peers = [part.strip() for part in text.split(",") if part.strip()]
    try:
        return [str(ipaddress.ip_address(peer)) for peer in peers]
    except ValueError:
        raise SourceError(
            f"peers are '{text}'; allowed are IP addresses with commas between them"
        ) from None
