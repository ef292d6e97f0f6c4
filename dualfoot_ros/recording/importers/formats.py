"""The table of formats, and the choice of one for a source."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import cast

import numpy as np

from ...core import FEET, ImuSeries, Increments, RecordingError
from ..open_bag import METADATA
from ..recording import Recording
from .options import ImportOptions
from .tables import LAYOUTS, SUFFIXES


@dataclass(frozen=True)
class Format:
    """One format: its name, its description, and the module that loads it.

    ``options`` are the fields of :class:`ImportOptions` that it uses beside the sources;
    ``preset`` names the layout of its tables, where it is one of those.
    """

    name: str
    description: str
    suffixes: tuple[str, ...]
    module: str
    options: tuple[str, ...] = ()
    preset: str = ""

    def load(self, options: ImportOptions) -> Recording:
        """Load a recording; raise RecordingError when the files are not as the format says."""
        module = importlib.import_module(f".{self.module}", __package__)
        load = cast(Callable[[ImportOptions], Recording], module.load)
        return load(replace(options, preset=self.preset) if self.preset else options)


OF_ALL = ("sources", "left", "right", "right_offset_s", "increments")
FOLDER = "/"
CAPTURE = "capture"
TABLES = "/tables"  # a folder that is no bag
BAG_SUFFIX_FILES = {".mcap", ".db3", ".bag"}
BAG_SUFFIXES = (FOLDER, ".mcap", ".db3", ".bag")
TABLE_OPTIONS = (
    *("axes", "field_scale", "force_unit", "rate_unit", "layout", "known_layout", "preset"),
    *("left_device", "right_device"),
)
FLAGS = {"known_layout": "--layout"}
LAYOUT_FLAGS = {"time_units": "--time-unit", "rate_hz": "--rate"}
FORMATS = (
    Format(
        "dual-feet",
        "one .mat file of the dual-feet data set (Ma and Särkkä 2023): two Xsens DOT, 60 Hz",
        (".mat",),
        "dual_feet",
    ),
    Format(
        "rosbag",
        "a bag, also of ROS 1, whose topics have other names, axes, units or stamps",
        BAG_SUFFIXES,
        "rosbag",
        options=("axes", "left_topic", "right_topic", "force_unit", "rate_unit", "stamps"),
    ),
    Format(
        CAPTURE,
        "bytes captured from two devices, one file a foot (--left, --right, --capture)",
        (".ximu3",),
        "captures",
        options=("axes", "capture", "capture_rate"),
    ),
    Format(
        "csv",
        "any table as text; columns, time and units are found by names, values and motion",
        (*sorted(SUFFIXES), TABLES),
        "csv_tables",
        TABLE_OPTIONS,
    ),
    *(
        Format(layout.name, layout.about, (), "csv_tables", TABLE_OPTIONS, layout.name)
        for layout in LAYOUTS
    ),
)


def import_recording(options: ImportOptions, name: str = "auto") -> Recording:
    """Load the sources of ``options`` as format ``name``; "auto" chooses it by the file names.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When there is no such format, or the files are not as it says.
    OSError
        When a file cannot be read.
    """
    files = [*options.sources, *(p for p in (options.left, options.right) if p is not None)]
    if not files:
        raise RecordingError("no source given; allowed is a file of a format in --list")
    for file in files:
        if not file.exists():
            raise RecordingError(f"there is no file '{file}'")
    if name == "auto" and options.capture:
        name = CAPTURE
    chosen = _format(name, _kind(files[0]))
    check_options(options, chosen)
    recording = _declared(chosen.load(options), options.increments)
    return _shifted(recording, round(options.right_offset_s * 1e9))


def check_options(options: ImportOptions, chosen: Format) -> None:
    """Refuse an option that ``chosen`` would ignore.

    Raises
    ------
    RecordingError
        Names the option, and the formats that it is for.
    """
    for name in _given(options):
        if name not in (*OF_ALL, *chosen.options):
            raise RecordingError(
                f"{_flag(name, options)} does not apply to the format {chosen.name}; it is for "
                f"{', '.join(_able(name))}"
            )


def check_as_it_is(options: ImportOptions, bag: Path) -> None:
    """Refuse every option about files of sensors, for a bag that is read as it is.

    Raises
    ------
    RecordingError
        Names the option, and what takes it.
    """
    for name in _given(options):
        flag, able = _flag(name, options), _able(name)
        remedy = (
            f"'dualfoot import {bag} {flag} ... -o NEW' makes a bag with it"
            if "rosbag" in able
            else f"it is for the formats {', '.join(able)}"
        )
        raise RecordingError(
            f"{flag} does not apply: '{bag}' is a bag, which is read as it is; {remedy}"
        )


def _given(options: ImportOptions) -> list[str]:
    """Return the names of the options that do not have their default."""
    return [spec.name for spec in fields(options) if getattr(options, spec.name) != spec.default]


def _able(name: str) -> list[str]:
    """Return the formats that use an option."""
    return [known.name for known in FORMATS if name in known.options and not known.preset]


def _flag(name: str, options: ImportOptions) -> str:
    """Return how the command line calls the option ``name``, as it is given."""
    if name == "layout" and options.layout is not None:
        first = next(iter(options.layout.told()))
        return LAYOUT_FLAGS.get(first, f"--{first}")
    return FLAGS.get(name, f"--{name.replace('_', '-')}")


def is_table(path: Path) -> bool:
    """Return whether ``path`` is a table as text, or a folder of some, by its name."""
    return _kind(path) in (*SUFFIXES, TABLES)


def is_export(path: Path) -> bool:
    """Return whether ``path`` is to be imported, and is no bag, by its name."""
    kind = _kind(path)
    return any(kind in known.suffixes for known in FORMATS if known.module != "rosbag")


def _kind(path: Path) -> str:
    """Return the ending of a file, FOLDER for a bag, TABLES for another folder."""
    if not path.is_dir():
        return path.suffix.lower()
    if (path / METADATA).exists():
        return FOLDER
    held = {entry.suffix.lower() for entry in path.iterdir()}
    return FOLDER if held & BAG_SUFFIX_FILES or not held & (SUFFIXES | {""}) else TABLES


def _shown(suffixes: Sequence[str]) -> str:
    words = {FOLDER: "folder", TABLES: "folder of these"}
    return ", ".join(words.get(suffix, suffix) for suffix in suffixes)


def _format(name: str, suffix: str) -> Format:
    for candidate in FORMATS:
        if name == candidate.name or (name == "auto" and suffix in candidate.suffixes):
            return candidate
    names = ", ".join(f.name for f in FORMATS)
    if name == "auto":
        known = "; ".join(f"{f.name}: {_shown(f.suffixes)}" for f in FORMATS if f.suffixes)
        raise RecordingError(
            f"files '*{suffix}' are of no known format; known are {known}; name another with "
            "--capture (bytes of a device), or take 'dualfoot import --format csv' (a table)"
        )
    raise RecordingError(f"format is '{name}'; allowed is auto, {names}")


def _declared(recording: Recording, kind: str) -> Recording:
    """Return the recording with samples of that kind; "auto" leaves what the source says.

    Raises
    ------
    RecordingError
        When there is no such kind.
    """
    if kind == "auto":
        return recording
    if kind not in tuple(Increments):
        raise RecordingError(
            f"increments is '{kind}'; allowed is auto, {', '.join(known for known in Increments)}"
        )
    feet = {
        foot: replace(series, increments=Increments(kind))
        for foot in FEET
        if (series := recording.imu(foot)) is not None
    }
    return replace(recording, **feet)  # type: ignore[arg-type]


def _shifted(recording: Recording, offset_ns: int) -> Recording:
    right = recording.right
    if offset_ns == 0 or right is None:
        return recording
    stamps = right.stamp_ns + np.int64(offset_ns)
    notes = {**recording.notes, "right_offset_s": f"{offset_ns * 1e-9:.9f}"}
    moved: ImuSeries = replace(right, stamp_ns=stamps)
    pressure = dict(recording.pressure)
    if "right" in pressure:
        series = pressure["right"]
        pressure["right"] = replace(series, stamp_ns=series.stamp_ns + np.int64(offset_ns))
    return replace(recording, right=moved, pressure=pressure, notes=notes)
