"""The x-IMU3 decoder against the examples of the maker's manual and the maker's own library."""

import math
import socket
import struct
import time

import pytest
from processes import PATIENCE_S

from dualfoot_ros.core import Increments
from dualfoot_ros.drivers.protocols.ximu3 import XImu3Config, XImu3Decoder

from ..frames import truth, ximu3, ximu3_ascii

# User manual, inertial message: one second, 1 g on z.
MANUAL_BINARY = bytes.fromhex("C9 40420F0000000000" + "00000000" * 5 + "0000803F 0A")
MANUAL_ASCII = b"I,1000000,0.0000,0.0000,0.0000,0.0000,0.0000,1.0000\n"


@pytest.mark.parametrize("message", [MANUAL_BINARY, MANUAL_ASCII, MANUAL_ASCII[:-1] + b"\r\n"])
def test_the_examples_of_the_manual_are_decoded(message):
    (sample,) = XImu3Decoder().feed(message, 5)
    assert (sample.ticks, sample.tick_ns, sample.tick_bits) == (1_000_000, 1000, 64)
    assert sample.specific_force == (0.0, 0.0, 9.80665)
    assert sample.angular_rate == (0.0, 0.0, 0.0)


def test_degrees_a_second_become_radians():
    (sample,) = XImu3Decoder().feed(b"I,1,90.0,-180.0,360.0,0,0,1\n", 5)
    assert sample.angular_rate == pytest.approx((math.pi / 2, -math.pi, 2 * math.pi))


@pytest.mark.parametrize(
    ("interval_us", "kind"), [(2500, Increments.SAMPLED), (5000, Increments.AVERAGED)]
)
def test_messages_slower_than_the_device_samples_are_means(interval_us, kind):
    decoder = XImu3Decoder()
    lost = (3, 7, 8)
    lines = [f"I,{k * interval_us},0,0,0,0,0,1\n" for k in range(24) if k not in lost]
    samples = decoder.feed("".join(lines).encode(), 5)
    assert [sample.increments for sample in samples] == [None] * 8 + [kind] * 13
    decoder.reset()
    (again,) = decoder.feed(b"I,0,0,0,0,0,0,1\n", 5)
    assert again.increments is None


def test_a_line_feed_and_an_escape_inside_a_message_are_unstuffed():
    stamp = 0x0A_DB_0A_DB
    plain = struct.pack("<BQ6f", 0xC9, stamp, *[0.0] * 5, 1.0)
    body = plain.replace(b"\xdb", b"\xdb\xdd").replace(b"\n", b"\xdb\xdc")
    (sample,) = XImu3Decoder().feed(body + b"\n", 5)
    assert sample.ticks == stamp


@pytest.mark.parametrize(
    "message",
    [
        b"I,1,0,0,0,0,0\n",
        b"I,1,0,0,0,0,0,1,2\n",
        b"I,-1,0,0,0,0,0,1\n",
        b"I,99999999999999999999,0,0,0,0,0,1\n",
        b"I,1,0,0,0,0,1_0,1\n",
        b"I,1,0,0,0,0,,1\n",
        b"I\n",
        b"\xc9\xdb\x00" + bytes(30) + b"\n",
        b"\xc9" + bytes(31) + b"\n",
    ],
)
def test_a_message_that_does_not_fit_is_counted_and_dropped(message):
    decoder = XImu3Decoder()
    assert decoder.feed(message, 5) == []
    assert decoder.counters["malformed"] == 1


@pytest.mark.parametrize("value", [b"nan", b"inf", b"-inf"])
def test_a_value_that_is_no_number_is_refused(value):
    decoder = XImu3Decoder()
    assert decoder.feed(b"I,1,0,0,0,0,0," + value + b"\n", 5) == []
    assert decoder.counters["not_finite"] == 1


def test_temperature_and_field_of_other_messages_go_with_the_next_sample():
    decoder = XImu3Decoder(XImu3Config(field_unit=5e-5))
    data = b"T,1,25.5\nM,1,1.0,0.0,-0.5\n" + MANUAL_ASCII
    (sample,) = decoder.feed(data, 5)
    assert sample.temperature == 25.5
    assert sample.magnetic_field == pytest.approx((5e-5, 0.0, -2.5e-5))


def test_the_field_is_left_out_unless_its_unit_is_given():
    (sample,) = XImu3Decoder().feed(b"M,1,1.0,0.0,-0.5\n" + MANUAL_ASCII, 5)
    assert sample.magnetic_field is None


def test_other_messages_of_the_device_are_counted_and_left_alone():
    decoder = XImu3Decoder()
    data = b'{"ping":null}\nQ,1,1,0,0,0\nB,1,50,4,0\nN,1,note\n' + MANUAL_ASCII
    assert len(decoder.feed(data, 5)) == 1
    assert decoder.counters["other"] == 4
    assert not decoder.counters["malformed"]


def _free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.mark.parametrize("encode", [ximu3, ximu3_ascii])
def test_the_makers_own_library_reads_the_same_from_the_same_bytes(encode):
    ximu3_library = pytest.importorskip(
        "ximu3", reason="the maker's library (pip install ximu3) is not installed"
    )
    port = _free_port()
    config = ximu3_library.UdpConnectionConfig("127.0.0.1", 9, port)
    connection = ximu3_library.Connection(config)
    theirs = []
    connection.add_inertial_callback(theirs.append)
    connection.open()
    messages = [encode(k) for k in range(50)]
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for message in messages:
            sender.sendto(message, ("127.0.0.1", port))
    deadline = time.monotonic() + PATIENCE_S
    while len(theirs) < len(messages) and time.monotonic() < deadline:
        time.sleep(0.01)
    connection.close()
    ours = XImu3Decoder().feed(b"".join(messages), 5)
    assert len(theirs) == len(ours) == len(messages)
    for k, (their, our) in enumerate(zip(theirs, ours, strict=True)):
        assert their.timestamp == our.ticks
        force = (their.accelerometer_x, their.accelerometer_y, their.accelerometer_z)
        assert our.specific_force == pytest.approx([9.80665 * v for v in force], abs=1e-5)
        rate = (their.gyroscope_x, their.gyroscope_y, their.gyroscope_z)
        assert our.angular_rate == pytest.approx([math.radians(v) for v in rate], abs=1e-6)
        assert our.specific_force == pytest.approx(truth(k)[0], abs=1e-3)
