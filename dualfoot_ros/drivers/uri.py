"""URI of a source, parsed: ``serial:///dev/ttyUSB0?baud=921600&format=mcu``."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import PurePath
from typing import NamedTuple
from urllib.parse import SplitResult, parse_qsl, unquote, urlsplit

from ..core import ConfigError, Parameters, SourceError
from .protocols.registry import FORMATS, find_format
from .reader import BackoffConfig
from .transports.ble import BleConfig
from .transports.capture_file import FileConfig
from .transports.serial_port import SerialConfig
from .transports.tcp import TcpConfig
from .transports.udp import UdpConfig


class Scheme(NamedTuple):
    """A kind of source: its options, and an example."""

    options: type[Parameters]
    example: str


SCHEMES: dict[str, Scheme] = {
    "serial": Scheme(SerialConfig, "serial:///dev/ttyUSB0?baud=921600&format=mcu"),
    "udp": Scheme(UdpConfig, "udp://0.0.0.0:8000?format=ximu3&peers=192.168.1.5"),
    "tcp": Scheme(TcpConfig, "tcp://192.168.1.5:7000?format=ximu3"),
    "ble": Scheme(BleConfig, "ble://D4:22:CD:00:12:34?payload=rate"),
    "file": Scheme(FileConfig, "file://walk.csv"),
}
BLE_FORMATS = ("dot", "witmotion")
DEFAULT_FORMATS = {"ble": "dot"}
SUFFIX_FORMATS = {".csv": "dot_csv", ".ximu3": "ximu3"}  # of files


@dataclass(frozen=True)
class SourceUri:
    """Parts of a URI, checked."""

    scheme: str
    location: str
    format: str
    transport: Parameters
    decoder: Parameters
    backoff: BackoffConfig


def parse_uri(uri: str) -> SourceUri:
    """Return the parts of the URI of a source.

    Raises
    ------
    SourceError
        For an unknown scheme, format or option, or a value that is not allowed; says which.
    """
    parts = check_scheme(uri)
    if parts.fragment:
        raise SourceError(f"source '{uri}' has a '#'; write %23 where it is part of a name")
    location = unquote(parts.netloc + parts.path)
    if not location:
        raise SourceError(
            f"source '{uri}' names nothing; allowed is as in {SCHEMES[parts.scheme].example}"
        )
    return _parse_options(uri, parts.scheme, location, _parse_query(uri, parts.query))


def check_scheme(uri: str) -> SplitResult:
    """Return a URI in its parts; raise SourceError when its scheme is not known."""
    try:
        parts = urlsplit(uri)
    except ValueError as error:
        raise SourceError(f"source '{uri}' is no URI: {error}") from None
    if parts.scheme not in SCHEMES:
        meant = f" (did you mean 'serial://{uri}'?)" if uri.startswith("/dev/") else ""
        examples = ", ".join(scheme.example for scheme in SCHEMES.values())
        raise SourceError(
            f"source '{uri}' starts with no known scheme{meant}; allowed is, as in {examples}"
        )
    return parts


def _parse_query(uri: str, query: str) -> dict[str, str]:
    pairs = parse_qsl(query, keep_blank_values=True)
    twice = {name for name, _ in pairs if sum(name == other for other, _ in pairs) > 1}
    if twice:
        raise SourceError(f"source '{uri}' gives {', '.join(sorted(twice))} twice")
    return dict(pairs)


def _parse_options(uri: str, scheme: str, location: str, query: dict[str, str]) -> SourceUri:
    chosen = query.pop("format", "") or _choose_format(uri, scheme, location)
    groups = SCHEMES[scheme].options, find_format(chosen).options, BackoffConfig
    known = {spec.name for group in groups for spec in group.specs()}
    unknown = sorted(set(query) - known)
    if unknown:
        raise SourceError(
            f"source '{uri}' has an unknown option '{unknown[0]}'; "
            f"known: {', '.join(['format', *sorted(known)])}"
        )
    try:
        transport, decoder, backoff = (from_text(group, query) for group in groups)
    except ConfigError as error:
        raise SourceError(f"source '{uri}': {error}") from None
    assert isinstance(backoff, BackoffConfig)
    _check_fit(uri, scheme, chosen)
    return SourceUri(scheme, location, chosen, transport, decoder, backoff)


def _choose_format(uri: str, scheme: str, location: str) -> str:
    if scheme == "file" and (suffix := PurePath(location).suffix.lower()) in SUFFIX_FORMATS:
        return SUFFIX_FORMATS[suffix]
    if scheme not in DEFAULT_FORMATS:
        raise SourceError(
            f"source '{uri}' does not say what the device sends; add format= with one of "
            f"{', '.join(FORMATS)}"
        )
    return DEFAULT_FORMATS[scheme]


def _check_fit(uri: str, scheme: str, chosen: str) -> None:
    if scheme == "ble" and chosen not in BLE_FORMATS:
        raise SourceError(
            f"source '{uri}' has the format '{chosen}'; allowed over ble:// is one of "
            f"{', '.join(BLE_FORMATS)}"
        )
    if scheme != "ble" and chosen == "dot":
        raise SourceError(f"source '{uri}' has the format 'dot', which goes with ble:// only")


def from_text(group: type[Parameters], query: dict[str, str]) -> Parameters:
    """Build a group of parameters from those texts that are its own.

    Raises
    ------
    ConfigError
        When a text is not of the parameter's type or out of its range.
    """
    return group.from_mapping(dict(_read_values(group, query)))


def _read_values(group: type[Parameters], query: dict[str, str]) -> Iterator[tuple[str, object]]:
    for spec in group.specs():
        if spec.name in query:
            yield spec.name, _read_value(spec.type, query[spec.name])


def _read_value(kind: type, text: str) -> object:
    """Read a text as ``kind``; as it is where that fails, to be refused by name."""
    if kind is bool:
        return {"true": True, "1": True, "false": False, "0": False}.get(text.lower(), text)
    if kind is str:
        return text
    try:
        return int(text) if kind is int else float(text)
    except ValueError:
        return text
