"""The feet in tables: a file or folder for each, or one that holds both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ....core import FEET, RecordingError
from .assumptions import Assumption, Origin
from .column_choice import Columns, choose_columns
from .column_words import SIDES, read_name
from .known_layouts import LAYOUTS
from .sensor_reading import Reading, Request, Samples, in_si, read_sensor_columns, read_stream
from .stamp_axis import Stamps
from .stream_join import Stream, join
from .table_file import TableFile, open_table
from .table_layout import Layout, Part
from .unit_choice import told_unit

SUFFIXES = frozenset({".csv", ".txt", ".tsv", ".dat", ".log", ".tab", ".asc"})
MOST_DEVICES = 32  # a column with more different values names no devices
STREAMS = {"accel": "force", "acc": "force", "gyro": "rate", "gyr": "rate"}


@dataclass(frozen=True)
class Intake:
    """How tables are to be read.

    Attributes
    ----------
    given : what the options say
    known : the layout that is told by name or file, or None to recognise it
    field_scale : tesla for 1 of the magnetic field, 0 for that of its unit
    devices : what a column of devices calls each foot, where that is told
    """

    given: Layout
    known: Layout | None = None
    field_scale: float = 0.0
    devices: tuple[str | None, str | None] = (None, None)


def read_one(path: Path, foot: str, intake: Intake) -> Reading:
    """Return the one sensor of a file or folder.

    Raises
    ------
    RecordingError
        When it is no such table, or holds both feet.
    """
    found = read_feet(path, foot, intake)
    if "" in found:
        return found[""]
    if foot in found:
        return found[foot]
    raise RecordingError(f"'{path}' holds both feet; give it alone, without --left and --right")


def read_feet(path: Path, foot: str, intake: Intake) -> dict[str, Reading]:
    """Return the sensors by foot, "left" and "right", or the only one as "".

    ``foot`` is what the one sensor is called in sentences and assumptions.
    """
    if not path.is_dir():
        return _of_file(path, foot, intake)
    entries = sorted(p for p in path.iterdir() if p.is_dir() or p.suffix.lower() in SUFFIXES)
    sides = {side: [p for p in entries if side in _sides(p.stem)] for side in FEET}
    if all(sides.values()):
        return {side: _of_entries(path, sides[side], side, intake) for side in FEET}
    return {"": _of_entries(path, entries, foot, intake)}


def _sides(name: str) -> set[str]:
    return {SIDES[word] for word in read_name(name, 0).plain.split() if word in SIDES}


def _of_entries(folder: Path, entries: Sequence[Path], foot: str, intake: Intake) -> Reading:
    """Return the one sensor whose files are ``entries``."""
    if len(entries) == 1:
        return read_one(entries[0], foot, intake)
    known = [intake.known] if intake.known is not None else list(LAYOUTS)
    for layout in known:
        files = [_matching(part, entries) for part in layout.parts]
        if files and all(files):
            return _of_parts(layout, [file for file in files if file is not None], foot, intake)
    wanted = "; ".join(
        f"{layout.name}: {' and '.join(part.pattern for part in layout.parts)}"
        for layout in known
        if layout.parts
    )
    held = ", ".join(entry.name for entry in entries[:8]) or "nothing that is a table"
    remark = known[0].remark if len(known) == 1 else ""
    raise RecordingError(
        f"folder '{folder}' holds {held}; known are folders with {wanted or 'one table'}"
        f"{'; ' if remark else ''}{remark}; or name the file of each foot with --left and --right"
    )


def _matching(part: Part, entries: Sequence[Path]) -> Path | None:
    """Return the file whose name fits the first alternative of the part's pattern."""
    import re

    for pattern in part.pattern.split("|"):
        hits = [p for p in entries if re.fullmatch(pattern, p.name.lower()) and p.is_file()]
        if hits:
            return hits[0]
    return None


def _of_parts(layout: Layout, files: Sequence[Path], foot: str, intake: Intake) -> Reading:
    tables = [open_table(file, intake.given, intake.known) for file in files]
    if len(files) == 1:
        return _of_table(tables[0], foot, intake)[""]
    streams: dict[str, tuple[TableFile, Columns, Stream]] = {}
    for part, table in zip(layout.parts, tables, strict=True):
        columns = choose_columns(table.path, table.dialect, table.layout, part.holds)[0]
        stream, stamps = read_stream(table, columns, part.holds, foot)
        streams[part.holds] = (table, columns, stream)
    return _joined(streams, stamps, foot, intake)


def _joined(
    streams: dict[str, tuple[TableFile, Columns, Stream]],
    stamps: Stamps,
    foot: str,
    intake: Intake,
) -> Reading:
    (force_table, force_columns, force) = streams["force"]
    (rate_table, rate_columns, rate) = streams["rate"]
    stamp_ns, forces, rates = join(force, rate)
    if len(stamp_ns) < 2:
        raise RecordingError(
            f"'{force_table.path}' and '{rate_table.path}' share no time; are they of one "
            "recording?"
        )
    told = (
        told_unit(force_table.path, "force", force_columns, force_table.given, force_table.known),
        told_unit(rate_table.path, "rate", rate_columns, rate_table.given, rate_table.known),
    )
    text = f"interpolated to the {len(stamp_ns)} stamps of the gyro"
    note = Assumption(foot, "accelerometer", text, Origin.VALUES)
    samples = Samples(replace(stamps, stamp_ns=stamp_ns), forces, rates, None)
    request = Request(foot, intake.field_scale)
    return in_si(force_table, force_columns, request, samples, [note], told)


def _of_file(path: Path, foot: str, intake: Intake) -> dict[str, Reading]:
    return _of_table(open_table(path, intake.given, intake.known), foot, intake)


def _of_table(table: TableFile, foot: str, intake: Intake) -> dict[str, Reading]:
    stream = "stream" in table.layout.columns
    assumed = "force" if stream else ""
    sensors = choose_columns(table.path, table.dialect, table.layout, assumed)
    if stream:
        return {"": _of_streams(table, sensors[0], foot, intake)}
    if len(sensors) > 1:
        return {
            columns.side: read_sensor_columns(
                table, columns, Request(columns.side, intake.field_scale)
            )
            for columns in sensors
        }
    devices = _devices(table, sensors[0])
    if devices is None:
        return {"": read_sensor_columns(table, sensors[0], Request(foot, intake.field_scale))}
    return _of_devices(table, sensors[0], devices, intake)


def _of_streams(table: TableFile, columns: Columns, foot: str, intake: Intake) -> Reading:
    """Return the sensor of a table whose rows are of the accelerometer or of the gyro."""
    words = np.array([word.lower() for word in table.words(columns.places["stream"])])
    streams = {}
    for word in np.unique(words).tolist():
        quantity = next((kind for start, kind in STREAMS.items() if word.startswith(start)), None)
        if quantity is not None:
            stream, stamps = read_stream(table, columns, "force", foot, words == word)
            streams[quantity] = (table, columns, stream)
    if set(streams) != {"force", "rate"}:
        held = ", ".join(np.unique(words).tolist()[:8])
        raise RecordingError(
            f"'{table.path}' has rows of {held}; needed are rows of accelerometer and gyro"
        )
    return _joined(streams, stamps, foot, intake)


def _devices(table: TableFile, columns: Columns) -> list[str] | None:
    """Return the device of each row, where a column names two or more."""
    place = columns.places.get("device")
    if place is None:
        return None
    words = table.words(place)
    count = len(set(words))
    told = "device" in columns.given
    return words if told or 1 < count <= min(MOST_DEVICES, len(words) // 4) else None


def _of_devices(
    table: TableFile, columns: Columns, words: Sequence[str], intake: Intake
) -> dict[str, Reading]:
    names = sorted(set(words))
    found = {}
    for foot, told in zip(FEET, intake.devices, strict=True):
        device = told if told is not None else _device_of(foot, names)
        if device is None or device not in names:
            raise RecordingError(
                f"'{table.path}' holds the devices {', '.join(names)}; which one was on the "
                f"{foot} foot is {'not in it' if device is None else f'not {device}'}: give "
                "--left-device ID and --right-device ID"
            )
        rows = np.array([word == device for word in words])
        request = Request(foot, intake.field_scale)
        reading = read_sensor_columns(table, columns, request, rows)
        origin = Origin.OPTION if told is not None else Origin.VALUES
        note = Assumption(foot, "device", device, origin)
        found[foot] = replace(reading, label=device, assumptions=(*reading.assumptions, note))
    return found


def _device_of(foot: str, names: Sequence[str]) -> str | None:
    """Return the one device whose name tells that it is of a foot."""
    hits = [name for name in names if foot in _sides(name)]
    return hits[0] if len(hits) == 1 else None
