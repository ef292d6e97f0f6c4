"""Exports of the Xsens DOT app: one .csv a sensor, about ten header lines, then columns.

``Acc_*`` is m/s^2, ``Gyr_*`` deg/s, ``Mag_*`` arbitrary units (1 is the field where the sensor
was calibrated), ``SampleTimeFine`` the device's microseconds as a 32-bit counter.  The device is
forward-left-up when it lies flat with its x axis to the toes; ``axes`` describes other mountings.
"""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...core import FORWARD_LEFT_UP, FloatArray, ImuSeries, Increments, RecordingError, axes_matrix
from ..recording import Recording
from .options import ImportOptions
from .sample_counter import same_wrap, unwrap_us

FIRST_COLUMN = "PacketCounter"
STAMP = "SampleTimeFine"
GROUPS = {name: tuple(f"{name}_{axis}" for axis in "XYZ") for name in ("Acc", "Gyr", "Mag")}
HEADER_LINES = 40


def load(options: ImportOptions) -> Recording:
    """Load the two files ``options.left`` and ``options.right``.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When a foot is missing or a file is no such export; names the file and the column.
    """
    if options.left is None or options.right is None or options.sources:
        raise RecordingError(
            "an Xsens DOT export holds one sensor, and which foot it was on is not in it; give "
            "--left FILE and --right FILE"
        )
    rotation = np.array(axes_matrix(options.axes))
    left, left_header = _read(options.left, rotation, options.field_scale)
    right, right_header = _read(options.right, rotation, options.field_scale)
    left_ns, right_ns = same_wrap(left.stamp_ns, right.stamp_ns)
    return Recording(
        left=_restamped(left, left_ns),
        right=_restamped(right, right_ns),
        notes={
            "source": f"{options.left.name}, {options.right.name}",
            "format": "xsens-dot",
            "stamp_source": f"{STAMP}, microseconds of each device's own clock, unwrapped",
            "axes": f"forward, left, up are the device's {options.axes}",
            "sync_status": _both(left_header, right_header, "SyncStatus"),
            "device_tag": _both(left_header, right_header, "DeviceTag"),
            "start_time": _both(left_header, right_header, "StartTime"),
        },
    )


def read_sensor(path: Path, axes: str = FORWARD_LEFT_UP) -> ImuSeries:
    """Return the samples of one sensor, of either foot, turned to forward-left-up.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When the file is no such export.
    OSError
        When it cannot be read.
    """
    return _read(path, np.array(axes_matrix(axes)), 0.0)[0]


def _both(left: dict[str, str], right: dict[str, str], key: str) -> str:
    return f"left {left.get(key, 'unknown')}, right {right.get(key, 'unknown')}"


def _restamped(series: ImuSeries, stamp_ns: np.ndarray) -> ImuSeries:
    return replace(series, stamp_ns=stamp_ns)


def _read(
    path: Path, rotation: FloatArray, field_scale: float
) -> tuple[ImuSeries, dict[str, str]]:
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    at = _first_line(lines, path)
    delimiter = ";" if ";" in lines[at] else ","
    names = [name.strip() for name in lines[at].split(delimiter)]
    wanted = [STAMP, *GROUPS["Acc"], *GROUPS["Gyr"], *(GROUPS["Mag"] if field_scale else ())]
    table = _table(lines[at + 1 :], names, wanted, delimiter, path, at + 2)
    vectors = [table[:, k : k + 3] @ rotation.T for k in range(1, table.shape[1], 3)]
    field = vectors[2] * field_scale if field_scale else None
    stamps, kind = unwrap_us(table[:, 0]), Increments.COMPENSATED
    series = ImuSeries(stamps, vectors[0], np.deg2rad(vectors[1]), field, kind)
    return series, _header(lines[:at], delimiter)


def _first_line(lines: list[str], path: Path) -> int:
    for at, line in enumerate(lines[:HEADER_LINES]):
        if line.strip().startswith(FIRST_COLUMN):
            return at
    raise RecordingError(
        f"'{path}' is no Xsens DOT export: none of its first {HEADER_LINES} lines starts with "
        f"'{FIRST_COLUMN}'"
    )


def _table(
    lines: list[str], names: list[str], wanted: list[str], delimiter: str, path: Path, first: int
) -> FloatArray:
    missing = [name for name in wanted if name not in names]
    if missing:
        raise RecordingError(
            f"'{path}' has no column {', '.join(missing)}; export from a measurement mode with "
            "rate quantities (acceleration and angular velocity)"
        )
    rows = [line for line in lines if line.strip(f"{delimiter} ")]
    if not rows:
        raise RecordingError(f"'{path}' holds no sample after its header; record again")
    _check_widths(lines, names, delimiter, path, first)
    columns = [names.index(name) for name in wanted]
    try:
        return np.loadtxt(
            io.StringIO("\n".join(rows)), delimiter=delimiter, usecols=columns, ndmin=2
        )
    except ValueError as error:
        reason = " ".join(str(error).split()).rstrip(".")
        raise RecordingError(
            f"'{path}' is damaged: {reason} (rows counted from line {first})"
        ) from None


def _check_widths(
    lines: list[str], names: list[str], delimiter: str, path: Path, first: int
) -> None:
    """Refuse rows with a cell too many or too few, which would be read shifted."""
    named = max(k for k, name in enumerate(names, start=1) if name)
    bad = []
    for number, line in enumerate(lines, start=first):
        cells = line.split(delimiter)
        beyond = "".join(cells[named:]).strip()
        if (beyond or len(cells) < named) and line.strip(f"{delimiter} "):
            bad.append((number, len(cells)))
    if bad:
        number, count = bad[0]
        raise RecordingError(
            f"'{path}' is damaged: line {number} has {count} cells where the header names "
            f"{named} columns (such rows: {len(bad)}); which value belongs to which column is "
            "unknown there, so export again or remove these rows"
        )


def _header(lines: list[str], delimiter: str) -> dict[str, str]:
    pairs = (line.split(delimiter) for line in lines if ":" in line.split(delimiter)[0])
    return {cells[0].strip(" :"): cells[1].strip() for cells in pairs if len(cells) > 1}
