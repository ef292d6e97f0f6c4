"""Options about tables and captures, for ``import`` and verbs that take files as a bag."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..core import FEET, FORCE_UNITS, FORWARD_LEFT_UP, RATE_UNITS, RecordingError

if TYPE_CHECKING:
    from ..recording import Recording
    from ..recording.importers import ImportOptions
    from ..recording.importers.tables import Layout

    Arguments = argparse._ActionsContainer  # noqa: SLF001  (a parser or a group; it has no other name)

TABLES = "tables (csv and the like), where the file does not tell"
CAPTURES = "bytes captured from devices (format capture)"
TIME_UNITS = ("s", "ms", "100us", "us", "ns", "samples")
DELIMITERS = {"comma": ",", "semicolon": ";", "tab": "\t", "bar": "|", "space": " "}
DECIMALS = {"point": ".", "comma": ","}
INTAKE_DEFAULTS: dict[str, object] = {
    "axes": FORWARD_LEFT_UP,
    "capture": "",
    "capture_rate": 0.0,
    **dict.fromkeys(("force_unit", "rate_unit", "columns", "time_unit", "rate", "delimiter")),
    **dict.fromkeys(("decimal", "skip", "left_device", "right_device", "layout")),
}


def add_table_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options about the layout of a table."""
    group = parser.add_argument_group(TABLES)
    _add_form_arguments(group)
    _add_device_arguments(group)
    _add_layout_argument(group)
    group.add_argument(
        "--save-layout", type=Path, metavar="YAML", help="keep the layout that was found"
    )


def add_single_table_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options about the layout of a table with one sensor, and about its units."""
    group = parser.add_argument_group(TABLES)
    add_unit_arguments(group)
    _add_form_arguments(group)
    _add_layout_argument(group)


def _add_form_arguments(group: Arguments) -> None:
    group.add_argument(
        "--columns",
        metavar="ROLE=NAME,...",
        help="columns by name, or by number from 1: time, counter, device, ax ay az (force), "
        "gx gy gz (rate), mx my mz (field)",
    )
    group.add_argument("--time-unit", choices=TIME_UNITS, help="unit of the time")
    group.add_argument("--rate", type=float, metavar="HZ", help="sampling rate")
    group.add_argument(
        "--delimiter",
        metavar="NAME",
        choices=[*DELIMITERS, *",;|"],
        help=f"what separates the cells: {', '.join(DELIMITERS)}",
    )
    group.add_argument(
        "--decimal",
        metavar="NAME",
        choices=[*DECIMALS, *".,"],
        help=f"decimal sign: {', '.join(DECIMALS)}",
    )
    group.add_argument("--skip", type=int, metavar="N", help="lines to skip before the table")


def _add_device_arguments(group: Arguments) -> None:
    for foot in FEET:
        group.add_argument(
            f"--{foot}-device",
            metavar="ID",
            help=f"device of the {foot} foot, where a column names the device",
        )


def _add_layout_argument(parser: Arguments) -> None:
    parser.add_argument(
        "--layout", type=Path, metavar="YAML", help="layout of the table, of --save-layout"
    )


def add_unit_arguments(parser: Arguments) -> None:
    """Add ``--force-unit`` and ``--rate-unit``."""
    parser.add_argument(
        "--force-unit",
        choices=FORCE_UNITS,
        help="unit of the specific force (default: m/s^2 in a bag; a table tells)",
    )
    parser.add_argument(
        "--rate-unit",
        choices=RATE_UNITS,
        help="unit of the angular rate (default: rad/s in a bag; a table tells)",
    )


def add_intake_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options with which a verb takes files of sensors in place of a bag."""
    group = parser.add_argument_group("files of sensors in place of BAG")
    for foot in FEET:
        group.add_argument(
            f"--{foot}", type=Path, metavar="FILE", help=f"file of the {foot} foot's sensor"
        )
    add_axes_argument(group)
    add_unit_arguments(group)
    _add_form_arguments(group)
    _add_device_arguments(group)
    _add_layout_argument(group)
    add_capture_arguments(group)


def refuse_intake_options(bag: str, args: argparse.Namespace) -> None:
    """Refuse the options of files of sensors where ``bag`` is one.

    Raises
    ------
    RecordingError
        When one is given; names it.
    """
    if all(getattr(args, name) == default for name, default in INTAKE_DEFAULTS.items()):
        return  # without an import of the many modules that read files of sensors
    from ..recording.importers import check_as_it_is

    check_as_it_is(replace(_intake_options(args), left_topic=None, right_topic=None), Path(bag))


def add_capture_arguments(group: Arguments) -> None:
    """Add ``--capture`` and ``--capture-rate``."""
    group.add_argument(
        "--capture",
        default="",
        metavar="FORMAT",
        help="format of the files of --left and --right, as a live source has it, with options of "
        "the decoder behind a '?': ximu3, xbus, witmotion?force_range=4 (default: by the ending "
        ".ximu3)",
    )
    group.add_argument(
        "--capture-rate",
        type=float,
        default=0.0,
        metavar="HZ",
        help="samples a second of a captured device that sends no time",
    )


def add_axes_argument(parser: Arguments) -> None:
    """Add ``--axes``."""
    parser.add_argument(
        "--axes",
        default=FORWARD_LEFT_UP,
        metavar="AXES",
        help="device axes that point forward, left and up, written --axes=+x+y+z "
        "(default: %(default)s; not for dual-feet)",
    )


def given_layout(args: argparse.Namespace) -> Layout | None:
    """Return what the options about the form of a table say; None where they say nothing.

    Raises
    ------
    RecordingError
        When a number is out of range, or a role unknown.
    """
    from ..recording.importers.tables import Layout, parse_columns

    if args.rate is not None and not args.rate > 0.0:
        raise RecordingError(f"--rate is {args.rate:g}; allowed is more than 0 Hz")
    if args.skip is not None and args.skip < 0:
        raise RecordingError(f"--skip is {args.skip}; allowed is 0 or more lines")
    given = Layout(
        columns={} if args.columns is None else parse_columns(args.columns),
        delimiter=DELIMITERS.get(args.delimiter, args.delimiter),
        decimal=DECIMALS.get(args.decimal, args.decimal),
        skip=args.skip or 0,
        time_units=() if args.time_unit is None else (args.time_unit,),
        rate_hz=args.rate,
    )
    return None if given == Layout() else given


def known_layout(args: argparse.Namespace) -> Layout | None:
    """Return the layout of ``--layout``, or None."""
    from ..recording.importers.tables import load_layout

    return None if args.layout is None else load_layout(args.layout)


def import_in_memory(path: str | None, args: argparse.Namespace) -> Recording:
    """Return the recording of ``path`` or of ``--left`` and ``--right``; print what was assumed.

    Raises
    ------
    RecordingError
        When they are no such files, or their columns, time or units are not known.
    """
    from ..recording.importers import import_recording
    from .printing import assumption_lines, print_note

    sources = () if path is None else (Path(path),)
    options = replace(_intake_options(args), sources=sources, left=args.left, right=args.right)
    recording = import_recording(options)
    for line in assumption_lines(recording):
        print_note(line)
    return recording


def _intake_options(args: argparse.Namespace) -> ImportOptions:
    from ..recording.importers import ImportOptions

    return ImportOptions(
        axes=args.axes,
        left_topic=args.left_topic,
        right_topic=args.right_topic,
        force_unit=args.force_unit,
        rate_unit=args.rate_unit,
        layout=given_layout(args),
        known_layout=known_layout(args),
        left_device=args.left_device,
        right_device=args.right_device,
        capture=args.capture,
        capture_rate=args.capture_rate,
    )
