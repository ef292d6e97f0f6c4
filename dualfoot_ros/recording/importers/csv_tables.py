"""Tables as text (csv and the like): a file or folder for each foot, or one with both."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ...core import (
    FEET,
    FORWARD_LEFT_UP,
    FloatArray,
    ImuSeries,
    IntArray,
    RecordingError,
    axes_matrix,
)
from ..recording import Recording
from .options import ImportOptions
from .sample_counter import same_wrap
from .tables import BY_NAME, Intake, Layout, Reading, layout_text, read_feet, read_one, to_note
from .twins import without_twins

SECOND_NS = 1_000_000_000
HEADER_NOTES = {"SyncStatus": "sync_status", "DeviceTag": "device_tag", "StartTime": "start_time"}


def load(options: ImportOptions) -> Recording:
    """Load the tables of ``options``: ``left`` and ``right``, or the one source with both feet.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When a foot is missing or both hold the same samples, or a file is no table of which
        columns, time and units are known; names the file, the column and the option that helps.
    """
    rotation = np.array(axes_matrix(options.axes))
    readings = _readings(options)
    stamps = _on_one_axis(readings)
    series = {foot: _turned(readings[foot].series, stamps[foot], rotation) for foot in FEET}
    notes = _notes(options, readings)
    return without_twins(Recording(left=series["left"], right=series["right"], notes=notes))


def read_sensors(
    path: Path, options: ImportOptions | None = None, foot: str = ""
) -> dict[str, ImuSeries]:
    """Return the sensors of one file or folder by foot, or the only one as "", in body axes.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When it is no table of which columns, time and units are known.
    OSError
        When it cannot be read.
    """
    options = options or ImportOptions()
    rotation = np.array(axes_matrix(options.axes))
    readings = read_feet(path, foot, _intake(options))
    return {
        name: _turned(reading.series, reading.series.stamp_ns, rotation)
        for name, reading in readings.items()
    }


def read_sensor(path: Path, axes: str = FORWARD_LEFT_UP) -> ImuSeries:
    """Return the samples of the one sensor of a file, of either foot, in body axes.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When the file is no such table, or holds both feet.
    OSError
        When it cannot be read.
    """
    reading = read_one(path, "", _intake(ImportOptions(axes=axes)))
    return _turned(reading.series, reading.series.stamp_ns, np.array(axes_matrix(axes)))


def _intake(options: ImportOptions) -> Intake:
    given = options.layout or Layout()
    given = replace(
        given,
        force_unit=options.force_unit or given.force_unit,
        rate_unit=options.rate_unit or given.rate_unit,
    )
    known = options.known_layout or BY_NAME.get(options.preset)
    return Intake(given, known, options.field_scale, (options.left_device, options.right_device))


def _readings(options: ImportOptions) -> dict[str, Reading]:
    intake = _intake(options)
    if options.left is not None and options.right is not None and not options.sources:
        return {
            "left": read_one(options.left, "left", intake),
            "right": read_one(options.right, "right", intake),
        }
    if len(options.sources) == 1 and options.left is None and options.right is None:
        readings = read_feet(options.sources[0], "", intake)
        if "" not in readings:
            return readings
        raise RecordingError(
            f"'{options.sources[0]}' holds one sensor, and which foot it was on is not in it; "
            "give --left FILE and --right FILE"
        )
    raise RecordingError(
        "a table holds one sensor as a rule, and which foot it was on is not in it; give --left "
        "FILE and --right FILE, or one file or folder that holds both feet"
    )


def _on_one_axis(readings: dict[str, Reading]) -> dict[str, IntArray]:
    """Return the stamps of both feet: wraps of their counters undone alike, none below zero."""
    left, right = (readings[foot].series.stamp_ns for foot in FEET)
    if all(readings[foot].wraps for foot in FEET):
        left, right = same_wrap(left, right)
    lowest = min(int(left.min()), int(right.min()))
    lift = -(lowest // SECOND_NS) * SECOND_NS if lowest < 0 else 0
    return {"left": left + np.int64(lift), "right": right + np.int64(lift)}


def _turned(series: ImuSeries, stamp_ns: IntArray, rotation: FloatArray) -> ImuSeries:
    if np.array_equal(rotation, np.eye(3)):
        return replace(series, stamp_ns=stamp_ns)
    field = series.magnetic_field
    return replace(
        series,
        stamp_ns=stamp_ns,
        specific_force=series.specific_force @ rotation.T,
        angular_rate=series.angular_rate @ rotation.T,
        magnetic_field=None if field is None else field @ rotation.T,
    )


def _notes(options: ImportOptions, readings: dict[str, Reading]) -> dict[str, str]:
    files = options.sources or tuple(p for p in (options.left, options.right) if p is not None)
    left, right = readings["left"], readings["right"]
    time = next((a.value for a in left.assumptions if a.subject == "time"), "unknown")
    notes = {
        "source": ", ".join(file.name for file in files),
        "format": left.layout.name,
        "stamp_source": f"{time}, of each device's own clock",
        "axes": f"forward, left, up are the device's {options.axes}",
        "assumptions": to_note((*left.assumptions, *right.assumptions)),
        "layout": layout_text(left.layout),
    }
    for key, note in HEADER_NOTES.items():
        if key in left.facts or key in right.facts:
            known = [reading.facts.get(key, "unknown") for reading in (left, right)]
            notes[note] = f"left {known[0]}, right {known[1]}"
    return notes
