"""A DOT over Bluetooth, with a stand-in for the radio: what is asked of the device, and when."""

import asyncio
import functools
import importlib.machinery
import sys
import types

import pytest

from dualfoot_ros.drivers import Source, SourceError, State, make_transport, parse_uri

from ..frames import dot, truth, witmotion_combined
from ..links import Collector, held, settle

BASE = "1517{}-4947-11e9-8646-d663bd873d93"
WITMOTION = "0000ffe4-0000-1000-8000-00805f9a34fb"
URI = "ble://D4:22:CD:00:12:34?payload=rate&retry_first=0.01&retry_max=0.05"


class Radio:
    """Devices that answer; ``log`` holds what was asked of them."""

    def __init__(self):
        self.log = []
        self.refuse = 0
        self.notify_then_leave = 0


class Client:
    """What bleak has for one device: it answers as its ``radio`` says."""

    def __init__(self, radio, address, disconnected_callback=None):
        self.radio, self.address, self.gone = radio, address, disconnected_callback
        self.is_connected = False

    async def connect(self):
        if self.radio.refuse:
            self.radio.refuse -= 1
            raise RuntimeError("not in range")
        self.is_connected = True
        self.radio.log.append(("connect", self.address))

    async def start_notify(self, characteristic, callback):
        self.notified = callback
        self.radio.log.append(("notify", characteristic))
        if characteristic == WITMOTION:  # which sends by itself
            loop = asyncio.get_running_loop()
            for k in range(5):
                loop.call_soon(callback, 0, bytearray(witmotion_combined(k)))

    async def write_gatt_char(self, characteristic, data, response):
        self.radio.log.append(("write", characteristic, bytes(data)))
        if bytes(data)[1] == 1:
            loop = asyncio.get_running_loop()
            for k in range(3):
                loop.call_soon(self.notified, 0, bytearray(dot(k)))
            if self.radio.notify_then_leave:
                self.radio.notify_then_leave -= 1
                loop.call_soon(self.leave)

    def leave(self):
        self.is_connected = False
        self.gone(self)

    async def disconnect(self):
        self.is_connected = False
        self.radio.log.append(("disconnect",))


@pytest.fixture
def radio(monkeypatch):
    found = Radio()
    bleak = types.ModuleType("bleak")
    bleak.__spec__ = importlib.machinery.ModuleSpec("bleak", None)
    bleak.BleakClient = functools.partial(Client, found)
    monkeypatch.setitem(sys.modules, "bleak", bleak)
    return found


def test_a_dot_is_asked_to_measure_read_and_asked_to_stop(radio):
    before = held()
    collector = Collector()
    with Source(URI, collector.take, on_state=collector.state):
        assert collector.wait_for_samples(3)
    assert collector.samples[2].specific_force == pytest.approx(truth(2)[0], rel=1e-6)
    assert radio.log == [
        ("connect", "D4:22:CD:00:12:34"),
        ("notify", BASE.format("2003")),
        ("write", BASE.format("2001"), bytes([1, 1, 21])),
        ("write", BASE.format("2001"), bytes([1, 0, 21])),
        ("disconnect",),
    ]
    assert settle(before) == before


def test_a_witmotion_sends_by_itself_and_is_asked_for_nothing(radio):
    collector = Collector()
    with Source("ble://D4:22:CD:00:12:34?format=witmotion", collector.take):
        assert collector.wait_for_samples(5)
    assert collector.samples[4].specific_force == pytest.approx(truth(4)[0], abs=3e-3)
    assert radio.log == [
        ("connect", "D4:22:CD:00:12:34"),
        ("notify", WITMOTION),
        ("disconnect",),
    ]


def test_a_dot_that_leaves_is_connected_to_again(radio):
    radio.notify_then_leave = 2
    before = held()
    collector = Collector()
    with Source(URI, collector.take, on_state=collector.state) as source:
        assert collector.wait_for_samples(9)
    assert source.counters["lost_links"] == 2
    assert settle(before) == before


def test_a_dot_out_of_range_is_waited_for_and_the_reason_said(radio):
    radio.refuse = 3
    collector = Collector()
    with Source(URI, collector.take, on_state=collector.state) as source:
        assert collector.wait_for_samples(3)
    assert source.counters["not_opened"] == 3
    assert (State.WAITING, "RuntimeError: not in range") in collector.states


def test_without_bleak_the_source_says_how_to_get_it(monkeypatch):
    monkeypatch.setattr("dualfoot_ros.drivers.transports.ble.util.find_spec", lambda name: None)
    with pytest.raises(SourceError, match=r"pip install 'dualfoot_ros\[ble\]'"):
        make_transport(parse_uri(URI))
