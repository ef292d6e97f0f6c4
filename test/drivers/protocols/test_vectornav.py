"""The VectorNav decoder against the maker's example and messages written from its tables."""

import math
import struct

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import Increments
from dualfoot_ros.drivers.protocols.vectornav import VectorNavConfig, VectorNavDecoder, probe

from ..frames import vectornav_message

# UM001, binary output, example case 1: yaw, pitch and roll only.
MANUAL = bytes.fromhex("FA 01 0800 93502E42 833EF13F 48B504BB 9288")
UNCOMPENSATED = (1.0, 2.0, 3.0), (4.0, 5.0, 6.0)
COMPENSATED = (7.0, 8.0, 9.0), (10.0, 11.0, 12.0)


def vectors(*pairs):
    return b"".join(struct.pack("<3f", *vector) for pair in pairs for vector in pair)


def decode_one(message, options=None):
    (sample,) = VectorNavDecoder(options).feed(message, 5)
    return sample


def test_the_example_of_the_manual_has_a_valid_checksum_and_the_right_length():
    assert probe(bytearray(MANUAL), 0) == len(MANUAL) == 18


def test_a_message_without_motion_is_counted_and_left_alone():
    decoder = VectorNavDecoder()
    assert decoder.feed(MANUAL, 5) == []
    assert decoder.counters["incomplete"] == 1


def test_the_imu_field_of_the_common_group_is_acceleration_then_rate():
    content = struct.pack("<Q", 123_456_789_000) + vectors(UNCOMPENSATED)
    sample = decode_one(vectornav_message(1, [1 << 0 | 1 << 9], content))
    assert (sample.specific_force, sample.angular_rate) == UNCOMPENSATED
    assert (sample.ticks, sample.tick_ns, sample.tick_bits) == (123_456_789_000, 1, 64)


def held_push(rotation, force, interval_s, parts=2000):
    """Return the push (3,) in the axes at the start of a force that is constant in the body."""
    shares = (np.arange(parts) + 0.5) / parts
    turned = Rotation.from_rotvec(np.outer(shares, rotation)).apply(force)
    return turned.mean(axis=0) * interval_s


@pytest.mark.parametrize("group", ["common", "imu"])
def test_increments_become_the_rate_and_force_that_hold_over_their_interval(group):
    rotation, force, interval_s = np.array([0.06, -0.15, 0.02]), np.array([3.0, -1.0, 12.0]), 0.02
    push = held_push(rotation, force, interval_s)
    theta = struct.pack("<4f", interval_s, *np.degrees(rotation))
    content = theta + struct.pack("<3f", *push)
    masks = (1, [1 << 11]) if group == "common" else (4, [1 << 6 | 1 << 7])
    sample = decode_one(vectornav_message(*masks, content))
    assert sample.angular_rate == pytest.approx(rotation / interval_s, rel=1e-5)
    assert sample.specific_force == pytest.approx(force, rel=1e-5)
    assert sample.increments is Increments.COMPENSATED


def test_increments_are_preferred_to_rates_which_are_sampled():
    rates = vectors(UNCOMPENSATED)
    increments = struct.pack("<7f", 0.01, 0.0, 0.0, 1.0, 0.0, 0.0, 0.1)
    both = decode_one(vectornav_message(1, [1 << 9 | 1 << 11], rates + increments))
    assert both.specific_force == pytest.approx((0.0, 0.0, 10.0))
    alone = decode_one(vectornav_message(1, [1 << 9], rates))
    assert alone.increments is Increments.SAMPLED


@pytest.mark.parametrize("interval_s", [0.0, -0.01, math.nan, 5.0])
def test_increments_of_an_impossible_interval_are_left_for_the_rates(interval_s):
    content = vectors(UNCOMPENSATED) + struct.pack("<7f", interval_s, *[1.0] * 6)
    sample = decode_one(vectornav_message(1, [1 << 9 | 1 << 11], content))
    assert (sample.specific_force, sample.angular_rate) == UNCOMPENSATED


def test_fields_stand_in_the_order_of_groups_and_bits():
    content = (
        struct.pack("<Q", 77)  # time group: startup
        + struct.pack("<3f", 1.0, 0.0, -0.5)  # IMU group: magnetic field, gauss
        + vectors(UNCOMPENSATED)
        + struct.pack("<2f", 21.5, 101.0)  # temperature, pressure
        + bytes(12)  # attitude group: yaw, pitch, roll
    )
    masks = [1 << 0, 1 << 1 | 1 << 2 | 1 << 3 | 1 << 4 | 1 << 5, 1 << 1]
    sample = decode_one(vectornav_message(0b10110, masks, content))
    assert (sample.specific_force, sample.angular_rate) == UNCOMPENSATED
    assert sample.ticks == 77
    assert sample.temperature == 21.5
    assert sample.magnetic_field == pytest.approx((1e-4, 0.0, -5e-5))


@pytest.mark.parametrize(
    ("prefer", "expected"), [("uncompensated", UNCOMPENSATED), ("compensated", COMPENSATED)]
)
def test_the_preferred_kind_is_used_when_both_are_sent(prefer, expected):
    content = vectors(UNCOMPENSATED, COMPENSATED)
    message = vectornav_message(0b100, [1 << 2 | 1 << 3 | 1 << 9 | 1 << 10], content)
    sample = decode_one(message, VectorNavConfig(prefer=prefer))
    assert (sample.specific_force, sample.angular_rate) == expected


def test_the_other_kind_is_used_when_only_it_is_sent():
    rate, force = COMPENSATED[1], COMPENSATED[0]
    content = struct.pack("<6f", *rate, *force)  # angular rate is bit 5, acceleration bit 8
    sample = decode_one(vectornav_message(1, [1 << 5 | 1 << 8], content))
    assert (sample.specific_force, sample.angular_rate) == COMPENSATED


def test_text_messages_between_binary_ones_are_stepped_over():
    message = vectornav_message(1, [1 << 9], vectors(UNCOMPENSATED))
    data = b"$VNYMR,+100.0,+001.0*6A\r\n" + message + b"$VNERR,03*72\r\n" + message
    assert len(VectorNavDecoder().feed(data, 5)) == 2


@pytest.mark.parametrize("mask", [0, 1 << 15, 1 << 13 | 1 << 9])
def test_a_message_with_fields_of_unknown_size_is_skipped(mask):
    message = vectornav_message(0b100, [mask], bytes(60))
    assert VectorNavDecoder().feed(message, 5) == []
