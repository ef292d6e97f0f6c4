"""TCP: a connection to a device that serves its samples."""

from __future__ import annotations

import socket
from dataclasses import dataclass

from ...core import Parameters, SourceError, parameter
from .address import Address
from .transport import CHUNK, POLL_S, Transport

CONNECT_S = 1.0


@dataclass(frozen=True)
class TcpConfig(Parameters):
    """Options of a TCP source."""

    silence: float = parameter(
        5.0,
        "connect again after so long without a byte, as a switched-off device says no farewell",
        unit="s",
        minimum=0.0,
        maximum=3600.0,
    )


class TcpTransport(Transport):
    """Connection to one server."""

    def __init__(self, address: Address, config: TcpConfig | None = None) -> None:
        """Name the server; nothing is opened yet.

        Raises
        ------
        SourceError
            When the port is 0, which no server can have.
        """
        if address.port == 0:
            raise SourceError(f"the address is '{address}'; allowed is a port from 1 to 65535")
        super().__init__(f"TCP {address}")
        self.silence_s = (config or TcpConfig()).silence
        self._address = address
        self._socket: socket.socket | None = None

    def open(self) -> None:
        """Connect; raise :class:`OSError` when no server answers within a second."""
        self._socket = socket.create_connection(self._address, timeout=CONNECT_S)
        self._socket.settimeout(POLL_S)

    def read(self) -> bytes:
        """Return what has come; raise :class:`OSError` when the server has closed."""
        assert self._socket is not None
        try:
            data = self._socket.recv(CHUNK)
        except TimeoutError:
            return b""
        if not data:
            raise ConnectionResetError("the other side has closed the connection")
        return data

    def close(self) -> None:
        """Close the connection."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None
