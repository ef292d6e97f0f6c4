"""The decoder of VectorNav's ASCII lines against lines worked out by hand."""

import pytest

from dualfoot_ros.drivers.protocols.vectornav_ascii import VectorNavAsciiDecoder

from ..frames import crc16, vectornav_line

BODY = (
    "VNIMU,-01.0640,-00.2531,+03.0614,+00.005,+00.344,-09.758,-0.001222,-0.000450,-0.001218,"
    "+25.7,+101.4"
)


def decode(*lines):
    decoder = VectorNavAsciiDecoder()
    return decoder.feed(b"".join(lines), 5), decoder


def test_a_line_of_the_imu_has_field_force_rate_and_temperature():
    (sample,), _ = decode(vectornav_line(BODY))
    assert sample.specific_force == (0.005, 0.344, -9.758)
    assert sample.angular_rate == (-0.001222, -0.00045, -0.001218)
    assert sample.magnetic_field == pytest.approx((-1.064e-4, -2.531e-5, 3.0614e-4))
    assert sample.temperature == 25.7
    assert sample.ticks is None


def test_the_longer_checksum_is_checked_as_well():
    line = f"${BODY}*{crc16(BODY.encode(), 0):04X}\r\n".encode()
    samples, decoder = decode(line, line.replace(b"00.344", b"00.345"))
    assert len(samples) == 1
    assert decoder.counters["bad_checksum"] == 1


@pytest.mark.parametrize(
    ("name", "before"), [("VNMAR", []), ("VNYMR", ["1"] * 3), ("VNQMR", ["0"] * 4)]
)
def test_lines_with_attitude_before_the_values_are_read(name, before):
    cells = [*before, "0.1", "0.2", "0.3", "1", "2", "3", "4", "5", "6"]
    (sample,), _ = decode(vectornav_line(",".join([name, *cells])))
    assert sample.specific_force == (1.0, 2.0, 3.0)
    assert sample.angular_rate == (4.0, 5.0, 6.0)


def test_other_lines_and_lines_with_other_content_are_counted():
    samples, decoder = decode(
        vectornav_line("VNYPR,+1,+2,+3"),
        vectornav_line("VNIMU,1,2,3"),
        vectornav_line(BODY.replace("00.344", "1_0")),
        b"$VNIMU,1,2,3\r\n",
        b"nonsense\r\n",
    )
    assert samples == []
    assert decoder.counters["other"] == 1
    assert decoder.counters["malformed"] == 2
    assert decoder.counters["bad_checksum"] == 1
    assert decoder.counters["garbage_bytes"] == 9
