"""``dualfoot import``: sensor exports and data sets, as a bag."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from ..core import FEET, Increments, PressureSeries, RecordingError
from ..core.aids import WORN
from ..inspection import findings_of
from ..recording import METADATA, Recording, check_file, check_target, write_text
from ..recording.importers import (
    FORMATS,
    STAMPS,
    ImportOptions,
    import_recording,
    read_pressure,
)
from .arguments import add_bag_output_argument, add_storage_arguments, save_bag
from .printing import assumption_lines, doubts, print_warning
from .table_options import (
    CAPTURES,
    add_axes_argument,
    add_capture_arguments,
    add_table_arguments,
    add_unit_arguments,
    given_layout,
    known_layout,
)

HELP = "turn sensor exports and data sets into a bag"
EXAMPLES = """\
examples:
  dualfoot import --list
  dualfoot import rectangle_ccw/XF_2Laces_ccw_1.mat -o walk
  dualfoot import --left L.csv --right R.csv -o walk
  dualfoot import --left L.csv --right R.csv --axes=+y-x+z --right-offset 162.49 -o walk
  dualfoot import --left L.csv --right R.csv --pressure both=baro.csv -o walk
  dualfoot import --left L.ximu3 --right R.ximu3 -o walk
  dualfoot import --left L.bin --right R.bin --capture xbus -o walk
  dualfoot import walk.bag --stamps log -o walk
  dualfoot import --left L.csv --right R.csv --columns time=t,ax=fx,ay=fy,az=fz --rate-unit deg/s \
      --save-layout mine.yaml -o walk
  dualfoot import --left L2.csv --right R2.csv --layout mine.yaml -o walk2
  dualfoot import both.csv --left-device D4:22 --right-device D4:23 -o walk
  dualfoot import drive.mcap --left-topic /imu_l --right-topic /imu_r --rate-unit deg/s -o walk

Axes and units of the bag: forward-left-up, m/s^2, rad/s, tesla. Stamps are those of the devices.
What is known of the walk (floor markers, a closed loop) goes into reference.yaml in the bag.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "source", nargs="*", type=Path, metavar="SOURCE", help="file or bag to import"
    )
    add_bag_output_argument(parser)
    names = ["auto", *(f.name for f in FORMATS)]
    parser.add_argument(
        "--format", default="auto", choices=names, help="format of the source (default: auto)"
    )
    parser.add_argument("--list", action="store_true", help="list the formats and exit")
    for foot in FEET:
        parser.add_argument(
            f"--{foot}",
            type=Path,
            metavar="FILE",
            help=f"file or folder of the {foot} foot's sensor",
        )
    add_axes_argument(parser)
    parser.add_argument(
        "--right-offset",
        type=float,
        default=0.0,
        metavar="S",
        help="seconds added to the stamps of the right foot, for devices with different clocks",
    )
    parser.add_argument(
        "--increments",
        default="auto",
        choices=["auto", *(kind.value for kind in Increments)],
        help="what the samples are, see docs/explanation/samples.md (default: as the source says)",
    )
    parser.add_argument(
        "--field-scale",
        type=float,
        default=0.0,
        metavar="T",
        help="tesla per unit of a table's magnetometer, where the table does not tell it",
    )
    parser.add_argument(
        "--pressure",
        action="append",
        default=[],
        metavar="WORN=FILE",
        help="csv of air pressure of the left or right foot's sensor, or of both (worn on the "
        "body): columns stamp_ns, time_us, time_ms or time_s, and pressure_Pa or pressure_hPa; "
        "may be repeated",
    )
    add_unit_arguments(parser)
    add_table_arguments(parser)
    _add_bag_arguments(parser)
    add_capture_arguments(parser.add_argument_group(CAPTURES))
    add_storage_arguments(parser)


def _add_bag_arguments(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("bags (format rosbag)")
    for foot in FEET:
        group.add_argument(
            f"--{foot}-topic",
            metavar="TOPIC",
            help=f"sensor_msgs/Imu topic of the {foot} foot, or two topics ACCELEROMETER,GYRO "
            f"(default: that of this package, else the one whose name says {foot})",
        )
    group.add_argument(
        "--stamps",
        default="header",
        choices=STAMPS,
        help="header: as they are (default); log: the log times, evened out, for headers of "
        "zero; index: those of the headers, evened out by the number of the sample, for times of "
        "arrival and bursts",
    )


def run(args: argparse.Namespace) -> int:
    """Import, write the bag and describe it; return the exit code."""
    if args.list:
        _list()
        return 0
    if args.output is None:
        raise RecordingError("no output given; allowed is -o BAG, the folder to write")
    check_target(args.output, overwrite=args.overwrite, marker=METADATA)
    if args.save_layout is not None:
        check_file(args.save_layout, overwrite=args.overwrite)
    recording = import_recording(_options(args), args.format)
    columns = {**recording.pressure, **dict(_pressure(text) for text in args.pressure)}
    recording = replace(recording, pressure=columns)
    for line in assumption_lines(recording):
        print(line)
    save_bag(recording, args)
    _save_layout(recording, args.save_layout)
    _report(args.output, recording)
    return 0


def _save_layout(recording: Recording, path: Path | None) -> None:
    if path is None:
        return
    if "layout" not in recording.notes:
        raise RecordingError("--save-layout is for tables; this source has no columns")
    write_text(path, recording.notes["layout"])


def _pressure(text: str) -> tuple[str, PressureSeries]:
    worn, _, path = text.partition("=")
    if worn not in WORN or not path:
        raise RecordingError(
            f"--pressure is '{text}'; allowed is WORN=FILE with WORN one of {', '.join(WORN)}"
        )
    return worn, read_pressure(Path(path))


def _list() -> None:
    width = max(len(f.name) for f in FORMATS)
    for known in FORMATS:
        print(f"{known.name:<{width}}  {known.description}")


def _options(args: argparse.Namespace) -> ImportOptions:
    return ImportOptions(
        sources=tuple(args.source),
        left=args.left,
        right=args.right,
        axes=args.axes,
        right_offset_s=args.right_offset,
        field_scale=args.field_scale,
        increments=args.increments,
        left_topic=args.left_topic,
        right_topic=args.right_topic,
        force_unit=args.force_unit,
        rate_unit=args.rate_unit,
        stamps=args.stamps,
        capture=args.capture,
        capture_rate=args.capture_rate,
        layout=given_layout(args),
        known_layout=known_layout(args),
        left_device=args.left_device,
        right_device=args.right_device,
    )


def _report(output: Path, recording: Recording) -> None:
    for foot in FEET:
        imu = recording.imu(foot)
        if imu is not None:
            print(f"{foot}: {len(imu)} samples, {imu.duration_s:.1f} s, {imu.rate_hz:.1f} Hz")
    reference = recording.reference
    if reference is not None:
        print(f"reference: {reference.summary()}")
    for key in ("topics", "stamps", "losses"):
        if key in recording.notes:
            print(f"{key}: {recording.notes[key]}")
    print(f"wrote {output}")
    for sentence in doubts(recording):
        print_warning("import", sentence)
    for finding in findings_of(recording):
        print_warning("import", finding.sentence)
