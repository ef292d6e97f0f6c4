"""The frame for boards of one's own, against bytes made by hand and the reference encoder in C."""

import ctypes
import shutil
import struct
import subprocess
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.drivers.protocols import cobs
from dualfoot_ros.drivers.protocols.mcu import McuDecoder

from ..frames import cobs as stuff
from ..frames import crc16, mcu, truth

SOURCES = Path(__file__).parents[3] / "docs" / "reference" / "mcu_frame"

# The example of docs/reference/mcu_frame.md: counter 258, one second, 1 g up, 0.5 rad/s about z.
EXAMPLE = bytes.fromhex(
    "07 01 02 01 40 42 0F 01 01 01 01 01 01 01 01 05 0A E8 1C 41"
    "01 01 01 01 01 01 01 01 01 01 04 3F 60 E0 00"
)


def test_the_example_of_the_document_is_decoded():
    (sample,) = McuDecoder().feed(EXAMPLE, 5)
    assert (sample.counter, sample.ticks) == (258, 1_000_000)
    assert sample.specific_force == pytest.approx((0.0, 0.0, 9.80665))
    assert sample.angular_rate == (0.0, 0.0, 0.5)


def test_the_checksum_is_the_one_the_document_names():
    assert crc16(b"123456789", 0xFFFF) == 0x29B1  # the check value of CRC-16/CCITT-FALSE


def test_a_frame_of_floats_carries_time_counter_and_motion():
    (sample,) = McuDecoder().feed(mcu(70000), 5)
    assert sample.ticks == 70000 * 5000 % (1 << 32)
    assert (sample.tick_ns, sample.tick_bits) == (1000, 32)
    assert sample.counter == 70000 % (1 << 16)
    assert sample.temperature is None and sample.magnetic_field is None


@pytest.mark.parametrize("layout", [1, 2])
def test_temperature_and_field_come_along_when_announced(layout):
    data = mcu(3, layout=layout, temperature=-12.34, field=(2e-5, -1e-6, 4.8e-5))
    (sample,) = McuDecoder().feed(data, 5)
    assert sample.temperature == pytest.approx(-12.34)
    assert sample.magnetic_field == pytest.approx((2e-5, -1e-6, 4.8e-5))
    assert sample.specific_force == pytest.approx(truth(3)[0], abs=5e-3)


def test_whole_numbers_are_worth_what_the_frame_says():
    plain = struct.pack("<BHI2f6h", 2, 1, 2, 0.5, 0.25, 1, -2, 3, 4, -5, 6)
    frame = stuff(plain + struct.pack("<H", crc16(plain, 0xFFFF)))
    (sample,) = McuDecoder().feed(frame, 5)
    assert sample.specific_force == (0.5, -1.0, 1.5)
    assert sample.angular_rate == (1.0, -1.25, 1.5)


@pytest.mark.parametrize("bits", range(4))
def test_two_bits_say_what_the_values_are(bits):
    plain = struct.pack("<BHI6f", 1 | bits << 6, 1, 2, *[1.0] * 6)
    (sample,) = McuDecoder().feed(stuff(plain + struct.pack("<H", crc16(plain, 0xFFFF))), 5)
    assert sample.increments == (None, "averaged", "sampled", "compensated")[bits]


@pytest.mark.parametrize("kind", [0, 3, 0x43, 0x8F])
def test_a_kind_of_a_later_version_is_counted_and_left_alone(kind):
    plain = struct.pack("<BHI6f", kind, 1, 2, *[1.0] * 6)
    decoder = McuDecoder()
    assert not decoder.feed(stuff(plain + struct.pack("<H", crc16(plain, 0xFFFF))), 5)
    assert decoder.counters["other"] == 1


def test_a_value_that_is_no_number_is_refused():
    plain = struct.pack("<BHI6f", 1, 1, 2, float("nan"), *[1.0] * 5)
    decoder = McuDecoder()
    assert not decoder.feed(stuff(plain + struct.pack("<H", crc16(plain, 0xFFFF))), 5)
    assert decoder.counters["not_finite"] == 1


@given(st.binary(max_size=600))
def test_cobs_gives_back_what_was_stuffed(plain):
    stuffed = stuff(plain)
    assert stuffed.find(0) == len(stuffed) - 1
    assert cobs.decode(stuffed[:-1]) == plain


@pytest.fixture(scope="module")
def encoder(tmp_path_factory):
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        pytest.skip("no C compiler (cc, gcc, clang) to build the reference encoder with")
    library = tmp_path_factory.mktemp("mcu") / "frame.so"
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror"]
    command = [compiler, *flags, "-shared", "-fPIC", "-o", library, SOURCES / "dualfoot_frame.c"]
    subprocess.run(command, check=True)
    loaded = ctypes.CDLL(str(library))
    loaded.dualfoot_frame_f32.restype = loaded.dualfoot_frame_i16.restype = ctypes.c_size_t
    return loaded


class Extras(ctypes.Structure):
    _fields_ = (
        ("centidegrees", ctypes.POINTER(ctypes.c_int16)),
        ("field", ctypes.POINTER(ctypes.c_int16)),
        ("increments", ctypes.c_uint8),
    )


def words(*values):
    return (ctypes.c_int16 * len(values))(*values)


def floats(*values):
    return (ctypes.c_float * len(values))(*values)


def extras(centidegrees, field, increments):
    pointer = ctypes.POINTER(ctypes.c_int16)
    parts = [None if part is None else words(*part) for part in (centidegrees, field)]
    pointers = (ctypes.cast(p, pointer) if p is not None else pointer() for p in parts)
    return Extras(*pointers, increments), parts


i16 = st.integers(-32768, 32767)
f32 = st.floats(width=32, allow_nan=False, allow_infinity=False)
optional = st.tuples(
    st.none() | st.tuples(i16),
    st.none() | st.tuples(i16, i16, i16),
    st.integers(0, 3),
)


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 65535), st.integers(0, 2**32 - 1), st.lists(f32, min_size=6, max_size=6))
def test_the_reference_encoder_and_the_decoder_agree_on_floats(encoder, counter, micros, values):
    out = ctypes.create_string_buffer(43)
    size = encoder.dualfoot_frame_f32(
        out,
        ctypes.c_uint16(counter),
        ctypes.c_uint32(micros),
        floats(*values[:3]),
        floats(*values[3:]),
        None,
    )
    (sample,) = McuDecoder().feed(out.raw[:size], 5)
    assert (sample.counter, sample.ticks) == (counter, micros)
    assert (*sample.specific_force, *sample.angular_rate) == tuple(values)


@settings(max_examples=200, deadline=None)
@given(st.lists(i16, min_size=6, max_size=6), optional)
def test_the_reference_encoder_and_the_decoder_agree_on_whole_numbers(encoder, values, more):
    out = ctypes.create_string_buffer(43)
    also, keep_alive = extras(*more)
    size = encoder.dualfoot_frame_i16(
        out,
        ctypes.c_uint16(1),
        ctypes.c_uint32(2),
        ctypes.c_float(0.5),
        ctypes.c_float(0.25),
        words(*values[:3]),
        words(*values[3:]),
        ctypes.byref(also),
    )
    assert size <= 43 and keep_alive is not None
    (sample,) = McuDecoder().feed(out.raw[:size], 5)
    assert sample.specific_force == tuple(0.5 * v for v in values[:3])
    assert sample.angular_rate == tuple(0.25 * v for v in values[3:])
    temperature, field, kind = more
    assert sample.increments == (None, "averaged", "sampled", "compensated")[kind]
    assert sample.temperature == (None if temperature is None else temperature[0] * 0.01)
    assert sample.magnetic_field == (None if field is None else tuple(v * 1e-7 for v in field))


def test_the_reference_encoder_gives_the_bytes_of_the_document(encoder):
    out = ctypes.create_string_buffer(43)
    size = encoder.dualfoot_frame_f32(
        out,
        ctypes.c_uint16(258),
        ctypes.c_uint32(1_000_000),
        floats(0, 0, 9.80665),
        floats(0, 0, 0.5),
        None,
    )
    document = (SOURCES.parent / "mcu_frame.md").read_text(encoding="utf-8")
    assert out.raw[:size] == EXAMPLE
    assert EXAMPLE.hex(" ").upper() in " ".join(document.split())


def test_the_reference_encoder_compiles_as_arduino_does():
    compiler = shutil.which("c++") or shutil.which("g++") or shutil.which("clang++")
    if compiler is None:
        pytest.skip("no C++ compiler (c++, g++, clang++) to build the reference encoder with")
    flags = ["-std=c++11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c++"]
    subprocess.run([compiler, *flags, SOURCES / "dualfoot_frame.c"], check=True)
