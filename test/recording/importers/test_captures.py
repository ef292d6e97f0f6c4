"""Captured bytes become samples by the decoders that run live, with the clocks of the devices."""

import struct

import numpy as np
import pytest
from drivers.frames import (
    PERIOD_US,
    cobs,
    crc16,
    decoder_format,
    stream,
    truth,
    witmotion_combined,
)

from dualfoot_ros.core import RecordingError
from dualfoot_ros.recording.importers import ImportOptions, import_recording

TIMED = ("mcu", "ximu3", "ximu3_ascii", "witmotion", "xbus", "vectornav")
COUNT = 300


def files(folder, left, right, suffix=".bin"):
    """Write two captures and return their paths by foot."""
    paths = {"left": folder / f"L{suffix}", "right": folder / f"R{suffix}"}
    paths["left"].write_bytes(left)
    paths["right"].write_bytes(right)
    return paths


@pytest.mark.parametrize("name", TIMED)
def test_every_format_comes_out_in_si_units_with_the_stamps_of_the_devices(tmp_path, name):
    paths = files(tmp_path, stream(name, COUNT), stream(name, COUNT, first=40))
    found = import_recording(ImportOptions(**paths, capture=decoder_format(name)))
    for series, first in ((found.left, 0), (found.right, 40)):
        assert len(series) == COUNT
        assert set(np.diff(series.stamp_ns)) == {PERIOD_US * 1000}
        forces, rates = zip(*(truth(k) for k in range(first, first + COUNT)), strict=True)
        assert np.allclose(series.specific_force, forces, atol=2e-3)
        assert np.allclose(series.angular_rate, rates, atol=2e-4)
    assert found.right.stamp_ns[0] - found.left.stamp_ns[0] == 40 * PERIOD_US * 1000
    assert found.notes["format"] == f"capture, {decoder_format(name)}"
    assert "losses" not in found.notes


def test_a_clock_that_wraps_goes_on(tmp_path):
    first = (1 << 32) // PERIOD_US - 100
    paths = files(
        tmp_path, stream("mcu", COUNT, first=first), stream("mcu", COUNT, first=first + 1)
    )
    stamps = import_recording(ImportOptions(**paths, capture="mcu")).left.stamp_ns
    assert set(np.diff(stamps)) == {PERIOD_US * 1000}


def test_a_file_of_an_x_imu3_is_known_by_its_ending(tmp_path):
    paths = files(tmp_path, stream("ximu3", COUNT), stream("ximu3", COUNT, first=1), ".ximu3")
    assert len(import_recording(ImportOptions(**paths)).left) == COUNT


def test_a_device_without_a_clock_needs_its_rate(tmp_path):
    frames = [witmotion_combined(k) for k in range(COUNT + 1)]
    paths = files(tmp_path, b"".join(frames[:-1]), b"".join(frames[1:]))
    with pytest.raises(RecordingError, match=r"L.bin' sends no time; give .* --capture-rate HZ"):
        import_recording(ImportOptions(**paths, capture="witmotion"))
    options = ImportOptions(**paths, capture="witmotion", capture_rate=100.0)
    found = import_recording(options)
    assert found.left.rate_hz == pytest.approx(100.0)
    assert found.notes["stamp_source"] == "the number of the sample, at 100 Hz"


def test_options_of_the_decoder_stand_behind_the_format(tmp_path):
    paths = files(tmp_path, stream("witmotion", COUNT), stream("witmotion", COUNT, first=1))
    whole = import_recording(ImportOptions(**paths, capture="witmotion"))
    small = import_recording(ImportOptions(**paths, capture="witmotion?force_range=4"))
    assert np.allclose(4.0 * small.left.specific_force, whole.left.specific_force)
    for capture, sentence in (("witmotion?range=4", "unknown option 'range'"), ("tape", "tape")):
        with pytest.raises(RecordingError, match=sentence):
            import_recording(ImportOptions(**paths, capture=capture))


def test_axes_turn_the_device_into_the_body(tmp_path):
    paths = files(tmp_path, stream("mcu", COUNT), stream("mcu", COUNT, first=1))
    plain, turned = (
        import_recording(ImportOptions(**paths, capture="mcu", axes=axes)).left
        for axes in ("+x+y+z", "+y-x+z")
    )
    expected = plain.specific_force[:, [1, 0, 2]] * [1, -1, 1]
    assert np.allclose(turned.specific_force, expected)


def test_a_field_comes_along(tmp_path):
    frames = []
    for k in range(41):
        plain = struct.pack("<BHI6f3h", 1 | 1 << 5, k, k * PERIOD_US, *[1.0] * 6, 100, -200, 300)
        frames.append(cobs(plain + struct.pack("<H", crc16(plain, 0xFFFF))))
    paths = files(tmp_path, b"".join(frames[:-1]), b"".join(frames[1:]))
    found = import_recording(ImportOptions(**paths, capture="mcu", axes="+y-x+z"))
    assert np.allclose(found.left.magnetic_field, [-200e-7, -100e-7, 300e-7])


def test_what_was_damaged_or_lost_is_told(tmp_path):
    data = bytearray(stream("xbus", COUNT))
    data[len(data) // 2] ^= 0x40
    paths = files(tmp_path, bytes(data), stream("xbus", COUNT))
    found = import_recording(ImportOptions(**paths, capture="xbus"))
    assert len(found.left) == COUNT - 1
    assert found.notes["losses"].startswith("left ")


def test_a_capture_of_another_format_is_recognised(tmp_path):
    paths = files(tmp_path, stream("xbus", 50), stream("xbus", 50))
    with pytest.raises(RecordingError, match=r"no sample .* 'vectornav' .* of the format 'xbus'"):
        import_recording(ImportOptions(**paths, capture="vectornav"))


@pytest.mark.parametrize("name", TIMED)
def test_a_capture_that_is_given_for_both_feet_is_refused(tmp_path, name):
    paths = files(tmp_path, stream(name, 50), stream(name, 50))
    with pytest.raises(RecordingError, match="both feet hold the same samples"):
        import_recording(ImportOptions(**paths, capture=decoder_format(name)))


def test_what_is_missing_is_said(tmp_path):
    paths = files(tmp_path, stream("mcu", 50), stream("mcu", 50))
    with pytest.raises(RecordingError, match="give --left FILE and --right FILE"):
        import_recording(ImportOptions(left=paths["left"], capture="mcu"))
    with pytest.raises(RecordingError, match="give --capture FORMAT"):
        import_recording(ImportOptions(**paths), "capture")
    with pytest.raises(RecordingError, match="--capture-rate does not apply to the format xsens"):
        import_recording(ImportOptions(**paths, capture_rate=5.0), "xsens-dot")
