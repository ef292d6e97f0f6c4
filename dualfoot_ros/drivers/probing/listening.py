"""Listening to a transport for some seconds, and finding the baud rate of a serial port."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple
from urllib.parse import parse_qsl, urlsplit

from ...core import SourceError
from ..source import make_transport
from ..transports.serial_port import SerialConfig
from ..transports.transport import Transport
from ..uri import SourceUri, check_scheme, parse_uri
from .recognition import Recognition, recognise

BAUDS = (115200, 921600, 460800, 230400, 9600, 57600, 38400, 1_000_000, 2_000_000)
SECONDS_A_BAUD = 0.7
MOST_BYTES = 1 << 22
ANY_FORMAT = "format=mcu"  # to make a transport before the format is known


class Chunk(NamedTuple):
    """Bytes of one read, when they came, and from whom."""

    data: bytes
    arrival_ns: int
    sender: str


@dataclass(frozen=True)
class Heard:
    """What a source sends: its URI with format and baud as found, and the bytes.

    ``recognised`` lists the formats that fit, the best first; ``tried`` the baud rates.
    """

    uri: str
    chunks: list[Chunk]
    recognised: list[Recognition]
    tried: tuple[int, ...] = ()

    @property
    def bytes(self) -> int:
        """Number of bytes that came."""
        return sum(len(chunk.data) for chunk in self.chunks)


def listen(
    uri: str,
    seconds: float = 3.0,
    *,
    make: Callable[[SourceUri], Transport] = make_transport,
    clock: Callable[[], int] = time.time_ns,
) -> Heard:
    """Listen to the source ``uri``, whose format and baud need not be given.

    Raises
    ------
    SourceError
        When the URI is wrong, or the source cannot be opened or is lost.
    """
    given = dict(parse_qsl(urlsplit(uri).query))
    source = _parse(uri)
    if source.scheme == "ble":  # one format, and its notifications are no stream
        return Heard(uri, _record(source, seconds, make, clock), [])
    if source.scheme == "serial" and "baud" not in given:
        return _try_bauds(uri, source, seconds, make, clock)
    chunks = _record(source, seconds, make, clock)
    recognised = recognise(chunk.data for chunk in chunks)
    return Heard(_with_format(uri, recognised), chunks, recognised)


def _try_bauds(
    uri: str,
    source: SourceUri,
    seconds: float,
    make: Callable[[SourceUri], Transport],
    clock: Callable[[], int],
) -> Heard:
    """Listen at one baud rate after the other, until a format is recognised."""
    tried = []
    chunks: list[Chunk] = []
    for baud in BAUDS:
        at_baud = _at_baud(source, baud)
        tried.append(baud)
        chunks = _record(at_baud, SECONDS_A_BAUD, make, clock)
        if any(found.samples for found in recognise(chunk.data for chunk in chunks)):
            chunks = _record(at_baud, seconds, make, clock)
            recognised = recognise(chunk.data for chunk in chunks)
            found_uri = _with_format(_add(uri, f"baud={baud}"), recognised)
            return Heard(found_uri, chunks, recognised, tuple(tried))
    return Heard(uri, chunks, [], tuple(tried))


def _at_baud(source: SourceUri, baud: int) -> SourceUri:
    assert isinstance(source.transport, SerialConfig)
    return replace(source, transport=replace(source.transport, baud=baud))


def _parse(uri: str) -> SourceUri:
    check_scheme(uri)  # in the words of the user
    known = "format=" in urlsplit(uri).query or urlsplit(uri).scheme == "ble"
    return parse_uri(uri if known else _add(uri, ANY_FORMAT))


def _record(
    source: SourceUri,
    seconds: float,
    make: Callable[[SourceUri], Transport],
    clock: Callable[[], int],
) -> list[Chunk]:
    transport = make(source)
    try:
        transport.open()
        return list(_read(transport, seconds, clock))
    except OSError as error:
        raise SourceError(f"{transport.description}: {error.strerror or error}") from error
    finally:
        transport.close()


def _read(transport: Transport, seconds: float, clock: Callable[[], int]) -> Iterator[Chunk]:
    until_s, count = time.monotonic() + seconds, 0
    while time.monotonic() < until_s and count < MOST_BYTES:
        data = transport.read()
        if data is None:
            return
        if data:
            count += len(data)
            yield Chunk(data, clock(), transport.sender)


def _with_format(uri: str, recognised: list[Recognition]) -> str:
    """Return the URI with the format that was found, in place of one that was given."""
    usable = [found for found in recognised if found.samples]
    if not usable:
        return uri
    base, _, query = uri.partition("?")
    kept = [part for part in query.split("&") if part and not part.startswith("format=")]
    return f"{base}?{'&'.join([*kept, f'format={usable[0].format}'])}"


def _add(uri: str, option: str) -> str:
    return f"{uri}{'&' if '?' in uri else '?'}{option}"
