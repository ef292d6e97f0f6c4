"""Devices that are there: serial ports, Bluetooth devices, x-IMU3 that announce themselves."""

from __future__ import annotations

import json
import socket
import time
from collections.abc import Iterator
from importlib import util
from typing import NamedTuple

from ...core import SourceError

ANNOUNCEMENTS = 10000  # UDP port on which an x-IMU3 announces itself, about once a second
ANY = "0.0.0.0"  # noqa: S104  (announcements are broadcast to the network)
POLL_S = 0.1
WITMOTION = "WT"  # how the names of WitMotion's devices begin


class Found(NamedTuple):
    """A device: URIs that may name it, and what it says of itself."""

    uris: tuple[str, ...]
    about: str


def serial_ports() -> list[Found]:
    """Return the serial ports; those that belong to USB devices first.

    Raises
    ------
    SourceError
        When pyserial is not installed.
    """
    if util.find_spec("serial") is None:
        raise SourceError("serial ports need the package pyserial: pip install pyserial")
    from serial.tools import list_ports

    ports = sorted(list_ports.comports(), key=lambda port: (port.vid is None, port.device))
    return [Found((f"serial://{p.device}",), str(p.description or "")) for p in ports]


def bluetooth_devices(seconds: float = 5.0) -> list[Found]:
    """Return the Bluetooth devices that have a name.

    Raises
    ------
    SourceError
        When bleak is not installed, or Bluetooth cannot be used.
    """
    if util.find_spec("bleak") is None:
        raise SourceError("Bluetooth needs bleak: pip install 'dualfoot_ros[ble]'")
    import asyncio

    from bleak import BleakScanner

    try:
        devices = asyncio.run(BleakScanner.discover(timeout=seconds))
    except Exception as error:  # bleak has errors of its own for each system
        raise SourceError(f"Bluetooth cannot be used: {error}") from error
    named = [device for device in devices if device.name]
    return [Found((_ble_uri(d.address, d.name),), d.name) for d in sorted(named, key=str)]


def _ble_uri(address: str, name: str) -> str:
    return f"ble://{address}{'?format=witmotion' if name.startswith(WITMOTION) else ''}"


def announced_devices(seconds: float = 3.0, port: int = ANNOUNCEMENTS) -> list[Found]:
    """Return the x-IMU3 that announce themselves by UDP, each once.

    Raises
    ------
    SourceError
        When the port is taken, as by the maker's program.
    """
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
            listener.bind((ANY, port))
            listener.settimeout(POLL_S)
            found = {d.about: d for d in _announcements(listener, seconds)}
    except OSError as error:
        raise SourceError(
            f"UDP port {port}, on which an x-IMU3 announces itself, cannot be used: {error}"
        ) from error
    return list(found.values())


def _announcements(listener: socket.socket, seconds: float) -> Iterator[Found]:
    until_s = time.monotonic() + seconds
    while time.monotonic() < until_s:
        try:
            data = listener.recv(2048)
        except TimeoutError:
            continue
        device = read_announcement(data)
        if device is not None:
            yield device


def read_announcement(data: bytes) -> Found | None:
    """Return the device that sent an announcement, or None where it is none.

    It is one JSON object with ``name``, ``sn``, ``ip``, the TCP ``port``, and the UDP ports to
    which it ``send``s and on which it ``receive``s.
    """
    try:
        message = json.loads(data)
    except ValueError:
        return None
    if not isinstance(message, dict) or not isinstance(message.get("ip"), str):
        return None
    uris = []
    if isinstance(send := message.get("send"), int) and 0 < send < 65536:
        uris.append(f"udp://0.0.0.0:{send}?format=ximu3&peers={message['ip']}")
    if isinstance(port := message.get("port"), int) and 0 < port < 65536:
        uris.append(f"tcp://{message['ip']}:{port}?format=ximu3")
    return Found(tuple(uris), f"{message.get('name', 'x-IMU3')} {message.get('sn', '')}".strip())
