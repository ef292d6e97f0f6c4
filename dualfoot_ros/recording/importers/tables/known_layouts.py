"""The table of known layouts: one row a program or device, told by names that only it has.

A new one is a row here and a made-up file in the tests.  Most need no more than the marks, since
names and units of columns speak for themselves; units stand here where the file does not tell.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ....core import Increments
from .table_layout import Layout, Part

TICKS = ("us", "100us")

LAYOUTS = (
    Layout(
        "xsens-mt",
        "Xsens MT Manager and Awinda: text export, one file a sensor",
        marks=("~^//", "packet counter"),
        time_units=("100us",),
        wrap_bits=32,
        force_unit="m/s^2",
        rate_unit="rad/s",
        increments=Increments.COMPENSATED,
        remark="export acceleration and angular velocity, or increments (OriInc, VelInc)",
    ),
    Layout(
        "dot-server",
        "Xsens DOT Server: log of all devices in one file",
        marks=("timestamp", "address", "acc x|freeacc x|free acc x|gyr x"),
        time_units=TICKS,
        wrap_bits=32,
        force_unit="m/s^2",
        rate_unit="deg/s",
        field_unit="a.u.",
        increments=Increments.COMPENSATED,
        remark="log in the mode 'Rate quantities'",
    ),
    Layout(
        "xsens-dot",
        "Xsens DOT app, exporter and PC SDK: .csv, one file a sensor",
        marks=("sampletimefine",),
        time_units=TICKS,
        wrap_bits=32,
        force_unit="m/s^2",
        rate_unit="deg/s",
        field_unit="a.u.",
        increments=Increments.COMPENSATED,
        remark="record in a mode with rate quantities, delta quantities or high fidelity",
    ),
    Layout(
        "x-imu3",
        "x-io x-IMU3: folder of a device with Inertial.csv",
        marks=("timestamp", "gyroscope x", "accelerometer x"),
        parts=(Part("all", r"inertial\.csv"),),
        time_units=("us", "s"),
    ),
    Layout(
        "ngimu",
        "x-io NGIMU: folder of a device with sensors.csv",
        marks=("time", "gyroscope x", "accelerometer x", "barometer"),
        parts=(Part("all", r"sensors\.csv"),),
        time_units=("s",),
    ),
    Layout(
        "x-imu",
        "x-io x-IMU: folder or file NAME_CalInertialAndMag.csv",
        marks=("packet number", "gyroscope x", "accelerometer x"),
        parts=(Part("all", r".*calinertialandmag\.csv"),),
        counts_samples=False,
        remark="it holds no time: give the output rate with --rate (256 Hz as delivered)",
    ),
    Layout(
        "apdm-opal",
        "APDM Opal: .csv of Motion Studio or Mobility Lab, one file a sensor",
        marks=("~apdm|opal|mobility lab", "time"),
        force_unit="m/s^2",
        rate_unit="rad/s",
        field_unit="uT",
        time_units=("us", "s"),
    ),
    Layout(
        "shimmer",
        "Shimmer Consensys: .csv, calibrated, tabs or commas",
        marks=("*accel wr x cal|*accel ln x cal", "*gyro x cal"),
        prefer=("wr",),
        force_unit="m/s^2",
        rate_unit="deg/s",
        time_units=("ms",),
    ),
    Layout(
        "mbientlab",
        "Mbientlab MetaBase: accelerometer and gyroscope in a file each, in one folder",
        marks=("epoc|epoch", "elapsed", "x axis"),
        parts=(Part("force", r".+_accelerometer.*\.csv"), Part("rate", r".+_gyroscope.*\.csv")),
        time_units=("ms",),
    ),
    Layout(
        "physilog",
        "GaitUp Physilog: .csv, one file a sensor",
        marks=("~physilog|gait ?up", "time", "gyro x", "accel x"),
        force_unit="g",
        rate_unit="deg/s",
        time_units=("s",),
    ),
    Layout(
        "sensor-logger",
        "Sensor Logger (phone): folder with TotalAcceleration.csv and Gyroscope.csv",
        marks=("time", "seconds elapsed", "z", "y", "x"),
        parts=(
            Part("force", r"totalacceleration\.csv|accelerometeruncalibrated\.csv"),
            Part("rate", r"gyroscope\.csv|gyroscopeuncalibrated\.csv"),
        ),
        force_unit="m/s^2",
        rate_unit="rad/s",
        time_units=("ns",),
        remark="Accelerometer.csv has gravity taken out; record 'Total Acceleration' too",
    ),
    Layout(
        "phyphox",
        "phyphox (phone): folder with Accelerometer.csv and Gyroscope.csv, or one table",
        marks=("time", "acceleration x|x"),
        parts=(Part("force", r"accelerometer\.csv"), Part("rate", r"gyroscope\.csv")),
        time_units=("s",),
    ),
    Layout(
        "realsense",
        "Intel RealSense rs-convert and rs-data-collect: accel and gyro rows in one file",
        marks=("stream type", "3dof x"),
        columns={"stream": "Stream Type"},
        force_unit="m/s^2",
        rate_unit="rad/s",
        time_units=("ms", "us"),
    ),
)
BY_NAME = {layout.name: layout for layout in LAYOUTS}


def recognise(names: Sequence[str], preamble: Sequence[str]) -> Layout | None:
    """Return the layout whose marks are all there; ``names`` are plain, without units."""
    for layout in LAYOUTS:
        if layout.marks and all(_has(mark, names, preamble) for mark in layout.marks):
            return layout
    return None


def _has(mark: str, names: Sequence[str], preamble: Sequence[str]) -> bool:
    if mark.startswith("~"):
        return any(re.search(mark[1:], line.strip(), re.I) for line in preamble)
    joined = [name.replace(" ", "") for name in names]
    for word in mark.replace(" ", "").split("|"):
        ending = word.removeprefix("*")
        if word in joined or (word != ending and any(name.endswith(ending) for name in joined)):
            return True
    return False
