"""Devices that are there: announcements of x-IMU3, serial ports, Bluetooth where bleak is."""

import json
import socket
import sys
import threading
from types import SimpleNamespace

import pytest

from dualfoot_ros.drivers import SourceError, announced_devices, bluetooth_devices, serial_ports
from dualfoot_ros.drivers.probing import scan

MESSAGE = {
    "sync": 0,
    "name": "Left foot",
    "sn": "0123-4567",
    "ip": "192.168.1.5",
    "port": 7000,
    "send": 8000,
    "receive": 9000,
    "rssi": 80,
}


def test_an_announcement_becomes_the_uris_of_the_device():
    found = scan.read_announcement(json.dumps(MESSAGE).encode())
    assert found.about == "Left foot 0123-4567"
    assert found.uris == (
        "udp://0.0.0.0:8000?format=ximu3&peers=192.168.1.5",
        "tcp://192.168.1.5:7000?format=ximu3",
    )


@pytest.mark.parametrize("data", [b"", b"nonsense", b"[1, 2]", b'{"name": "x"}', b"\xff\xfe"])
def test_other_datagrams_are_no_announcement(data):
    assert scan.read_announcement(data) is None


def test_a_device_that_announces_itself_twice_is_found_once():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    over = threading.Event()

    def announce():
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            while not over.wait(0.02):
                out.sendto(json.dumps(MESSAGE).encode(), ("127.0.0.1", port))

    thread = threading.Thread(target=announce)
    thread.start()
    try:
        found = announced_devices(seconds=2.0, port=port)
    finally:
        over.set()
        thread.join()
    assert [device.about for device in found] == ["Left foot 0123-4567"]


def test_a_port_that_another_program_uses_is_a_sentence():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("0.0.0.0", 0))
        with pytest.raises(SourceError, match="announces itself, cannot be used"):
            announced_devices(seconds=0.1, port=taken.getsockname()[1])


def test_usb_ports_come_before_those_of_the_board(monkeypatch):
    from serial.tools import list_ports

    ports = [
        SimpleNamespace(device="/dev/ttyS0", description="n/a", vid=None),
        SimpleNamespace(device="/dev/ttyUSB1", description="CP2102", vid=0x10C4),
    ]
    monkeypatch.setattr(list_ports, "comports", lambda: ports)
    found = serial_ports()
    assert [device.uris for device in found] == [
        ("serial:///dev/ttyUSB1",),
        ("serial:///dev/ttyS0",),
    ]


def test_bluetooth_needs_bleak_and_lists_what_has_a_name(monkeypatch):
    find = scan.util.find_spec
    monkeypatch.setattr(scan.util, "find_spec", lambda n: None if n == "bleak" else find(n))
    with pytest.raises(SourceError, match="pip install 'dualfoot_ros"):
        bluetooth_devices(0.1)

    async def discover(timeout):
        names = {"01": None, "34": "Xsens DOT", "56": "WT901BLE68"}
        return [SimpleNamespace(address=f"D4:22:CD:00:12:{a}", name=n) for a, n in names.items()]

    monkeypatch.setattr(scan.util, "find_spec", lambda n: object())
    bleak = SimpleNamespace(BleakScanner=SimpleNamespace(discover=discover))
    monkeypatch.setitem(sys.modules, "bleak", bleak)
    assert bluetooth_devices(0.1) == [
        (("ble://D4:22:CD:00:12:34",), "Xsens DOT"),
        (("ble://D4:22:CD:00:12:56?format=witmotion",), "WT901BLE68"),
    ]
