"""Importers: units, axes and wrapping counters made explicit, damage said, real files read."""

from dataclasses import replace

import numpy as np
import pytest
from drivers.frames import stream
from hypothesis import given
from hypothesis import strategies as st
from scipy.io import savemat

from dualfoot_ros.core import ImuSeries, Increments
from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.recording import RecordingError, Topics, write_bag
from dualfoot_ros.recording.importers import (
    FORMATS,
    ImportOptions,
    import_recording,
    read_sensor,
)
from dualfoot_ros.recording.importers.dual_feet_walks import reference_of
from dualfoot_ros.recording.importers.sample_counter import same_wrap, unwrap_us

from ..samples import recording

STEP_US = 16667
HEADER = """\
DeviceTag:,{tag},,,
FirmwareVersion:,2.2.1,,,
SyncStatus:,Un-synced,,,
OutputRate:,60Hz,,,
StartTime:,2022-08-03 13:45:13.419 +0300,,,
,,,,
"""
COLUMNS = "PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z,Mag_X,Mag_Y,Mag_Z"


def walk(path, *, start=1000, count=20, shape="rec", direction=1, dtype=np.float64, **changes):
    """Write a walk as the data set has it; each sample holds its own number."""
    number = np.arange(count, dtype=float)[:, None]
    counter = (start + np.arange(count) * STEP_US + 2**31) % 2**32 - 2**31
    counter = counter if dtype is np.int32 else counter % 2**32
    foot = {
        "acc": number + np.array([1.0, 2.0, 3.0]),
        "gyros": number + np.array([0.1, 0.2, 0.3]),
        "mag": number + np.array([1e4, 2e4, 3e4]),
        "sT": counter.astype(dtype)[:, None],
    } | changes
    savemat(path, {"imu0L": foot, "imu0R": foot, "pathshape": shape, "pathdirec": direction})
    return path


def export(path, *, start=5000, count=20, tag="A", rows=None, columns=COLUMNS, prefix=""):
    """Write an export as the app does; each sample holds its own number."""
    lines = rows or [
        f"{k}, {(start + k * STEP_US) % 2**32}, {k + 1}, {k + 2}, {k + 3}, "
        f"{10 + k}, {20 + k}, {30 + k}, 0.1, 0.2, 0.9"
        for k in range(count)
    ]
    path.write_text(prefix + HEADER.format(tag=tag) + "\n".join([columns, *lines]) + "\n")
    return path


@pytest.fixture
def pair(tmp_path):
    """Return a left and a right export."""
    return export(tmp_path / "L.csv", tag="B"), export(tmp_path / "R.csv", start=7000)


def test_a_walk_of_the_data_set_comes_out_forward_left_up_in_si_units(tmp_path):
    found = import_recording(ImportOptions((walk(tmp_path / "w.mat"),)))
    left = found.left
    assert left.stamp_ns.tolist() == [(1000 + k * STEP_US) * 1000 for k in range(20)]
    assert left.specific_force[4].tolist() == [6.0, -5.0, 7.0]  # forward = y, left = -x, up = z
    assert np.allclose(left.angular_rate[0], [0.2, -0.1, 0.3])
    assert np.allclose(left.magnetic_field[0], [20e-6, -10e-6, 30e-6])


@pytest.mark.parametrize("dtype", [np.int32, np.float64])
def test_a_counter_that_wraps_goes_on(tmp_path, dtype):
    path = walk(tmp_path / "w.mat", start=2**31 - 5 * STEP_US, dtype=dtype)
    stamps = import_recording(ImportOptions((path,))).left.stamp_ns
    assert (np.diff(stamps) == STEP_US * 1000).all()
    assert stamps[0] == (2**31 - 5 * STEP_US) * 1000


@given(st.integers(0, 2**32 - 1), st.lists(st.integers(-(2**31) + 1, 2**31 - 1), max_size=40))
def test_unwrapping_gives_back_every_step_shorter_than_half_a_wrap(start, steps):
    true = start + np.concatenate(([0], np.cumsum(steps, dtype=np.int64)))
    assert np.array_equal(unwrap_us(true % 2**32), true * 1000)
    signed = (true + 2**31) % 2**32 - 2**31
    assert np.array_equal(unwrap_us(signed), true * 1000)


@given(st.integers(0, 2**32 - 1), st.integers(-(10**9), 10**9))
def test_feet_that_start_on_two_sides_of_a_wrap_stay_together(start, offset):
    left, right = unwrap_us([start]), unwrap_us([(start + offset) % 2**32])
    left, right = same_wrap(left, right)
    assert right[0] - left[0] == offset * 1000
    assert min(left[0], right[0]) >= 0


def test_the_rectangle_has_a_marker_for_each_stance_and_is_mirrored_when_clockwise():
    ccw, cw = reference_of("rec", 1), reference_of("rec", -1)
    points = ccw.markers["right"]
    assert len(points) == 21
    assert points[8].tolist() == pytest.approx([0.0, 9.6, 0.0])
    assert points[10].tolist() == pytest.approx([-2.4, 9.6, 0.0])
    assert np.allclose(cw.markers["right"], points * [-1, 1, 1])
    assert ccw.closed_loop
    assert ccw.length_m == pytest.approx(24.0)


@pytest.mark.parametrize("shape", ["rec", "8"])
def test_markers_are_one_spacing_apart_and_the_way_closes(shape):
    points = reference_of(shape, 1).markers["right"]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert np.allclose(steps, 1.2)
    assert np.allclose(points[0], points[-1])


def test_a_lap_is_known_to_close_and_an_unknown_shape_is_not_guessed():
    assert reference_of("O", -1).length_m == 400.0
    assert not reference_of("O", -1).markers
    assert reference_of("triangle", 1) is None


def test_a_pair_of_exports_comes_out_in_si_units_with_its_stamps(pair):
    found = import_recording(ImportOptions(left=pair[0], right=pair[1]))
    assert found.right.stamp_ns.tolist() == [(7000 + k * STEP_US) * 1000 for k in range(20)]
    assert found.left.specific_force[2].tolist() == [3.0, 4.0, 5.0]
    assert np.allclose(found.left.angular_rate[0], np.deg2rad([10.0, 20.0, 30.0]))
    assert found.left.magnetic_field is None
    assert found.notes["sync_status"] == "left Un-synced, right Un-synced"
    assert found.notes["device_tag"] == "left B, right A"


def test_axes_turn_a_device_into_the_body_and_the_field_comes_when_its_unit_is_given(pair):
    options = ImportOptions(left=pair[0], right=pair[1], axes="+y-x+z", field_scale=5e-5)
    left = import_recording(options).left
    assert left.specific_force[0].tolist() == [2.0, -1.0, 3.0]
    assert np.allclose(left.magnetic_field[0], [1e-5, -5e-6, 4.5e-5])


def test_exports_with_a_separator_line_or_semicolons_are_read(tmp_path, pair):
    plain = import_recording(ImportOptions(left=pair[0], right=pair[1]))
    marked = export(tmp_path / "S.csv", prefix="sep=,\n")
    semicolons = tmp_path / "C.csv"
    semicolons.write_text(pair[1].read_text().replace(",", ";"))
    found = import_recording(ImportOptions(left=marked, right=semicolons))
    assert np.array_equal(found.left.specific_force, plain.left.specific_force)
    assert np.array_equal(found.right.stamp_ns, plain.right.stamp_ns)


@pytest.mark.parametrize("change", ["0.5, {}", "{}, 0.5"])
def test_a_row_with_a_cell_too_many_is_refused_and_not_read_shifted(tmp_path, change, pair):
    lines = pair[0].read_text().splitlines()
    for at in (-3, -7):
        lines[at] = change.format(lines[at])
    pair[0].write_text("\n".join(lines))
    number = len(lines) - 6
    said = rf"L.csv.*line {number} has 12 cells .* 11 columns \(such rows: 2\)"
    with pytest.raises(RecordingError, match=said):
        import_recording(ImportOptions(left=pair[0], right=pair[1]))


def test_a_row_with_a_cell_too_few_is_refused_and_not_read_shifted(tmp_path, pair):
    lines = pair[0].read_text().splitlines()
    lines[-3] = ",".join(lines[-3].split(",")[1:])
    pair[0].write_text("\n".join(lines))
    with pytest.raises(RecordingError, match="has 10 cells where the header names 11 columns"):
        import_recording(ImportOptions(left=pair[0], right=pair[1]))


def test_empty_cells_at_the_end_of_rows_say_nothing(tmp_path, pair):
    plain = import_recording(ImportOptions(left=pair[0], right=pair[1])).left
    pair[0].write_text(pair[0].read_text().replace("0.9\n", "0.9,,\n"))
    padded = import_recording(ImportOptions(left=pair[0], right=pair[1])).left
    assert np.array_equal(padded.specific_force, plain.specific_force)


def test_an_offset_moves_the_right_foot_only(pair):
    options = ImportOptions(left=pair[0], right=pair[1], right_offset_s=162.490736)
    found = import_recording(options)
    assert found.left.stamp_ns[0] == 5_000_000
    assert found.right.stamp_ns[0] == 7_000_000 + 162_490_736_000


def test_axes_are_those_that_point_forward_left_and_up(pair):
    plain, turned = (
        import_recording(ImportOptions(left=pair[0], right=pair[1], axes=axes)).left
        for axes in ("+x+y+z", "+y-x+z")
    )
    expected = plain.specific_force[:, [1, 0, 2]] * [1, -1, 1]
    np.testing.assert_array_equal(turned.specific_force, expected)


def test_axes_that_are_none_are_refused(pair):
    with pytest.raises(ConfigError, match=r"axes are '\+x-y\+z': they mirror the sensor"):
        import_recording(ImportOptions(left=pair[0], right=pair[1], axes="+x-y+z"))


def test_what_is_wrong_with_an_export_is_said(tmp_path, pair):
    left, right = pair
    no_force = export(tmp_path / "a.csv", columns=COLUMNS.replace("Acc", "FreeAcc"))
    text = export(tmp_path / "b.csv", rows=["1, 2, x, 4, 5, 6, 7, 8, 9, 9, 9"])
    short = export(tmp_path / "c.csv", rows=["1, 2, 3", "2, 3, 4"])
    none = export(tmp_path / "d.csv", count=0, rows=[" "])
    other = tmp_path / "e.csv"
    other.write_text("time,x,y\n1,2,3\n")
    for broken, sentence in [
        (no_force, r"no specific force: it holds free acceleration \(gravity taken out\)"),
        (text, "is damaged"),
        (short, "is damaged"),
        (none, "no sample"),
        (other, "no specific force and no angular rate: it holds the columns 'time', 'x', 'y'"),
    ]:
        with pytest.raises(RecordingError, match=f"{broken.name}.*{sentence}"):
            import_recording(ImportOptions(left=broken, right=right))
    with pytest.raises(RecordingError, match="give --left FILE and --right FILE"):
        import_recording(ImportOptions((left, right)))
    with pytest.raises(RecordingError, match="give --left FILE and --right FILE"):
        import_recording(ImportOptions(left=left))


def test_what_is_wrong_with_a_walk_is_said(tmp_path):
    garbage = tmp_path / "g.mat"
    garbage.write_bytes(b"not a mat file at all" * 20)
    short = walk(tmp_path / "s.mat", acc=np.zeros((7, 3)))
    nan = walk(tmp_path / "n.mat", sT=np.full((20, 1), np.nan))
    strange = tmp_path / "x.mat"
    savemat(strange, {"something": 1})
    for path, sentence in [
        (garbage, "no readable .mat"),
        (short, r"'imu0L.acc' is of shape \(7, 3\); with 20 stamps"),
        (nan, "not finite"),
        (strange, "has no 'imu0L.sT'"),
    ]:
        with pytest.raises(RecordingError, match=sentence):
            import_recording(ImportOptions((path,)))
    good = walk(tmp_path / "w.mat")
    with pytest.raises(RecordingError, match="exactly one"):
        import_recording(ImportOptions((good, good)))


def test_sources_of_no_known_format_are_refused_with_the_known_ones(tmp_path):
    other = tmp_path / "walk.xyz"
    other.write_text("")
    for options, name, sentence in [
        (ImportOptions(), "auto", "no source given"),
        (ImportOptions((tmp_path / "none.mat",)), "auto", "there is no file"),
        (
            ImportOptions((other,)),
            "auto",
            r"'\*.xyz' are of no known format; known are dual-feet: .mat; rosbag: folder",
        ),
        (ImportOptions((other,)), "tape", "format is 'tape'; allowed is auto, dual-feet"),
    ]:
        with pytest.raises(RecordingError, match=sentence):
            import_recording(options, name)


def test_a_bag_with_other_topics_axes_and_units_comes_out_as_it_should_be(tmp_path):
    good = recording()
    wild = {
        foot: ImuSeries(
            good.imu(foot).stamp_ns,
            good.imu(foot).specific_force[:, [1, 0, 2]] * [-1, 1, 1] / 9.80665,
            np.rad2deg(good.imu(foot).angular_rate[:, [1, 0, 2]] * [-1, 1, 1]),
        )
        for foot in ("left", "right")
    }
    default = Topics()
    topics = Topics(replace(default.left, imu="/a"), replace(default.right, imu="/b"))
    source = write_bag(tmp_path / "wild", replace(good, **wild), topics=topics)
    options = ImportOptions(
        (source,),
        axes="+y-x+z",
        left_topic="/a",
        right_topic="/b",
        force_unit="g",
        rate_unit="deg/s",
    )
    tamed = import_recording(options)
    for foot in ("left", "right"):
        assert np.array_equal(tamed.imu(foot).stamp_ns, good.imu(foot).stamp_ns)
        assert np.allclose(tamed.imu(foot).specific_force, good.imu(foot).specific_force)
        assert np.allclose(tamed.imu(foot).angular_rate, good.imu(foot).angular_rate)
    assert tamed.reference.length_m == good.reference.length_m
    with pytest.raises(RecordingError, match=r"has no topic '/c'; .* are: /a, /b"):
        import_recording(replace(options, left_topic="/c"))
    with pytest.raises(RecordingError, match="force unit is 'lb'; allowed is one of m/s"):
        import_recording(replace(options, force_unit="lb"))


def test_every_format_loads_by_its_name(tmp_path, pair):
    sources = {
        "dual-feet": ImportOptions((walk(tmp_path / "w.mat"),)),
        "xsens-dot": ImportOptions(left=pair[0], right=pair[1]),
    }
    bag = write_bag(tmp_path / "bag", import_recording(sources["xsens-dot"]))
    sources["rosbag"] = ImportOptions((bag,))
    for first, foot in enumerate(("left", "right")):
        (tmp_path / f"{foot}.ximu3").write_bytes(stream("ximu3", 20, first=first))
    sources["capture"] = ImportOptions(
        left=tmp_path / "left.ximu3", right=tmp_path / "right.ximu3"
    )
    sources["csv"] = sources["xsens-dot"]
    for known in FORMATS:
        if known.preset not in ("", "xsens-dot"):  # these layouts have tests of their own
            continue
        for name in (known.name, "auto"):
            loaded = import_recording(sources[known.name], name)
            assert len(loaded.left) == 20
            averaged = known.name == "capture"  # of an x-IMU3; the others are from Xsens DOT
            kind = Increments.AVERAGED if averaged else Increments.COMPENSATED
            assert loaded.right.increments is kind
    sampled = import_recording(replace(sources["rosbag"], increments="sampled"))
    assert sampled.left.increments is Increments.SAMPLED
    with pytest.raises(RecordingError, match="increments is 'smooth'; allowed is auto, compens"):
        import_recording(replace(sources["rosbag"], increments="smooth"))


def test_every_real_walk_imports_with_both_feet_standing_at_the_start(dual_feet):
    from dualfoot_ros.inspection.findings import findings_of

    walks = sorted(dual_feet.glob("*/*.mat"))
    assert walks
    for path in walks:
        found = import_recording(ImportOptions((path,)))
        objections = {finding.kind for finding in findings_of(found)}
        assert objections == ({"no_overlap"} if "unsynchronised" in str(path) else set()), path
        assert found.reference.closed_loop
        norm = np.linalg.norm(found.right.magnetic_field, axis=1).mean()
        assert 20e-6 < norm < 80e-6


def test_real_exports_read_gravity_on_the_axis_they_are_named_after(dual_feet):
    for path in sorted((dual_feet / "calibration").glob("*.csv")):
        foot = read_sensor(path)
        axis, sign = "xyz".index(path.stem[1]), 1.0 if path.stem[2] == "u" else -1.0
        mean = np.median(foot.specific_force, axis=0)
        assert mean[axis] * sign == pytest.approx(9.8, abs=0.4), path
        assert np.abs(np.median(foot.angular_rate, axis=0)).max() < 0.1
        assert foot.rate_hz == pytest.approx(60.0, abs=0.01)
