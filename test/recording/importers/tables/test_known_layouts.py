"""Every known layout, on a made-up file in its public form: recognised, in SI, on one clock."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import Increments
from dualfoot_ros.recording import RecordingError
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.recording.importers.tables import LAYOUTS, Layout

from ..made_up import FEET, same, table, values, walk

XYZ = "XYZ"
DOT_HEADER = (
    "sep=,",
    "DeviceTag:,{foot}",
    "FirmwareVersion:,3.0.0",
    "SyncStatus:,Synced",
    "OutputRate:,100Hz",
    "Measurement Mode:,{mode}",
    "StartTime: ,2025-01-01_10:00:00_000 CET",
    "© Movella Technologies B. V. 2005-2025",
    "",
)


def rows_of(*columns):
    """Return the rows of columns (N,) and (N, K)."""
    blocks = [
        c if isinstance(c, list) or np.ndim(c) == 2 else np.asarray(c)[:, None] for c in columns
    ]
    return [
        [cell for block in blocks for cell in (block[k] if np.ndim(block[k]) else [block[k]])]
        for k in range(len(blocks[0]))
    ]


def pair(folder, write, ending=".csv"):
    """Write a file for each foot with ``write(series, foot)``; return the options."""
    files = {}
    for foot, series in walk().items():
        files[foot] = folder / f"{foot}{ending}"
        files[foot].write_text(write(series, foot), encoding="utf-8")
    return ImportOptions(**files)


def dot_app(mode, names, cells):
    """Return a writer of exports of the Xsens DOT app."""

    def write(series, foot):
        before = [line.format(foot=foot, mode=mode) for line in DOT_HEADER]
        count = np.arange(1, len(series) + 1)
        rows = rows_of(count, series.stamp_ns // 1000 % 2**32, cells(series))
        return table(["PacketCounter", "SampleTimeFine", *names], rows, before=before)

    return write


def axes(*groups):
    """Return "Acc_X", "Acc_Y" ... for groups of columns."""
    return [f"{group}_{axis}" for group in groups for axis in XYZ]


def dot_rates(series):
    """Return forces and rates as the DOT exports them."""
    return values(series, "m/s^2", "deg/s")


def with_quaternion(series):
    """Return a quaternion before forces and rates."""
    return np.hstack([np.tile([1.0, 0.0, 0.0, 0.0], (len(series), 1)), dot_rates(series)])


def increments(series):
    """Return dq (w, x, y, z) and dv over an interval of 10 ms, rates held constant."""
    half = 0.005 * series.angular_rate
    angle = np.linalg.norm(half, axis=1)[:, None]
    dq = np.hstack([np.cos(angle), half * np.sinc(angle / np.pi)])
    return [
        [*(f"{v:.9f}" for v in q), *(f"{v:.9f}" for v in 0.01 * f)]
        for q, f in zip(dq, series.specific_force, strict=True)
    ]


DQ = ["dq_W", "dq_X", "dq_Y", "dq_Z", "dv[1]", "dv[2]", "dv[3]"]
DOT_MODES = {
    "Rate quantities (without mag)": (axes("Acc", "Gyr"), dot_rates),
    "Custom Mode 5": (["Quat_W", *axes("Quat", "Acc", "Gyr")], with_quaternion),
    "Delta quantities (without mag)": (DQ, increments),
    "High Fidelity (without mag)": (DQ, increments),
}


@pytest.mark.parametrize("mode", DOT_MODES)
def test_every_mode_of_the_dot_app_that_holds_rates_and_forces_is_read(tmp_path, mode):
    options = pair(tmp_path, dot_app(mode, *DOT_MODES[mode]))
    found = import_recording(options)
    assert found.notes["format"] == "xsens-dot"
    assert found.notes["device_tag"] == "left left, right right"
    for foot, series in walk().items():
        same(found.imu(foot), series)


@pytest.mark.parametrize(
    ("mode", "names", "sentence"),
    [
        ("Orientation (Quaternion)", ["Quat_W", *axes("Quat")], "it holds quaternions only"),
        ("Orientation (Euler)", axes("Euler"), "it holds Euler angles only"),
        (
            "Extended (Quaternion)",
            ["Quat_W", *axes("Quat", "FreeAcc")],
            r"quaternions and free acceleration \(gravity taken out\) only",
        ),
        ("Custom Mode 1", axes("Euler", "FreeAcc", "Gyr"), "has no specific force: it holds"),
        ("Custom Mode 3", ["Quat_W", *axes("Quat", "Gyr")], "quaternions and angular rates only"),
    ],
)
def test_a_mode_that_lacks_a_quantity_is_named_with_what_it_has(tmp_path, mode, names, sentence):
    write = dot_app(mode, names, lambda series: np.ones((len(series), len(names))) * 0.5)
    with pytest.raises(RecordingError, match=sentence) as error:
        import_recording(pair(tmp_path, write))
    assert mode in str(error.value)
    assert "delta quantities or high fidelity" in str(error.value)


def dot_sdk(series, foot):
    """Return a log of the PC SDK: ticks of 0.1 ms, no counter, the header in one line."""
    before = [f"DeviceTag: {foot},OutputRate: 100,Measurement Mode: Rate quantities"]
    rows = rows_of(series.stamp_ns // 100_000, dot_rates(series))
    return table(["SampleTimeFine", *axes("Acc", "Gyr")], rows, before=before)


def mt_manager(series, _foot):
    """Return a text export of MT Manager: tabs, rad/s, ticks of 0.1 ms."""
    before = ["// Start Time: Unknown", "// Sample rate: 100.0Hz", "// Scenario: 4.9"]
    count = np.arange(65000, 65000 + len(series)) % 65536
    rows = rows_of(count, series.stamp_ns // 100_000, values(series))
    names = ["PacketCounter", "SampleTimeFine", *axes("Acc", "Gyr")]
    return table(names, rows, before=before, delimiter="\t")


def awinda(series, _foot):
    """Return an Awinda export: no time, a counter of 16 bits, increments besides."""
    before = ["// Start Time: Unknown", "// Update Rate: 100.0Hz", "// Filter Profile: human"]
    count = np.arange(65000, 65000 + len(series)) % 65536
    empty = [[""] for _ in range(len(series))]
    rows = rows_of(count, empty, values(series), 0.01 * series.specific_force)
    names = ["PacketCounter", "SampleTimeFine", *axes("Acc", "Gyr", "VelInc")]
    return table(names, rows, before=before, delimiter="\t")


def shimmer(series, _foot):
    """Return an export of Consensys: two accelerometers, a line of units."""
    low = np.clip(series.specific_force, -19.6, 19.6)
    parts = [f"Shimmer_8665_{n}_{a}_CAL" for n in ("Accel_LN", "Accel_WR", "Gyro") for a in XYZ]
    units = ["ms", *["m/(s^2)"] * 6, *["deg/s"] * 3]
    rows = rows_of(1.7e12 + series.stamp_ns / 1e6, low, values(series, "m/s^2", "deg/s"))
    names = ["Shimmer_8665_Timestamp_Unix_CAL", *parts]
    return table(names, rows, delimiter="\t", before=['"sep=\t"'], units=units)


def physilog(series, _foot):
    """Return an export of a Physilog 5: five lines before the names, a line of units."""
    before = ["GaitUp Physilog 5", "Version,1.2", "Serial,123", "Start,10:00:00", "Rate,100"]
    names = ["Time", *(f"Gyro {a}" for a in XYZ), *(f"Accel {a}" for a in XYZ)]
    units = ["s", *["deg/s"] * 3, *["g"] * 3]
    cells = values(series, "g", "deg/s")
    rows = rows_of(series.stamp_ns / 1e9, cells[:, 3:], cells[:, :3])
    return table(names, rows, before=before, units=units)


def opal(series, _foot):
    """Return an export of an APDM Opal: microseconds since 1970."""
    names = ["Time", *(f"{n} {a}" for n in ("Accelerometer", "Gyroscope") for a in XYZ)]
    rows = rows_of(1_700_000_000_000_000 + series.stamp_ns // 1000, values(series))
    return table(names, rows, before=["APDM Opal, sensor 1234"])


def x_imu(series, _foot):
    """Return CalInertialAndMag.csv of an x-IMU, of which the packet number counts all packets."""
    cells = values(series, "g", "deg/s")
    names = ["Packet number", *(f"Gyroscope {a} (deg/s)" for a in XYZ)]
    names += [f"Accelerometer {a} (g)" for a in XYZ]
    return table(names, rows_of(np.arange(len(series)) * 3, cells[:, 3:], cells[:, :3]))


def realsense(series, _foot):
    """Return rows of rs-convert: gyro and accelerometer in blocks, device time in us."""
    names = ["Stream Type", "F#", "HW Timestamp (ms)", "Backend Timestamp(ms)"]
    names += ["Host Timestamp(ms)", "3DOF_x", "3DOF_y", "3DOF_z"]
    blocks = []
    for stream, vectors in (("Gyro", series.angular_rate), ("Accel", series.specific_force)):
        kinds = [[stream]] * len(series)
        stamps = series.stamp_ns // 1000
        rows = rows_of(kinds, np.arange(len(series)), stamps, stamps, stamps, vectors)
        blocks.append("\n\n" + table(names, rows))
    return "".join(blocks)


ONE_FILE = {
    "xsens-dot": dot_sdk,
    "xsens-mt": mt_manager,
    "shimmer": shimmer,
    "physilog": physilog,
    "apdm-opal": opal,
    "realsense": realsense,
}


@pytest.mark.parametrize("name", ONE_FILE)
def test_a_layout_of_one_file_a_sensor_is_recognised_and_read(tmp_path, name):
    options = pair(tmp_path, ONE_FILE[name])
    found = import_recording(options)
    assert found.notes["format"] == name
    for foot, series in walk().items():
        same(found.imu(foot), series)
        by_name = import_recording(options, name).imu(foot)
        np.testing.assert_array_equal(by_name.stamp_ns, found.imu(foot).stamp_ns)


@pytest.mark.parametrize("name", ONE_FILE)
def test_what_the_samples_are_comes_from_the_maker_and_an_option_wins(tmp_path, name):
    options = replace(pair(tmp_path, ONE_FILE[name]), axes="y,-x,z")
    kind = Increments.COMPENSATED if name.startswith("xsens") else None
    assert import_recording(options).left.increments is kind
    sampled = import_recording(replace(options, increments="sampled"))
    assert {sampled.left.increments, sampled.right.increments} == {Increments.SAMPLED}


def test_an_awinda_export_gets_its_time_from_the_counter_and_the_update_rate(tmp_path):
    found = import_recording(pair(tmp_path, awinda, ".txt"))
    for foot, series in walk().items():
        same(found.imu(foot), series)


def test_an_x_imu_holds_no_time_so_the_rate_is_asked_for(tmp_path):
    options = pair(tmp_path, x_imu)
    with pytest.raises(RecordingError, match=r"no column of the time.*--rate HZ"):
        import_recording(options)
    found = import_recording(replace(options, layout=Layout(rate_hz=100.0)))
    assert found.notes["format"] == "x-imu"
    for foot, series in walk().items():
        same(found.imu(foot), series)


def triad(*names, unit=""):
    """Return the names of three columns."""
    return [f"{name} {axis}{f' ({unit})' if unit else ''}" for name in names for axis in XYZ]


def ngimu(folder, series):
    """Write sensors.csv of an NGIMU."""
    cells = values(series, "g", "deg/s")
    field = np.tile([20.0, 5.0, -40.0], (len(series), 1))
    names = ["Time (s)", *triad("Gyroscope", unit="deg/s"), *triad("Accelerometer", unit="g")]
    names += [*triad("Magnetometer", unit="uT"), "Barometer (hPa)"]
    pressure = np.full(len(series), 1013.25)
    rows = rows_of(series.stamp_ns / 1e9, cells[:, 3:], cells[:, :3], field, pressure)
    (folder / "sensors.csv").write_text(table(names, rows))
    (folder / "battery.csv").write_text("Time (s),Percentage (%)\n0,99\n1,99\n")


def x_imu3(folder, series):
    """Write Inertial.csv of an x-IMU3."""
    cells = values(series, "g", "deg/s")
    names = [
        "Timestamp (us)",
        *triad("Gyroscope", unit="deg/s"),
        *triad("Accelerometer", unit="g"),
    ]
    rows = rows_of(series.stamp_ns // 1000, cells[:, 3:], cells[:, :3])
    (folder / "Inertial.csv").write_text(table(names, rows))
    (folder / "Quaternion.csv").write_text("Timestamp (us),W,X,Y,Z\n1,1,0,0,0\n2,1,0,0,0\n")


def mbientlab(folder, series):
    """Write the two files of MetaBase."""
    cells = values(series, "g", "deg/s")
    stamps = 1_700_000_000_000 + series.stamp_ns // 1_000_000
    text = [["2024-01-01T10.00.00.000"]] * len(series)
    elapsed = (series.stamp_ns - series.stamp_ns[0]) / 1e9
    for sensor, unit, part in (
        ("Accelerometer", "g", slice(3)),
        ("Gyroscope", "deg/s", slice(3, 6)),
    ):
        names = ["epoc (ms)", "timestamp (+0000)", "elapsed (s)"]
        names += [f"{axis}-axis ({unit})" for axis in "xyz"]
        rows = rows_of(stamps, text, elapsed, cells[:, part])
        name = f"MetaWear_2024-01-01T10.00.00.000_C8DB_{sensor}_100.000Hz_1.7.3.csv"
        (folder / name).write_text(table(names, rows))


def sensor_logger(folder, series):
    """Write the files of Sensor Logger, which name z first."""
    start = 1_700_000_000_000_000_000
    gone = series.specific_force - [0.0, 0.0, 9.80665]
    for name, vectors in (
        ("TotalAcceleration", series.specific_force),
        ("Accelerometer", gone),
        ("Gyroscope", series.angular_rate),
    ):
        elapsed = (series.stamp_ns - series.stamp_ns[0]) / 1e9
        stamps = [[str(start + ns)] for ns in series.stamp_ns.tolist()]
        rows = rows_of(stamps, elapsed, vectors[:, ::-1])
        names = ["time", "seconds_elapsed", "z", "y", "x"]
        (folder / f"{name}.csv").write_text(table(names, rows))


def phyphox(folder, series):
    """Write the files of phyphox: numbers with exponents, quoted names."""
    for name, unit, vectors in (
        ("Accelerometer", "m/s^2", series.specific_force),
        ("Linear Accelerometer", "m/s^2", series.specific_force - [0.0, 0.0, 9.80665]),
        ("Gyroscope", "rad/s", series.angular_rate),
    ):
        names = ['"Time (s)"', *(f'"{axis} ({unit})"' for axis in XYZ)]
        stamps = (series.stamp_ns - series.stamp_ns[0]) / 1e9
        rows = [[f"{cell:.9E}" for cell in row] for row in rows_of(stamps, vectors)]
        (folder / f"{name}.csv").write_text(table(names, rows))


FOLDERS = {
    "ngimu": ngimu,
    "x-imu3": x_imu3,
    "mbientlab": mbientlab,
    "sensor-logger": sensor_logger,
    "phyphox": phyphox,
}


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_of_a_device_is_recognised_and_read(tmp_path, name):
    for foot, series in walk().items():
        (tmp_path / foot).mkdir()
        FOLDERS[name](tmp_path / foot, series)
    found = import_recording(ImportOptions(left=tmp_path / "left", right=tmp_path / "right"))
    assert found.notes["format"] == name
    for foot, series in walk().items():
        same(found.imu(foot), series)
    (tmp_path / "mine.yaml").write_text("a layout that was saved here makes no bag of it")
    both = import_recording(ImportOptions((tmp_path,)))
    np.testing.assert_array_equal(both.left.stamp_ns, found.left.stamp_ns)


def test_the_magnetic_field_comes_in_tesla_where_its_unit_is_known(tmp_path):
    for foot, series in walk().items():
        (tmp_path / foot).mkdir()
        ngimu(tmp_path / foot, series)
    found = import_recording(ImportOptions((tmp_path,)))
    np.testing.assert_allclose(found.left.magnetic_field[0], [20e-6, 5e-6, -40e-6])


def server_log(addresses):
    """Return a log of the DOT server: both devices in one file, their rows in turn."""
    names = ["Timestamp", "Address", *(f"{n}_{a}" for n in ("Acc", "Gyr", "Mag") for a in "xyz")]
    before = ["sep=,", "Measurement Mode:,Rate quantities (with mag)", "StartTime:,Mon, 2025"]
    feet = walk()
    rows = []
    for k in range(len(feet["left"])):
        for foot, address in zip(FEET, addresses, strict=True):
            series = feet[foot]
            stamp = series.stamp_ns[k] // 1000
            rows.append([stamp, address, *dot_rates(series[k : k + 1])[0], 0.3, 0.1, 0.9])
    return table(names, rows, before=before)


def test_both_devices_of_a_dot_server_log_are_read_when_it_is_told_which_is_which(tmp_path):
    file = tmp_path / "log.csv"
    file.write_text(server_log(("d4:22:cd:00:01", "d4:22:cd:00:02")))
    with pytest.raises(
        RecordingError, match=r"devices d4:22:cd:00:01, d4:22:cd:00:02.*--left-dev"
    ):
        import_recording(ImportOptions((file,)))
    devices = {"left_device": "d4:22:cd:00:01", "right_device": "d4:22:cd:00:02"}
    found = import_recording(ImportOptions((file,), **devices))
    assert found.notes["format"] == "dot-server"
    for foot, series in walk().items():
        same(found.imu(foot), series)


def test_every_layout_has_a_made_up_file_here():
    tried = {*ONE_FILE, *FOLDERS, "x-imu", "dot-server"}
    assert {layout.name for layout in LAYOUTS} == tried
