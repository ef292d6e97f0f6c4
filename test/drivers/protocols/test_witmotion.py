"""The WitMotion decoder against frames worked out by hand from the maker's formulas."""

import datetime
import math

import pytest

from dualfoot_ros.drivers.protocols.witmotion import WitMotionConfig, WitMotionDecoder

from ..frames import truth, wit, witmotion, witmotion_combined

# 0x55 0x51, x 0, y 0, z 2048 (1 g of 16), temperature 2550; sum 0x55+0x51+0x08+0xF6+0x09 = 0x1AD.
ACCELERATION = bytes.fromhex("55 51 0000 0000 0008 F609 AD")
# 0x55 0x52, x 16384 (1000 deg/s of 2000), y 0, z -16384; sum 0x55+0x52+0x40+0xC0 = 0x1A7.
RATE = bytes.fromhex("55 52 0040 0000 00C0 0000 A7")
# 2026-11-22 05:14:27.250; sum 0x55+0x50+26+11+22+5+14+27+0xFA = 0x208.
TIME = bytes.fromhex("55 50 1A 0B 16 05 0E 1B FA00 08")


def test_a_sample_is_an_acceleration_frame_and_the_rate_frame_behind_it():
    (sample,) = WitMotionDecoder().feed(TIME + ACCELERATION + RATE, 5)
    assert sample.specific_force == pytest.approx((0.0, 0.0, 9.80665))
    assert sample.angular_rate == pytest.approx((math.radians(1000), 0.0, -math.radians(1000)))
    assert sample.temperature == 25.5


def test_the_devices_date_becomes_milliseconds_since_2000():
    (sample,) = WitMotionDecoder().feed(TIME + ACCELERATION + RATE, 5)
    since = datetime.datetime(2026, 11, 22, 5, 14, 27, 250_000) - datetime.datetime(2000, 1, 1)
    assert sample.ticks == since // datetime.timedelta(milliseconds=1)
    assert sample.tick_ns == 1_000_000


def test_without_time_frames_there_is_no_device_time():
    (sample,) = WitMotionDecoder().feed(ACCELERATION + RATE, 5)
    assert sample.ticks is None


def test_a_date_that_does_not_exist_is_counted_and_gives_no_time():
    decoder = WitMotionDecoder()
    (sample,) = decoder.feed(wit(0x50, bytes(8)) + ACCELERATION + RATE, 5)
    assert sample.ticks is None
    assert decoder.counters["malformed"] == 1


def test_the_ranges_the_device_is_set_to_scale_its_values():
    decoder = WitMotionDecoder(WitMotionConfig(force_range=4.0, rate_range=500.0))
    (sample,) = decoder.feed(ACCELERATION + RATE, 5)
    assert sample.specific_force[2] == pytest.approx(9.80665 / 4)
    assert sample.angular_rate[0] == pytest.approx(math.radians(250))


def test_halves_of_different_samples_are_not_joined_over_a_gap():
    first, second = witmotion(1), witmotion(2)
    hole = first[:-11] + first[-11:-4] + second[20:]  # the rate of 1 and the force of 2 are cut
    decoder = WitMotionDecoder()
    samples = decoder.feed(witmotion(0) + hole + witmotion(3) + witmotion(4), 5)
    alone = [WitMotionDecoder().feed(witmotion(k), 5)[0] for k in (0, 3, 4)]
    assert [s[1:3] for s in samples] == [s[1:3] for s in alone]


def test_a_header_inside_a_payload_is_not_taken_for_a_frame():
    inner = bytes.fromhex("55 51 55 51 55 51 55 51")
    decoder = WitMotionDecoder()
    samples = decoder.feed((wit(0x51, inner) + RATE) * 20, 5)
    assert len(samples) == 20
    assert len({s.specific_force for s in samples}) == 1
    assert not decoder.counters["garbage_bytes"]


def test_a_stream_that_starts_inside_a_frame_full_of_headers_finds_the_right_step():
    inner = bytes.fromhex("55 51 55 51 55 51 55 51")
    data = (wit(0x51, inner) + RATE) * 20
    for start in range(22):
        samples = WitMotionDecoder().feed(data[start:], 5)
        assert len(samples) >= 18
        assert len({s.specific_force for s in samples}) == 1


def test_the_magnetic_field_comes_when_its_unit_is_given():
    decoder = WitMotionDecoder(WitMotionConfig(field_unit=1e-8))
    field = wit(0x54, (1000).to_bytes(2, "little") + bytes(6))
    (sample,) = decoder.feed(field + ACCELERATION + RATE, 5)
    assert sample.magnetic_field == pytest.approx((1e-5, 0.0, 0.0))


def test_a_frame_of_a_bluetooth_model_is_a_whole_sample():
    frames = b"".join(witmotion_combined(k) for k in range(500))
    decoder = WitMotionDecoder()
    samples = decoder.feed(frames, 5)
    assert len(samples) == 500
    for k, sample in enumerate(samples):
        force, rate = truth(k)
        assert sample.specific_force == pytest.approx(force, abs=3e-3)
        assert sample.angular_rate == pytest.approx(rate, abs=6e-4)
        assert sample.ticks is None
    assert not decoder.counters["garbage_bytes"]


def test_such_frames_come_at_once_one_by_one_as_notifications_do():
    decoder = WitMotionDecoder()
    counts = [len(decoder.feed(witmotion_combined(k), 5)) for k in range(6)]
    assert counts[1:] == [2, 1, 1, 1, 1]  # the first waits until a second confirms it


@pytest.mark.parametrize("lost", range(1, 20))
def test_missing_bytes_cost_two_such_samples_and_the_others_are_right(lost):
    frames = [witmotion_combined(k) for k in range(12)]
    frames[4] = frames[4][:-lost]
    samples = WitMotionDecoder().feed(b"".join(frames), 5)
    right = [truth(k)[0] for k in range(12)]
    found = [
        s for s in samples if any(s.specific_force == pytest.approx(f, abs=3e-3) for f in right)
    ]
    assert len(found) >= 10
    assert len(found) == len(samples)


def test_answers_about_registers_are_stepped_over():
    answer = b"\x55\x71\x3a\x00" + bytes(16)
    decoder = WitMotionDecoder()
    samples = decoder.feed(b"".join(witmotion_combined(k) + answer for k in range(5)), 5)
    assert len(samples) == 5
    assert decoder.counters["other"] == 5
