"""What holds for each decoder, whatever its format."""

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.drivers.protocols.registry import FORMATS as KNOWN
from dualfoot_ros.drivers.protocols.registry import make_decoder

from ..frames import (
    FORMATS,
    PERIOD_US,
    TIMED,
    decoder_format,
    frame,
    preamble,
    stream,
    truth,
)

TOLERANCE = {"mcu": 1e-6, "ximu3_ascii": 2e-4}
CHECKSUMMED = ("mcu", "witmotion", "xbus", "vectornav")
formats = pytest.mark.parametrize("name", FORMATS)


def decode(name, *chunks):
    decoder = make_decoder(decoder_format(name))
    samples = [sample for data in chunks for sample in decoder.feed(data, 7)]
    return samples, decoder


def index_of(sample):
    """Which sample of the made-up walk this is, by its own clock."""
    ticks = sample.ticks if sample.tick_ns != 1_000_000 else sample.ticks % 86_400_000
    return ticks * sample.tick_ns // (PERIOD_US * 1000)


def assert_is_sample(name, sample, k):
    force, rate = truth(k)
    tolerance = TOLERANCE.get(name, 1e-5)
    assert sample.specific_force == pytest.approx(force, rel=tolerance, abs=6e-4)
    assert sample.angular_rate == pytest.approx(rate, rel=tolerance, abs=1e-5)
    assert sample.arrival_ns == 7


@formats
def test_what_the_device_measured_comes_out_in_si_units(name):
    samples, decoder = decode(name, stream(name, 40))
    assert len(samples) == 40
    for k, sample in enumerate(samples):
        assert_is_sample(name, sample, k)
    assert decoder.counters["samples"] == 40
    assert not decoder.counters["garbage_bytes"]


KINDS = {
    "mcu": None,  # the frames of these tests do not say
    "ximu3": "averaged",  # at 200 Hz
    "ximu3_ascii": "averaged",
    "witmotion": "sampled",
    "xbus": "compensated",
    "vectornav": "sampled",
    "vectornav_ascii": "sampled",
    "dot_csv": "compensated",
}


@formats
def test_samples_say_what_they_are_where_the_maker_does(name):
    samples, _ = decode(name, stream(name, 40))
    assert samples[-1].increments == KINDS[name]
    assert {sample.increments for sample in samples} <= {None, KINDS[name]}


@pytest.mark.parametrize("name", TIMED)
def test_device_time_advances_by_the_sampling_period(name):
    samples, _ = decode(name, stream(name, 40))
    steps = {(b.ticks - a.ticks) * b.tick_ns for a, b in itertools.pairwise(samples)}
    assert steps == {PERIOD_US * 1000}


@formats
def test_a_stream_cut_in_two_at_any_byte_gives_the_same_samples(name):
    data = stream(name, 6)
    whole, _ = decode(name, data)
    for at in range(len(data) + 1):
        assert decode(name, data[:at], data[at:])[0] == whole


@formats
def test_a_stream_that_comes_byte_by_byte_gives_the_same_samples(name):
    data = stream(name, 6)
    samples, _ = decode(name, *(data[k : k + 1] for k in range(len(data))))
    assert samples == decode(name, data)[0]


@formats
@settings(max_examples=60, deadline=None)
@given(st.binary(max_size=300), st.data())
def test_after_any_garbage_the_second_valid_frame_comes_out(name, garbage, data):
    before = data.draw(st.integers(0, 3))
    decoder = make_decoder(decoder_format(name))
    decoder.feed(stream(name, before) + garbage, 0)
    samples = decoder.feed(frame(name, 10) + frame(name, 11), 7)
    assert samples
    assert_is_sample(name, samples[-1], 11)


@formats
@pytest.mark.parametrize(
    "header", [b"\xfa\xff\x36\xfe", b"\xfa\x01\xff\x7f", b"\x55\x51", b"\x55"]
)
def test_a_faked_header_that_announces_a_long_frame_does_not_swallow_the_next_two(name, header):
    decoder = make_decoder(decoder_format(name))
    decoder.feed(stream(name, 3), 0)
    samples = decoder.feed(header + frame(name, 10) + frame(name, 11), 7)
    assert_is_sample(name, samples[-1], 11)


@pytest.mark.parametrize("name", CHECKSUMMED)
def test_one_damaged_byte_costs_at_most_two_samples_and_brings_none_that_is_not_there(name):
    start, body, end = stream(name, 4), frame(name, 4), stream(name, 6, first=5)
    for at in range(len(body)):
        damaged = body[:at] + bytes([body[at] ^ 0x40]) + body[at + 1 :]
        samples, _ = decode(name, start + damaged + end)
        assert len(samples) >= 8, f"byte {at}"
        for sample in (sample for sample in samples if sample.ticks is not None):
            assert sample.specific_force == pytest.approx(truth(index_of(sample))[0], abs=1e-3)


@formats
def test_a_missing_byte_costs_at_most_two_samples(name):
    start, body, end = stream(name, 4), frame(name, 4), stream(name, 6, first=5)
    for at in range(len(body)):
        samples, _ = decode(name, start + body[:at] + body[at + 1 :] + end)
        assert len(samples) >= 8, f"byte {at}"


@formats
@settings(max_examples=80, deadline=None)
@given(st.lists(st.binary(max_size=200), max_size=8))
def test_arbitrary_bytes_raise_nothing_and_give_only_finite_samples(name, chunks):
    samples, decoder = decode(name, preamble(name), *chunks)
    for sample in samples:
        assert all(map(math.isfinite, (*sample.specific_force, *sample.angular_rate)))
        assert sample.ticks is None or 0 <= sample.ticks < 1 << sample.tick_bits
    assert decoder.counters["bytes"] == len(preamble(name)) + sum(map(len, chunks))
    assert decoder.buffered <= decoder.max_buffer


@formats
@pytest.mark.parametrize("byte", [b"\xfa", b"\x55", b"\x01", b"I", b"\xff"])
def test_an_endless_run_of_one_byte_fills_no_memory(name, byte):
    decoder = make_decoder(decoder_format(name))
    for _ in range(20):
        decoder.feed(byte * 1000, 0)
        assert decoder.buffered <= decoder.max_buffer


@formats
def test_a_lost_link_forgets_the_half_frame_and_only_that(name):
    decoder = make_decoder(decoder_format(name))
    decoder.feed(stream(name, 3) + frame(name, 3)[:-2], 0)
    decoder.reset()
    assert decoder.buffered == 0
    samples = decoder.feed(stream(name, 3, first=20), 7)
    assert len(samples) == 3
    assert_is_sample(name, samples[0], 20)
    assert not decoder.counters["lost"]


@pytest.mark.parametrize("name", ["mcu", "xbus", "dot_csv"])
def test_the_packet_counter_tells_how_many_samples_are_missing(name):
    data = preamble(name) + b"".join(frame(name, k) for k in (0, 1, 2, 6, 7, 7, 8))
    _, decoder = decode(name, data)
    assert decoder.counters["lost"] == 3
    assert decoder.counters["repeated"] == 1


def test_every_format_is_covered_by_these_tests():
    assert {decoder_format(name) for name in FORMATS} | {"dot"} == set(KNOWN)
