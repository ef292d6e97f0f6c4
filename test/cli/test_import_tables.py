"""`dualfoot import` on tables as users have them, and files in place of bags in other verbs."""

import json

import numpy as np
import pytest
from recording.importers.made_up import table, values, walk

from dualfoot_ros.recording import read_bag

NAMES = ["PacketCounter", "SampleTimeFine", "Acc_X", "Acc_Y", "Acc_Z", "Gyr_X", "Gyr_Y", "Gyr_Z"]
HEADER = (
    "sep=,",
    "DeviceTag:,A",
    "SyncStatus:,Synced",
    "OutputRate:,100Hz",
    "Measurement Mode:,Rate quantities",
    "",
)


def dot(series, *, force="m/s^2", rate="deg/s", ticks=1000, names=NAMES, header=HEADER):
    """Return an export of the DOT app in these units, its time in ticks of so many ns."""
    rows = [
        [str(k), str(t // ticks), *row]
        for k, (t, row) in enumerate(
            zip(series.stamp_ns.tolist(), values(series, force, rate), strict=True), start=1
        )
    ]
    return table(names, rows, before=header)


def quoted(series):
    """Return an export with names in quotes and no header."""
    return dot(series, names=[f'"{name}"' for name in NAMES], header=())


def tabbed(series):
    """Return an export with tabs."""
    return dot(series).replace(",", "\t")


def float_counters(series):
    """Return an export that went through a data frame: 1 became 1.0."""
    lines = dot(series).splitlines()
    start = len(HEADER) + 1
    whole = [line.split(",") for line in lines[start:]]
    rows = [",".join([f"{cells[0]}.0", f"{cells[1]}.0", *cells[2:]]) for cells in whole]
    return "\n".join([*lines[:start], *rows]) + "\n"


def sdk(series):
    """Return a log of the PC SDK."""
    rows = [
        [str(t // 100_000), *row]
        for t, row in zip(series.stamp_ns.tolist(), values(series, rate_unit="deg/s"), strict=True)
    ]
    return table(NAMES[1:], rows, before=["DeviceTag: X,OutputRate: 100,Measurement Mode: Rate"])


def generic(series):
    """Return a table of seconds, g and deg/s, the units in the names."""
    names = ["Time (s)", *(f"Gyroscope {a} (deg/s)" for a in "XYZ")]
    names += [f"Accelerometer {a} (g)" for a in "XYZ"]
    cells = values(series, "g", "deg/s")
    stamps = series.stamp_ns / 1e9
    return table(names, [[t, *c[3:], *c[:3]] for t, c in zip(stamps, cells, strict=True)])


def write(folder, make, feet=None):
    """Write a file for each foot; return the arguments that name them."""
    arguments = []
    for foot, series in (feet or walk()).items():
        (folder / f"{foot}.csv").write_text(make(series), encoding="utf-8")
        arguments += [f"--{foot}", f"{foot}.csv"]
    return arguments


def check(bag, count=900):
    """Assert that a bag holds the walk in SI, at 100 Hz."""
    for foot, series in walk().items():
        imu = read_bag(bag).imu(foot)
        assert len(imu) == count
        assert imu.rate_hz == pytest.approx(100.0, rel=0.01)
        np.testing.assert_allclose(imu.specific_force, series.specific_force[:count], atol=2e-4)
        np.testing.assert_allclose(imu.angular_rate, series.angular_rate[:count], atol=2e-4)


MAKES = {
    "ticks of 0.1 ms under a header that tells the rate": lambda s: dot(s, ticks=100_000),
    "tabs": tabbed,
    "names in quotes": quoted,
    "no counter, header in one line": sdk,
    "counters as floats": float_counters,
    "seconds, g and deg/s": generic,
}


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_a_table_is_imported_without_a_further_option(tmp_path, make, dualfoot):
    done = dualfoot("import", *write(tmp_path, make), "-o", "walk", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    check(tmp_path / "walk")


def test_a_cut_last_row_is_left_out_and_said_once_a_foot(tmp_path, dualfoot):
    arguments = write(tmp_path, lambda series: dot(series)[:-30])
    done = dualfoot("import", *arguments, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 0
    assert done.stderr.count("last row: left out, it was cut") == 2
    assert len(done.stderr.splitlines()) == 2
    check(tmp_path / "walk", 899)


def test_rates_57_times_too_small_are_refused_until_the_unit_is_given(tmp_path, dualfoot):
    arguments = write(tmp_path, lambda series: dot(series, rate="rad/s"))
    done = dualfoot("import", *arguments, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 2
    assert "the gyro does not fit the accelerometer; give --rate-unit rad/s" in done.stderr
    assert not (tmp_path / "walk").exists()
    dualfoot("import", *arguments, "--rate-unit", "rad/s", "-o", "walk", cwd=tmp_path)
    check(tmp_path / "walk")


def test_a_unit_that_is_insisted_on_is_taken_with_a_warning(tmp_path, dualfoot):
    arguments = write(tmp_path, lambda series: dot(series, rate="rad/s"))
    done = dualfoot("import", *arguments, "--rate-unit", "deg/s", "-o", "walk", cwd=tmp_path)
    assert done.returncode == 0
    assert "left foot: angular rate: deg/s" in done.stderr
    assert "57 times too small" in done.stderr


def test_a_force_in_g_is_read_with_its_unit_and_named_without(tmp_path, dualfoot):
    arguments = write(tmp_path, lambda series: dot(series, force="g"))
    done = dualfoot("import", *arguments, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 2
    assert "so it is in g; give --force-unit g" in done.stderr
    dualfoot("import", *arguments, "--force-unit", "g", "-o", "walk", cwd=tmp_path)
    check(tmp_path / "walk")


def test_the_same_samples_twice_are_refused(tmp_path, dualfoot):
    series = walk()["left"]
    arguments = write(tmp_path, dot, {"left": series, "right": series})
    done = dualfoot("import", *arguments, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 2
    assert "both feet hold the same samples" in done.stderr


def test_what_was_assumed_is_one_table_before_anything_is_written(tmp_path, dualfoot):
    done = dualfoot("import", *write(tmp_path, generic), "-o", "walk", cwd=tmp_path)
    lines = done.stdout.splitlines()
    assert lines[0].split() == ["foot", "what", "taken", "as", "by"]
    told = [line for line in lines if "specific force" in line or "angular rate" in line]
    assert all("name of the column" in line for line in told)
    assert lines.index("wrote walk") > lines.index(told[-1])
    assert "name of the column" in read_bag(tmp_path / "walk").notes["assumptions"]


def test_a_layout_that_was_saved_reads_the_next_file_of_the_kind(tmp_path, dualfoot):
    names = ["when", *(f"f{k}" for k in range(3)), *(f"r{k}" for k in range(3))]
    columns = "time=when,ax=f0,ay=f1,az=f2,gx=r0,gy=r1,gz=r2"

    def strange(series):
        stamps = series.stamp_ns / 1e6
        cells = values(series, "g", "deg/s")
        rows = [[t, *row] for t, row in zip(stamps, cells, strict=True)]
        return table(names, rows, delimiter=";", decimal=",")

    arguments = write(tmp_path, strange)
    refused = dualfoot("import", *arguments, "-o", "walk", cwd=tmp_path)
    assert refused.returncode == 2
    assert "'f0', 'f1', 'f2'" in refused.stderr and "--columns" in refused.stderr
    options = ["--columns", columns, "--save-layout", "mine.yaml"]
    done = dualfoot("import", *arguments, *options, "-o", "walk", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    check(tmp_path / "walk")
    done = dualfoot("import", *arguments, "--layout", "mine.yaml", "-o", "two", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    check(tmp_path / "two")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--columns", "ax"], "allowed is ROLE=COLUMN"),
        (["--columns", "speed=Acc_X"], "with ROLE one of time, counter"),
        (["--columns", "ax=Acc"], "has no column 'Acc'"),
        (["--rate", "-1"], "--rate is -1"),
        (["--skip", "-1"], "--skip is -1"),
        (["--time-unit", "s"], "it would be 100 Hz in us"),
        (["--layout", "no.yaml"], "No such file"),
        (["--layout", "left.csv"], "'left.csv' is no"),
    ],
)
def test_an_option_that_cannot_be_is_refused_in_a_sentence(tmp_path, options, sentence, dualfoot):
    arguments = write(tmp_path, dot)
    done = dualfoot("import", *arguments, *options, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 2
    assert sentence in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_files_in_place_of_a_bag_give_what_the_bag_gives(tmp_path, dualfoot):
    files = write(tmp_path, generic)
    dualfoot("import", *files, "-o", "walk", cwd=tmp_path)
    by_bag = dualfoot("info", "walk", "--json", cwd=tmp_path)
    by_files = dualfoot("info", *files, "--json", cwd=tmp_path)
    assert by_files.returncode == by_bag.returncode
    assert json.loads(by_files.stdout)["feet"] == json.loads(by_bag.stdout)["feet"]
    assert "taken as" in by_files.stderr
    for verb in ("evaluate", "sync"):
        one, two = (dualfoot(verb, *what, "--json", cwd=tmp_path) for what in (["walk"], files))
        assert one.returncode == two.returncode
        if one.returncode == 0:
            facts = [json.loads(done.stdout) for done in (one, two)]
            assert facts[0].pop("bag") != facts[1].pop("bag")
            assert facts[0].keys() == facts[1].keys()


@pytest.mark.parametrize("verb", [["info"], ["sync"], ["evaluate"], ["calibrate", "spacing"]])
def test_a_verb_that_takes_files_takes_the_options_that_its_refusal_names(
    tmp_path, verb, dualfoot
):
    files = write(tmp_path, lambda series: generic(series).replace("Time", "Column"))
    done = dualfoot(*verb, *files, cwd=tmp_path)
    assert done.returncode == 2
    assert "give the column with --columns time=NAME, or the sampling rate" in done.stderr
    done = dualfoot(
        *verb, *files, "--columns", "time=Column (s)", "--time-unit", "s", cwd=tmp_path
    )
    assert "Column (s), in s" in done.stderr


def test_neither_a_bag_nor_files_is_a_sentence(tmp_path, dualfoot):
    done = dualfoot("info", cwd=tmp_path)
    assert done.returncode == 2
    assert "no recording given; allowed is BAG, or --left FILE --right FILE" in done.stderr
    done = dualfoot("info", "--left", "left.csv", cwd=tmp_path)
    assert done.returncode == 2
    assert "--right FILE is missing; allowed is BAG, or --left FILE" in done.stderr


def test_the_topics_of_a_bag_are_refused_with_tables(tmp_path, dualfoot):
    done = dualfoot("info", *write(tmp_path, generic), "--left-topic", "/a", cwd=tmp_path)
    assert done.returncode == 2
    assert "--left-topic does not apply to the format csv; it is for rosbag" in done.stderr


def test_a_table_of_a_sensor_at_rest_calibrates(tmp_path, dualfoot):
    still = walk(count=3000, stand=3000)["left"]
    (tmp_path / "rest.csv").write_text(generic(still))
    done = dualfoot("calibrate", "gyro", "rest.csv", "-o", "c.yaml", "--no-plots", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "gyro" in (tmp_path / "c.yaml").read_text()
