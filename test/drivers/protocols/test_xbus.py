"""The Xbus decoder against messages worked out by hand from the maker's document."""

import math
import struct

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import Increments
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


def increments(k, rotation, push, *, interval_ms=10, precision=0, rates=b""):
    """Return message ``k`` with DeltaQ and DeltaV of the rotation (rad) and push (m/s)."""
    x, y, z, w = Rotation.from_rotvec(rotation).as_quat()
    return xbus_message(
        0x36,
        item(0x1060, struct.pack(">I", k * interval_ms * 10))
        + item(0x4010 | precision, struct.pack(">3d" if precision else ">3f", *push))
        + item(0x8030 | precision, struct.pack(">4d" if precision else ">4f", w, x, y, z))
        + rates,
    )


@pytest.mark.parametrize("precision", [0, 3])
def test_increments_become_the_rate_and_force_of_their_interval(precision):
    rotation, push = (0.05, -0.12, 0.03), (0.02, -0.01, 0.1)
    data = b"".join(increments(k, rotation, push, precision=precision) for k in range(4))
    decoder = XbusDecoder()
    samples = decoder.feed(data, 5)
    assert len(samples) == 3  # without an interval the first tells no rate
    assert decoder.counters["incomplete"] == 1
    for sample in samples:
        assert sample.angular_rate == pytest.approx(np.array(rotation) / 0.01, rel=1e-5)
        assert sample.specific_force == pytest.approx(np.array(push) / 0.01, rel=1e-5)
        assert sample.increments is Increments.COMPENSATED


def test_increments_are_preferred_to_rates_once_their_interval_is_known():
    data = b"".join(increments(k, (0.1, 0, 0), (0, 0, 0.1), rates=MOTION) for k in range(3))
    first, *others = XbusDecoder().feed(data, 5)
    assert first.angular_rate == (4.0, 5.0, 6.0)
    assert first.increments is Increments.COMPENSATED
    assert [o.angular_rate for o in others] == [pytest.approx((10.0, 0.0, 0.0))] * 2


def test_a_lost_message_does_not_make_the_next_rate_smaller():
    data = b"".join(increments(k, (0.1, 0, 0), (0, 0, 0.1)) for k in (0, 1, 2, 5, 6))
    assert {round(s.angular_rate[0], 4) for s in XbusDecoder().feed(data, 5)} == {10.0}


def test_a_quaternion_and_its_negative_are_one_rotation():
    turned = [increments(k, (0.0, 0.2, 0.0), (0.0, 0.0, 0.1)) for k in range(2)]
    negative = xbus_message(
        0x36,
        item(0x1060, struct.pack(">I", 200))
        + item(0x4010, struct.pack(">3f", 0.0, 0.0, 0.1))
        + item(0x8030, struct.pack(">4f", -math.cos(0.1), 0.0, -math.sin(0.1), 0.0)),
    )
    one, other = XbusDecoder().feed(b"".join(turned) + negative, 5)
    assert other.angular_rate == pytest.approx(one.angular_rate)


@pytest.mark.parametrize(
    ("force", "rate", "kind"),
    [
        (0x4020, 0x8020, Increments.COMPENSATED),
        (0x4040, 0x8040, Increments.SAMPLED),
        (0x4020, 0x8040, None),
    ],
)
def test_calibrated_items_are_compensated_and_high_rate_ones_sampled(force, rate, kind):
    three = struct.pack(">3f", 1, 2, 3)
    assert decode_one(item(force, three), item(rate, three)).increments is kind


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
