"""UDP: datagrams on a bound port, from listed peers only where a list is given."""

from __future__ import annotations

import ipaddress
import socket
from dataclasses import dataclass

from ...core import Parameters, Refusal, SourceError, parameter
from .address import Address, resolve
from .senders import MAX_SENDERS
from .transport import POLL_S, Transport

MAX_DATAGRAM = 65535
RECEIVE_BUFFER = 1 << 20  # bytes; a stall of a second or two loses nothing


@dataclass(frozen=True)
class UdpConfig(Parameters):
    """Options of a UDP source."""

    peers: str = parameter("", "IP addresses to take datagrams from, with commas; empty: any")


class UdpTransport(Transport):
    """Datagrams on one port; those of others than the peers are counted as ``foreign``."""

    connectionless = True

    def __init__(self, address: Address, config: UdpConfig | None = None) -> None:
        """Name the address to bind; nothing is opened yet.

        Raises
        ------
        SourceError
            When a peer is no IP address.
        """
        super().__init__(f"UDP {address}")
        self._address = address
        self.peers = frozenset(_parse_peers((config or UdpConfig()).peers))
        self._socket: socket.socket | None = None

    def open(self) -> None:
        """Bind the port; raise :class:`OSError` when it is taken or the address is not ours."""
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
            self._count_stranger(host)
            return b""
        self.sender = str(Address(host, sender[1]))
        self.counters["datagrams"] += 1
        return data

    def _count_stranger(self, host: str) -> None:
        self.counters[Refusal.FOREIGN] += 1
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


def _parse_peers(text: str) -> list[str]:
    peers = [part.strip() for part in text.split(",") if part.strip()]
    try:
        return [str(ipaddress.ip_address(peer)) for peer in peers]
    except ValueError:
        raise SourceError(
            f"peers are '{text}'; allowed are IP addresses with commas between them"
        ) from None
