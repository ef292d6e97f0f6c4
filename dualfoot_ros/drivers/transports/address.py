"""Network addresses, as they stand in the URI of a source."""

from __future__ import annotations

import socket
from typing import Any, NamedTuple

from ...core import SourceError

LOOPBACK = "127.0.0.1"


class Address(NamedTuple):
    """A host and a port."""

    host: str
    port: int

    def __str__(self) -> str:
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{host}:{self.port}"


def parse(text: str) -> Address:
    """Return the address in ``HOST:PORT``, ``[IPV6]:PORT`` or ``:PORT``, which is loopback.

    Raises
    ------
    SourceError
        When there is no port, or it is out of range.
    """
    host, colon, port = text.rpartition(":")
    digits = port.isascii() and port.isdigit() and len(port) <= 5
    if not colon or not digits or int(port) > 65535 or not _is_host(host):
        raise SourceError(
            f"the address is '{text}'; allowed is HOST:PORT with a port from 0 to 65535, "
            f"and :PORT for this machine only ({LOOPBACK})"
        )
    return Address(host.strip("[]") or LOOPBACK, int(port))


def _is_host(host: str) -> bool:
    try:
        host.encode("idna")
    except UnicodeError:
        return False
    return True


def resolve(address: Address, kind: socket.SocketKind) -> tuple[socket.AddressFamily, Any]:
    """Return family and socket address; raise :class:`OSError` when the name is unknown."""
    family, _, _, _, resolved = socket.getaddrinfo(address.host, address.port, type=kind)[0]
    return family, resolved
