"""The Xbus decoder against messages worked out by hand from the maker's document."""

import math
import struct

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import Increments
from dualfoot_ros.drivers.protocols.xbus import XbusConfig, XbusDecoder

from ..frames import item, truth, xbus, xbus_message

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


def apart(key, ticks, vector, counter=0):
    """Return a message with one half of a sample."""
    return xbus_message(
        0x36,
        item(0x1020, struct.pack(">H", counter))
        + item(0x1060, struct.pack(">I", ticks % 2**32))
        + item(key, struct.pack(">3f", *vector)),
    )


@pytest.mark.parametrize("start", [0, 2**32 - 250])
def test_halves_in_messages_apart_become_samples_at_the_stamps_of_the_rate_of_turn(start):
    decoder, messages = XbusDecoder(), []
    for k in range(50):  # the force grows by one in every 100 ticks
        messages.append(apart(0x4040, start + 100 * k, (k, 2 * k, 9.8)))
        messages += [apart(0x8040, start + 100 * k + d, (0.1, 0.2, d)) for d in (20, 60)]
    samples = decoder.feed(b"".join(messages), 5)
    assert len(samples) == 2 * 49
    for n, sample in enumerate(samples):
        ticks = 100 * (n // 2) + (20, 60)[n % 2]
        assert sample.ticks == (start + ticks) % 2**32
        assert sample.specific_force == pytest.approx((ticks / 100, ticks / 50, 9.8), abs=1e-5)
        assert sample.angular_rate[2] == (20, 60)[n % 2]
        assert sample.increments is Increments.SAMPLED
    assert not decoder.counters["incomplete"]


def test_a_calibrated_rate_beside_an_interpolated_force_is_of_no_kind():
    data = b"".join(
        apart(key, 100 * k + d, (1, 2, 3))
        for k in range(9)
        for key, d in ((0x4020, 0), (0x8020, 5))
    )
    assert {s.increments for s in XbusDecoder().feed(data, 5)} == {None}


def test_messages_apart_between_increments_do_not_shorten_their_interval():
    messages = []
    for k in range(6):
        messages.append(increments(k, (0.1, 0, 0), (0, 0, 0.1)))
        messages.append(apart(0x8040, 100 * k + 50, (9, 9, 9)))
    samples = XbusDecoder().feed(b"".join(messages), 5)
    assert {round(s.angular_rate[0], 4) for s in samples} == {10.0}


def test_nothing_is_interpolated_where_accelerations_are_missing():
    near = [apart(0x4040, 0, (1, 1, 1)), apart(0x8040, 50, (1, 1, 1))]
    far = [apart(0x4040, 5000, (2, 2, 2)), apart(0x8040, 5050, (1, 1, 1))]
    decoder = XbusDecoder()
    samples = decoder.feed(b"".join([*near, *far, apart(0x4040, 5100, (3, 3, 3))]), 5)
    assert [sample.ticks for sample in samples] == [5050]
    assert decoder.counters["incomplete"] == 1


def test_a_device_that_sends_one_half_only_gives_nothing_and_says_incomplete():
    for key in (0x4040, 0x8040):
        decoder = XbusDecoder()
        assert decoder.feed(b"".join(apart(key, 100 * k, (1, 2, 3)) for k in range(9)), 5) == []
        assert decoder.counters["incomplete"] >= 7


def on_bus(identifier, mid, content):
    body = bytes([identifier, mid, len(content)]) + content
    return b"\xfa" + body + bytes([-sum(body) % 256])


def test_devices_on_one_bus_are_told_apart_and_one_is_chosen_by_its_identifier():
    data = b"".join(
        on_bus(
            device,
            0x36,
            item(0x4020, struct.pack(">3f", device, 0, 9.8)) + item(0x8020, bytes(12)),
        )
        for _ in range(5)
        for device in (1, 2, 3)
    )
    for options, expected in ((None, 1), (XbusConfig(bus_id=2), 2), (XbusConfig(bus_id=3), 3)):
        decoder = XbusDecoder(options)
        samples = decoder.feed(data, 5)
        assert [sample.specific_force[0] for sample in samples] == [expected] * 5
        assert dict(decoder.devices) == {1: 5, 2: 5, 3: 5}


@pytest.mark.parametrize("orientation", [0, 12, 16, 36])
@pytest.mark.parametrize("temperature", [False, True])
@pytest.mark.parametrize("counter", [False, True])
def test_calibrated_data_of_older_devices_are_read(orientation, temperature, counter):
    decoder = XbusDecoder(XbusConfig(mtdata_temperature=temperature))
    data = b""
    for k in range(20):
        force, rate = truth(k)
        content = struct.pack(">f", 30.5) if temperature else b""
        content += struct.pack(">9f", *force, *rate, 0.5, 0, 0) + bytes(orientation)
        data += xbus_message(0x32, content + (struct.pack(">H", k) if counter else b""))
    samples = decoder.feed(data, 5)
    assert len(samples) == 20
    for k, sample in enumerate(samples):
        assert sample.specific_force == pytest.approx(truth(k)[0], rel=1e-6, abs=1e-6)
        assert sample.angular_rate == pytest.approx(truth(k)[1], rel=1e-6, abs=1e-6)
        assert sample.temperature == (30.5 if temperature else None)
        assert sample.counter == (k if counter else None)
        assert sample.ticks is None


def test_older_messages_without_calibrated_data_are_incomplete():
    decoder = XbusDecoder()
    assert decoder.feed(xbus_message(0x32, bytes(16)) * 4, 5) == []
    assert decoder.counters["incomplete"] >= 3
