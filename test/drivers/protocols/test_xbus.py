"""The Xbus decoder against messages worked out by hand from the maker's document."""

import struct

import pytest

from dualfoot_ros.drivers.protocols.xbus import XbusConfig, XbusDecoder

from ..frames import item, xbus, xbus_message

# FA FF 36 2A: packet counter 1, sample time 10 000, acceleration (0, 0, 1), rate (0.5, 0, 0).
# FF, 36, 2A and the items sum to 0x453, so the checksum is 0xAD.
BY_HAND = bytes.fromhex(
    "FA FF 36 2A 1020 02 0001 1060 04 00002710 4020 0C 00000000 00000000 3F800000"
    "8020 0C 3F000000 00000000 00000000 AD"
)
MOTION = item(0x4020, struct.pack(">3f", 1, 2, 3)) + item(0x8020, struct.pack(">3f", 4, 5, 6))


def decode_one(*parts, options=None):
    samples = XbusDecoder(options).feed(xbus_message(0x36, b"".join(parts)) * 2, 5)
    assert len(samples) == 2
    return samples[0]


def test_a_message_written_by_hand_is_decoded():
    sample = XbusDecoder().feed(BY_HAND * 2, 5)[0]
    assert sample.specific_force == (0.0, 0.0, 1.0)
    assert sample.angular_rate == (0.5, 0.0, 0.0)
    assert (sample.counter, sample.ticks) == (1, 10_000)
    assert (sample.tick_ns, sample.tick_bits) == (100_000, 32)


@pytest.mark.parametrize(
    ("precision", "write"),
    [
        (0, lambda v: struct.pack(">f", v)),
        (1, lambda v: struct.pack(">i", round(v * 2**20))),
        (2, lambda v: struct.pack(">Ih", round(v * 2**32) % 2**32, round(v * 2**32) >> 32)),
        (3, lambda v: struct.pack(">d", v)),
    ],
)
def test_every_way_to_write_a_number_is_read(precision, write):
    force, rate = (-9.75, 0.125, 19.5), (-0.5, 0.25, -2.0)
    sample = decode_one(
        item(0x4020 | precision, b"".join(map(write, force))),
        item(0x8020 | precision, b"".join(map(write, rate))),
    )
    assert sample.specific_force == force
    assert sample.angular_rate == rate


def test_free_acceleration_is_not_taken_for_specific_force():
    decoder = XbusDecoder()
    content = item(0x4030, struct.pack(">3f", 1, 2, 3)) + item(0x8020, bytes(12))
    assert decoder.feed(xbus_message(0x36, content) * 2, 5) == []
    assert decoder.counters["incomplete"] == 2


def test_the_high_rate_items_are_taken_where_the_others_are_absent():
    sample = decode_one(
        item(0x4040, struct.pack(">3f", 1, 2, 3)), item(0x8040, struct.pack(">3f", 4, 5, 6))
    )
    assert sample.specific_force == (1.0, 2.0, 3.0)


def test_temperature_and_field_come_along():
    sample = decode_one(
        MOTION,
        item(0x0810, struct.pack(">f", 31.5)),
        item(0xC020, struct.pack(">3f", 1, 0, -0.5)),
        options=XbusConfig(field_unit=5e-5),
    )
    assert sample.temperature == 31.5
    assert sample.magnetic_field == pytest.approx((5e-5, 0.0, -2.5e-5))


def test_unknown_items_are_stepped_over():
    sample = decode_one(item(0xE020, bytes(4)), MOTION, item(0x2010, bytes(16)))
    assert sample.specific_force == (1.0, 2.0, 3.0)


def test_a_message_of_extended_length_is_read():
    sample = decode_one(item(0x1010, bytes(200)), item(0x5040, bytes(120)), MOTION)
    assert sample.angular_rate == (4.0, 5.0, 6.0)


def test_answers_to_commands_are_counted_and_left_alone():
    decoder = XbusDecoder()
    data = xbus_message(0x31, b"") + xbus(1) + xbus_message(0x11, b"") + xbus(2)
    assert len(decoder.feed(data, 5)) == 2
    assert decoder.counters["other"] == 2


def test_items_that_overrun_the_message_are_no_message():
    content = item(0x4020, struct.pack(">3f", 1, 2, 3)) + b"\x80\x20\xff"
    assert XbusDecoder().feed(xbus_message(0x36, content) * 3, 5) == []
