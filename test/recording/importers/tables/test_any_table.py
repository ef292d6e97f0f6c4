"""Tables of any make are read right or refused in a sentence: no wrong unit, no traceback."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import FORCE_UNITS, RATE_UNITS
from dualfoot_ros.recording import RecordingError
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.recording.importers.tables import Layout, from_note

from ..made_up import number, same, table, values, walk

TIMES = {"s": 1e9, "ms": 1e6, "us": 1e3, "ns": 1.0}
STYLES = {
    "bare": ("t", ("ax", "ay", "az"), ("gx", "gy", "gz")),
    "words": (
        "timestamp",
        tuple(f"accelerometer_{a}" for a in "xyz"),
        tuple(f"gyro_{a}" for a in "xyz"),
    ),
    "bracket": (
        "Time ({time})",
        tuple(f"Acc {a} [{{force}}]" for a in "XYZ"),
        tuple(f"Gyr {a} [{{rate}}]" for a in "XYZ"),
    ),
    "ros": (
        "stamp",
        tuple(f"linear_acceleration.{a}" for a in "xyz"),
        tuple(f"angular_velocity.{a}" for a in "xyz"),
    ),
}
FEET = walk(count=240, stand=100)


@dataclass(frozen=True)
class Make:
    """The make of a table."""

    style: str
    order: tuple[int, ...]
    time: str
    force: str
    rate: str
    delimiter: str
    decimal: str
    encoding: str
    end: str
    preamble: int
    counter: bool
    holes: tuple[int, ...]
    cut: bool
    told_force: str = ""
    told_rate: str = ""

    def names(self):
        time, force, rate = STYLES[self.style]
        units = {
            "time": self.time,
            "force": self.told_force or self.force,
            "rate": self.told_rate or self.rate,
        }
        names = [name.format(**units) for name in (time, *force, *rate)]
        return [names[k] for k in self.order] + (["counter"] if self.counter else [])

    def text(self, series):
        cells = np.hstack([np.zeros((len(series), 1)), values(series, self.force, self.rate)])
        rows = []
        for k, row in enumerate(cells):
            time = series.stamp_ns[k] / TIMES[self.time]
            texts = [f"{time:.6f}".replace(".", self.decimal)]
            texts += [f"{cell:.9f}".replace(".", self.decimal) for cell in row[1:]]
            if k in self.holes:
                texts[3] = ""
            rows.append([texts[i] for i in self.order] + ([str(k)] if self.counter else []))
        before = [f"device: shoe {k}" for k in range(self.preamble)]
        text = table(self.names(), rows, delimiter=self.delimiter, before=before, end=self.end)
        return text[: -len(text.split(self.end)[-2]) // 2] if self.cut else text


makes = st.builds(
    Make,
    style=st.sampled_from(sorted(STYLES)),
    order=st.permutations(range(7)).map(tuple),
    time=st.sampled_from(sorted(TIMES)),
    force=st.sampled_from(sorted(FORCE_UNITS)),
    rate=st.sampled_from(sorted(RATE_UNITS)),
    delimiter=st.sampled_from([",", ";", "\t", "|"]),
    decimal=st.sampled_from([".", ","]),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
    preamble=st.integers(0, 4),
    counter=st.booleans(),
    holes=st.lists(st.integers(0, 239), max_size=4).map(tuple),
    cut=st.booleans(),
)
few = settings(
    max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def written(folder, make):
    """Write both feet; return the options."""
    files = {}
    for foot, series in FEET.items():
        files[foot] = folder / f"{foot}.csv"
        files[foot].write_bytes(make.text(series).encode(make.encoding))
    return ImportOptions(**files)


@few
@given(makes)
def test_a_table_of_any_make_is_read_in_si(tmp_path, make):
    assume(make.delimiter != make.decimal)
    found = import_recording(written(tmp_path, make))
    for foot, series in FEET.items():
        last = len(series) - make.cut
        whole = [k for k in range(last) if k not in make.holes]
        imu = found.imu(foot)
        assert len(imu) == len(whole)
        expected = series[np.array(whole)]
        np.testing.assert_allclose(imu.specific_force, expected.specific_force, atol=1e-4)
        np.testing.assert_allclose(imu.angular_rate, expected.angular_rate, atol=1e-4)
        np.testing.assert_allclose(imu.stamp_ns, expected.stamp_ns, atol=2000)


@few
@given(makes, st.sampled_from(sorted(FORCE_UNITS)), st.sampled_from(sorted(RATE_UNITS)))
def test_a_unit_that_the_names_tell_wrong_is_refused(tmp_path, make, force, rate):
    assume(make.delimiter != make.decimal)
    assume((force, rate) != (make.force, make.rate))
    wrong = Make(**{**make.__dict__, "style": "bracket", "told_force": force, "told_rate": rate})
    with pytest.raises(RecordingError, match=r"(--force-unit|--rate-unit)"):
        import_recording(written(tmp_path, wrong))


@few
@given(st.binary(max_size=400), st.text(max_size=400))
def test_rubbish_is_refused_in_a_sentence(tmp_path, data, text):
    for content in (data, text.encode("utf-8", "replace")):
        (tmp_path / "a.csv").write_bytes(content)
        with pytest.raises(RecordingError, match=r"a\.csv"):
            import_recording(ImportOptions(left=tmp_path / "a.csv", right=tmp_path / "a.csv"))


@few
@given(makes, st.integers(0, 3000), st.binary(min_size=1, max_size=30))
def test_a_damaged_table_is_read_right_or_refused(tmp_path, make, place, noise):
    assume(make.delimiter != make.decimal)
    options = written(tmp_path, make)
    data = options.left.read_bytes()
    options.left.write_bytes(data[:place] + noise + data[place + len(noise) :])
    try:
        found = import_recording(options)
    except RecordingError:
        return
    speed = np.linalg.norm(found.left.angular_rate, axis=1)
    assert 1.0 < np.quantile(speed, 0.98) < 40.0
    assert np.median(np.linalg.norm(found.left.specific_force, axis=1)) == pytest.approx(9.8, 0.1)


def still(**changes):
    """Return a foot that only stands, in which motion tells nothing about the rates."""
    return walk(count=300, stand=300, **changes)


def plain(series, names="t,ax,ay,az,gx,gy,gz", force="m/s^2", rate="rad/s", stamps=None):
    """Return a table with these names."""
    stamps = series.stamp_ns / 1e9 if stamps is None else stamps
    rows = [[t, *row] for t, row in zip(stamps, values(series, force, rate), strict=True)]
    return table(names.split(","), rows)


def files(folder, feet, write):
    """Write a table for each foot; return the options."""
    paths = {}
    for foot, series in feet.items():
        paths[foot] = folder / f"{foot}.csv"
        paths[foot].write_text(write(series))
    return ImportOptions(**paths)


def test_rates_at_rest_without_a_unit_are_not_guessed(tmp_path):
    options = files(tmp_path, still(), plain)
    with pytest.raises(RecordingError, match=r"motion does not decide .* --rate-unit"):
        import_recording(options)
    found = import_recording(
        ImportOptions(options.sources, options.left, options.right, rate_unit="rad/s")
    )
    same(found.left, still()["left"])


def test_acceleration_without_gravity_is_refused_and_named(tmp_path):
    def free(series):
        gone = series.specific_force - [0.0, 0.0, 9.80665]
        names = "Time (s)," + ",".join(f"Linear Acceleration {a} (m/s^2)" for a in "xyz")
        names += "," + ",".join(f"Gyroscope {a} (rad/s)" for a in "xyz")
        return plain(type(series)(series.stamp_ns, gone, series.angular_rate), names)

    with pytest.raises(RecordingError, match="gravity was taken out"):
        import_recording(files(tmp_path, walk(), free))


def test_a_time_that_a_spreadsheet_rounded_is_refused_without_a_counter(tmp_path):
    def rounded(series):
        return plain(series, stamps=np.round(series.stamp_ns / 1e9))

    with pytest.raises(RecordingError, match=r"was rounded .* a step is 1 s.*--rate HZ"):
        import_recording(files(tmp_path, walk(), rounded))


def test_a_time_that_a_spreadsheet_rounded_is_rebuilt_from_the_counter(tmp_path):
    def rounded(series):
        stamps = np.round(series.stamp_ns / 1e8) / 10
        rows = [
            [f"{t:.1f}", f"{k}.0", *row]
            for k, (t, row) in enumerate(zip(stamps, values(series), strict=True))
            if k % 50 != 7  # lost samples stay gaps
        ]
        return table(["t", "counter", "ax", "ay", "az", "gx", "gy", "gz"], rows)

    found = import_recording(files(tmp_path, walk(), rounded))
    steps = np.diff(found.left.stamp_ns) * 1e-9
    assert np.median(steps) == pytest.approx(0.01, rel=0.02)
    assert steps.max() == pytest.approx(0.02, rel=0.02)
    assert "rebuilt from the counter" in found.notes["assumptions"]


def test_exponents_index_columns_and_repeated_names_are_understood(tmp_path):
    def frame(series):
        rows = [
            [str(k), *(f"{cell:.9E}" for cell in (series.stamp_ns[k] / 1e9, *row))]
            for k, row in enumerate(values(series))
        ]
        text = table(["", "t", "ax", "ay", "az", "gx", "gy", "gz"], rows)
        lines = text.splitlines()
        return "\n".join([*lines[:100], lines[0], *lines[100:]]) + "\n"  # appended to

    found = import_recording(files(tmp_path, walk(), frame))
    same(found.left, walk()["left"])


def test_a_table_without_names_is_read_by_numbers_of_columns(tmp_path):
    def bare(series):
        return plain(series).split("\n", 1)[1]

    options = files(tmp_path, walk(), bare)
    with pytest.raises(RecordingError, match="no line with the names of its 7 columns"):
        import_recording(options)
    roles = dict(zip(("time", "ax", "ay", "az", "gx", "gy", "gz"), "1234567", strict=True))
    found = import_recording(
        ImportOptions(left=options.left, right=options.right, layout=Layout(columns=roles))
    )
    same(found.right, walk()["right"])
    assert "column 1, in s" in found.notes["assumptions"]


def test_dates_and_clock_times_are_times(tmp_path):
    def dated(series):
        stamps = (np.datetime64("2024-05-01T12:00:00", "ns") + series.stamp_ns).astype(str)
        rows = [
            [str(t).replace("T", " "), *row] for t, row in zip(stamps, values(series), strict=True)
        ]
        return table(["datetime", "ax", "ay", "az", "gx", "gy", "gz"], rows)

    def clock(series):
        rows = [
            [f"12:00:{10 + k / 100:06.3f}", *row] for k, row in enumerate(values(series[:900]))
        ]
        return table(["time", "ax", "ay", "az", "gx", "gy", "gz"], rows)

    def day_first(series):
        return dated(series).replace("2024-05-01", "1.5.2024")

    for write in (dated, clock, day_first):
        same(import_recording(files(tmp_path, walk(), write)).left, walk()["left"])


def test_both_feet_in_one_table_are_told_apart_by_a_column_or_by_names(tmp_path):
    feet = walk()
    rows = [
        [feet[foot].stamp_ns[k] / 1e9, foot, *values(feet[foot])[k]]
        for k in range(len(feet["left"]))
        for foot in feet
    ]
    column = tmp_path / "column.csv"
    column.write_text(table(["t", "foot", "ax", "ay", "az", "gx", "gy", "gz"], rows))
    wide = tmp_path / "wide.csv"
    names = [f"{side}_{v}{a}" for side in "LR" for v in ("acc_", "gyr_") for a in "xyz"]
    both = np.hstack([values(feet["left"]), values(feet["right"])])
    stamps = feet["left"].stamp_ns / 1e9
    wide.write_text(table(["t", *names], [[t, *r] for t, r in zip(stamps, both, strict=True)]))
    for path in (column, wide):
        found = import_recording(ImportOptions((path,)))
        for foot, series in feet.items():
            same(found.imu(foot), series)


def test_force_and_rate_of_rows_of_their_own_are_brought_together(tmp_path):
    def apart(series):
        rows = []
        for k, row in enumerate(values(series)):
            force, rate = [number(cell) for cell in row[:3]], [number(cell) for cell in row[3:]]
            stamp = series.stamp_ns[k] / 1e9
            rows += [[stamp, *force, "", "", ""], [stamp, "", "", "", *rate]]
        return table(["t", "ax", "ay", "az", "gx", "gy", "gz"], rows)

    found = import_recording(files(tmp_path, walk(), apart))
    same(found.left, walk()["left"])


def test_several_sensors_of_a_kind_are_not_guessed(tmp_path):
    def two(series):
        cells = values(series)
        rows = [[k / 100, *row, *row[:3]] for k, row in enumerate(cells)]
        return table(
            ["t", "ax", "ay", "az", "gx", "gy", "gz", "acc_low_x", "acc_low_y", "acc_low_z"], rows
        )

    options = files(tmp_path, walk(), two)
    with pytest.raises(RecordingError, match=r"several columns of the force.*ax=NAME"):
        import_recording(options)


def test_what_was_assumed_travels_with_the_recording(tmp_path):
    found = import_recording(files(tmp_path, walk(), plain))
    told = {(a.foot, a.subject): a for a in from_note(found.notes["assumptions"])}
    assert told["left", "specific force"].value.startswith("m/s^2")
    assert told["right", "angular rate"].value.startswith("rad/s")
    assert told["left", "time"].value == "t, in s"
    assert {str(a.origin) for a in told.values()} == {"values", "motion"}
