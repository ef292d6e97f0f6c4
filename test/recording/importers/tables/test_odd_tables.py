"""Odd tables: what is wrong is named with its place and the remedy, what is doubtful is said."""

import numpy as np
import pytest

from dualfoot_ros.core import RecordingError
from dualfoot_ros.recording.importers import read_sensors
from dualfoot_ros.recording.importers.tables import Intake, Layout, read_one

from ..made_up import values, walk

NAMES = ("time (s)", "ax", "ay", "az", "gx", "gy", "gz")
FOOT = walk(count=240, stand=100)["left"]


def rows(step_s=0.01, force=1.0, rate=1.0):
    """Return the cells of a foot at 100 Hz."""
    time = np.arange(len(FOOT)) * step_s
    cells = np.column_stack([time, values(FOOT) / ([force] * 3 + [rate] * 3)])
    return [[f"{cell:.9g}" for cell in row] for row in cells]


def write(folder, cells, names=NAMES, delimiter=",", quote=""):
    path = folder / "a.csv"
    lines = [delimiter.join(f"{quote}{cell}{quote}" for cell in row) for row in [names, *cells]]
    path.write_text("\n".join(line for line in lines if line) + "\n")
    return path


def read(path):
    return read_sensors(path)[""]


def doubts(path):
    return [a.value for a in read_one(path, "left", Intake(Layout())).assumptions if a.doubtful]


def test_rows_without_a_time_are_left_out_and_counted(tmp_path):
    cells = rows()
    for row, gap in ((50, ""), (120, "NaN"), (121, "null")):
        cells[row][0] = gap
    path = write(tmp_path, cells)
    found = read(path)
    keep = np.delete(np.arange(len(FOOT)), [50, 120, 121])
    np.testing.assert_allclose(found.angular_rate, FOOT.angular_rate[keep], atol=1e-6)
    assert np.diff(found.stamp_ns).max() == pytest.approx(30_000_000)
    assert doubts(path) == ["3 of 240 left out, with empty cells"]


@pytest.mark.parametrize("gap", ["", "null", "NaN", "-", "N/A"])
@pytest.mark.parametrize("quote", ["", '"'])
@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_empty_cells_may_be_quoted_words(tmp_path, gap, quote, delimiter):
    cells = rows()
    cells[7][3] = cells[7][4] = gap
    found = read(write(tmp_path, cells, delimiter=delimiter, quote=quote))
    good = found.specific_force[np.isfinite(found.specific_force).all(axis=1)]
    assert len(good) == len(FOOT) - 1


def test_names_may_be_those_of_a_german_export(tmp_path):
    force = [f"Beschleunigung {a} (m/s^2)" for a in "xyz"]
    rate = [f"Winkelgeschwindigkeit {a} (rad/s)" for a in "xyz"]
    found = read(write(tmp_path, rows(), ("Zeit (s)", *force, *rate)))
    np.testing.assert_allclose(found.angular_rate, FOOT.angular_rate, atol=1e-6)


def test_quoted_cells_may_stand_between_spaces(tmp_path):
    found = read(write(tmp_path, rows(), delimiter=" ", quote='"'))
    np.testing.assert_allclose(found.specific_force, FOOT.specific_force, atol=1e-6)


def test_a_column_without_values_is_named(tmp_path):
    cells = [[*row[:2], "", *row[3:]] for row in rows()]
    with pytest.raises(RecordingError, match=r"'ay' is empty in 240 of 240 rows.*--columns"):
        read(write(tmp_path, cells))


@pytest.mark.parametrize("word", ["#DIV/0!", "1.2.3", "12abc", "1_000"])
def test_a_cell_that_is_no_number_is_named_by_line_and_column(tmp_path, word):
    cells = rows()
    cells[40][5] = word
    with pytest.raises(RecordingError, match=rf"line 42 has '{word}' in column 'gy'.*remove the"):
        read(write(tmp_path, cells))


@pytest.mark.parametrize(
    ("column", "unit"),
    [("ax", "(cm/s^2)"), ("ax", "[ft/s²]"), ("gx", "(rpm)"), ("gx", "_rpm"), ("gx", "(deg/min)")],
)
def test_a_unit_that_is_not_converted_is_refused_though_the_motion_fits_another(
    tmp_path, column, unit
):
    names = [f"{name}{unit}" if name[0] == column[0] else name for name in NAMES]
    sentence = rf"column '{column}.*unit that is not known here; allowed is .*--(force|rate)-unit"
    with pytest.raises(RecordingError, match=sentence):
        read(write(tmp_path, rows(), names))


def test_raw_counts_under_the_name_of_a_unit_are_refused(tmp_path):
    names = ("time (s)", "ax (g)", "ay (g)", "az (g)", "gx (dps)", "gy (dps)", "gz (dps)")
    sentence = r"should be in g .* reads 204. at rest, which is gravity in no known unit"
    with pytest.raises(RecordingError, match=sentence):
        read(write(tmp_path, rows(force=9.80665 / 2048, rate=np.pi / 180), names))


def test_a_unit_that_only_gravity_tells_is_doubtful_where_gravity_is_off(tmp_path):
    milli_g, centimetres = 9.80665e-3, 1e-2
    assert doubts(write(tmp_path, rows(force=milli_g))) == []
    assert doubts(write(tmp_path, rows(force=centimetres)))[0].startswith("mg (it reads 98")


@pytest.mark.parametrize(("step", "rate"), [(100.0, "10 Hz"), (0.001, "1000 Hz")])
def test_an_unusual_rate_is_doubtful_where_only_the_values_tell_the_unit(tmp_path, step, rate):
    names = ("time", *NAMES[1:])
    assert f"which gives {rate}; if that is wrong, give --time-unit" in doubts(
        write(tmp_path, rows(step_s=step), names)
    )[0].replace("1e+03", "1000")
    assert doubts(write(tmp_path, rows(step_s=0.01), names)) == []


def test_ticks_of_a_tenth_of_a_millisecond_do_not_change_the_rate(tmp_path):
    names = ("SampleTimeFine", *NAMES[1:])
    due = 5.0 + np.delete(np.arange(len(FOOT) + 3) / 60.0, [100, 101, 102])
    cells = rows(rate=np.pi / 180.0)
    for row, time in zip(cells, due, strict=True):
        row[0] = str(round(time * 1e4))
    found = read(write(tmp_path, cells, names))
    assert found.rate_hz == pytest.approx(60.0, rel=1e-4)
    np.testing.assert_allclose(found.stamp_ns * 1e-9, due, atol=1e-4)  # with its gap
    late = due + 0.002 * np.random.default_rng(3).random(len(due))
    for row, time in zip(cells, late, strict=True):
        row[0] = str(round(time * 1e4))
    np.testing.assert_allclose(
        read(write(tmp_path, cells, names)).stamp_ns * 1e-9, late, atol=6e-5
    )


def test_rows_in_disorder_are_refused(tmp_path):
    cells = [rows()[k] for k in np.random.default_rng(0).permutation(len(FOOT))]
    with pytest.raises(RecordingError, match=r"'time \(s\)' goes back in \d+ of 239.*sort the"):
        read(write(tmp_path, cells))


def test_a_single_time_out_of_range_is_named(tmp_path):
    cells = rows()
    cells[99][0] = "9e24"
    with pytest.raises(RecordingError, match=r"9e\+24 in sample 100, 1 of 240.*remove these rows"):
        read(write(tmp_path, cells))


def test_two_axes_of_a_rate_are_not_called_a_rate(tmp_path):
    names = (*NAMES[:5], "gy", "gy")
    with pytest.raises(
        RecordingError, match=r"no angular rate: it holds the columns 'time \(s\)'"
    ):
        read(write(tmp_path, rows(), names))


@pytest.mark.parametrize(
    ("times", "name", "day", "clock"),
    [
        (["Datum", "Uhrzeit"], "", "01.05.2026", "12:00:{:06.3f}"),
        (["Date", "Time"], "", "2026-05-01", "12:00:{:06.3f}"),
        (["Fecha", "Hora"], "", "2026-05-01", "12:00:{:06.3f}"),
        (["Datum"], "01.05.2026 12:00:{:06.3f}", "", ""),
        (["date"], "2026-05-01T12:00:{:06.3f}", "", ""),
    ],
)
def test_the_time_may_be_a_date_in_one_column_or_two(tmp_path, times, name, day, clock):
    cells = [
        [*([name.format(0.01 * k)] if name else [day, clock.format(0.01 * k)]), *row[1:]]
        for k, row in enumerate(rows())
    ]
    found = read(write(tmp_path, cells, names=(*times, *NAMES[1:])))
    np.testing.assert_array_equal(np.diff(found.stamp_ns), 10_000_000)


def test_a_clock_time_goes_on_over_midnight(tmp_path):
    cells = rows()
    for k, row in enumerate(cells):
        hour, rest = divmod((86_399_000 + 10 * k) % 86_400_000, 3_600_000)
        row[0] = f"{hour:02d}:{rest // 60_000:02d}:{rest % 60_000 / 1000:06.3f}"
    found = read(write(tmp_path, cells, names=("time", *NAMES[1:])))
    np.testing.assert_array_equal(np.diff(found.stamp_ns), 10_000_000)


def test_a_unit_taken_from_a_gravity_that_is_off_is_said_with_the_reason(tmp_path):
    (doubt,) = doubts(write(tmp_path, rows(force=1.02)))
    assert doubt.startswith("m/s^2 (it reads 9.6")
    assert doubt.endswith("% off gravity; if that is no error of scale, give --force-unit")


def test_a_table_of_one_row_is_said_to_have_one_sample(tmp_path):
    with pytest.raises(RecordingError, match="holds 1 sample; at least 2 are needed"):
        read(write(tmp_path, rows()[:1]))
