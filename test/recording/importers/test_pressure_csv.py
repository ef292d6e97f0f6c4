"""A column of air pressure beside the recordings of the feet."""

import numpy as np
import pytest

from dualfoot_ros.core.errors import RecordingError
from dualfoot_ros.recording.importers.pressure_csv import read_pressure


def written(tmp_path, text):
    path = tmp_path / "baro.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("header", "row"),
    [
        ("stamp_ns,pressure_Pa", "1750000000123456789,101325.5"),
        ("note,stamp_ns,pressure_hPa", "a,1750000000123456789,1013.255"),
    ],
)
def test_nanoseconds_survive_to_the_last_digit_and_units_are_told_by_the_names(
    tmp_path, header, row
):
    series = read_pressure(written(tmp_path, f"{header}\n{row}\n"))
    assert series.stamp_ns.tolist() == [1750000000123456789]
    assert series.pressure == pytest.approx([101325.5])


@pytest.mark.parametrize(("name", "unit"), [("time_us", 1e-6), ("time_ms", 1e-3), ("time_s", 1.0)])
def test_other_units_of_time_become_nanoseconds(tmp_path, name, unit):
    text = f"{name},pressure_Pa\n{1.5 / unit},1e5\n{2.5 / unit},1e5\n"
    assert np.diff(read_pressure(written(tmp_path, text)).stamp_ns).tolist() == [1_000_000_000]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "holds no samples"),
        ("time_s,pressure\n1,2\n", "one of pressure_Pa, pressure_hPa"),
        ("time_s,time_ms,pressure_Pa\n1,1000,2\n", "exactly one must be one of stamp_ns"),
        ("time_s,pressure_Pa\n1,2\n2,high\n", "line 3: pressure_Pa is 'high'"),
        ("stamp_ns,pressure_Pa\n1.5,2\n", "line 2: stamp_ns is '1.5'"),
        ("time_s,pressure_Pa\n1\n", "line 2: not as many cells"),
        ("time_s,pressure_Pa\n1,2\n2,7,3\n", "line 3: not as many cells"),
    ],
)
def test_what_cannot_be_read_is_named(tmp_path, text, said):
    with pytest.raises(RecordingError, match=said):
        read_pressure(written(tmp_path, text))


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(RecordingError, match=r"nosuch\.csv"):
        read_pressure(tmp_path / "nosuch.csv")
