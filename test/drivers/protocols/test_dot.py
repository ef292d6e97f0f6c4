"""The two ways an Xsens DOT gives its samples: csv lines and BLE notifications."""

import struct

import numpy as np
import pytest

from dualfoot_ros.core import Increments
from dualfoot_ros.drivers.protocols.dot import DotConfig, DotDecoder
from dualfoot_ros.drivers.protocols.dot_csv import DotCsvConfig, DotCsvDecoder

from ..frames import dot, dot_csv, stream, truth


@pytest.mark.parametrize("payload", ["rate", "rate_mag", "custom5"])
@pytest.mark.parametrize("padding", [0, 6])
def test_a_notification_is_a_sample(payload, padding):
    decoder = DotDecoder(DotConfig(payload=payload, field_unit=5e-5))
    (sample,) = decoder.feed(dot(9, payload, padding), 5)
    force, rate = truth(9)
    assert sample.specific_force == pytest.approx(force, rel=1e-6)
    assert sample.angular_rate == pytest.approx(rate, rel=1e-6)
    assert (sample.ticks, sample.tick_ns, sample.tick_bits) == (45_000, 1000, 32)
    assert sample.increments is Increments.COMPENSATED
    field = (2.5e-5, -1.25e-5, 3.75e-5) if payload == "rate_mag" else None
    assert sample.magnetic_field == (None if field is None else pytest.approx(field))


@pytest.mark.parametrize("length", [0, 27, 64, 500])
def test_a_notification_of_the_wrong_length_is_counted_and_dropped(length):
    decoder = DotDecoder()
    assert decoder.feed(bytes(length), 5) == []
    assert decoder.counters["malformed"] == 1


def test_a_notification_with_a_value_that_is_no_number_is_refused():
    decoder = DotDecoder()
    assert decoder.feed(struct.pack("<I6f", 1, float("inf"), *[0.0] * 5), 5) == []
    assert decoder.counters["not_finite"] == 1


def test_csv_lines_before_the_names_of_the_columns_are_no_samples():
    decoder = DotCsvDecoder()
    assert decoder.feed(dot_csv(0), 5) == []
    assert len(decoder.feed(stream("dot_csv", 3), 5)) == 3


def test_columns_are_found_by_name_whatever_their_order():
    text = (
        b"PacketCounter;Gyr_Z;Gyr_Y;Gyr_X;Acc_Z;Acc_Y;Acc_X;SampleTimeFine\n"
        b"1;180;0;0;9.81;0;-1;16667\n"
    )
    (sample,) = DotCsvDecoder().feed(text, 5)
    assert sample.specific_force == (-1.0, 0.0, 9.81)
    assert sample.angular_rate == pytest.approx((0.0, 0.0, np.pi))
    assert sample.ticks == 16667


@pytest.mark.parametrize("sign", [b",", b";", b"\t"])
def test_counters_as_floats_quoted_names_and_tabs_are_read_as_the_importer_reads_them(sign):
    lines = [
        b'"PacketCounter",SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z\n',
        b"1.0,1000000.0,0,0,9.81,0,0,180\n2.0,1016667.00,0,0,9.81,0,0,180\n",
    ]
    decoder = DotCsvDecoder()
    samples = decoder.feed(b"".join(lines).replace(b",", sign), 5)
    assert [sample.ticks for sample in samples] == [1000000, 1016667]
    assert [sample.counter for sample in samples] == [1, 2]
    assert not decoder.counters["malformed"]


def test_an_export_without_acceleration_is_counted_as_incomplete():
    decoder = DotCsvDecoder()
    decoder.feed(b"PacketCounter,SampleTimeFine,FreeAcc_X,FreeAcc_Y,FreeAcc_Z\n1,2,3,4,5\n", 5)
    assert decoder.counters["incomplete"] == 1
    assert not decoder.counters["samples"]


@pytest.mark.parametrize(
    "line", [b"2,10,1,2\n", b"2,-5,0,0,9,0,0,0\n", b"2,5,x,0,9,0,0,0\n", b"2,5,1_0,0,9,0,0,0\n"]
)
def test_a_damaged_line_is_counted_and_the_next_one_read(line):
    decoder = DotCsvDecoder()
    assert len(decoder.feed(stream("dot_csv", 2) + line + dot_csv(3), 5)) == 3
    assert decoder.counters["malformed"] == 1


def test_the_field_comes_when_its_unit_is_given():
    decoder = DotCsvDecoder(DotCsvConfig(field_unit=5e-5))
    (sample,) = decoder.feed(stream("dot_csv", 1), 5)
    assert sample.magnetic_field == pytest.approx((2.5e-5, -1.25e-5, 3.75e-5))


def test_a_real_export_gives_every_line_with_gravity_where_the_file_says(dual_feet):
    data = (dual_feet / "calibration" / "Azu.csv").read_bytes()
    decoder = DotCsvDecoder()
    samples = decoder.feed(data, 5)
    assert len(samples) == data.rstrip().count(b"\n") + 1 - 12
    assert not decoder.counters["malformed"] and not decoder.counters["lost"]
    mean = np.mean([sample.specific_force for sample in samples], axis=0)
    assert mean[2] == pytest.approx(9.8, abs=0.4)
    assert np.hypot(mean[0], mean[1]) < 0.6
