"""``dualfoot evaluate``: one method on one bag; figures, TUM files, plots."""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import add_usable_arguments, load_usable, setting

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..core import TrackerConfig, Trajectory
    from ..evaluation import Evaluation
    from ..recording import Recording

HELP = "run one method on a bag and tell how good its two tracks are"
EXAMPLES = """\
examples:
  dualfoot evaluate walk                            the figures as a table; nothing is written
  dualfoot evaluate walk -o report                  also TUM files, plots and metrics.json
  dualfoot evaluate walk --method zupt --json       one JSON object on standard output
  dualfoot evaluate walk --set idc.distance=0.2     another value of one parameter
  dualfoot evaluate walk --set aids.barometer=true  height from the air pressure in the bag
  dualfoot evaluate lap --set aids.magnetic_heading=true   heading from its magnetic field
  dualfoot evaluate walk --reference markers.yaml   floor markers that are not in the bag's folder
  dualfoot evaluate walk --align umeyama4           best fit over the whole walk
  dualfoot evaluate walk --calibration both.yaml    correct the samples first
  dualfoot evaluate walk --calibration left=l.yaml --calibration right=r.yaml
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("bag", metavar="BAG", help="rosbag2 folder (or its one file)")
    parser.add_argument("--method", metavar="M", help="method by name (default: that of --config)")
    parser.add_argument(
        "--config", metavar="YAML", help="parameter file, or a preset of the package by name"
    )
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="one parameter by its dotted name; may be repeated, wins over --config",
    )
    parser.add_argument(
        "--calibration",
        metavar="FILE",
        action="append",
        default=[],
        help="calibration file of 'dualfoot calibrate', or left=FILE, right=FILE; may be repeated",
    )
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder for the files")
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else")
    parser.add_argument("--no-plots", action="store_true", help="write no figures to DIR")
    _add_alignment(parser)
    add_usable_arguments(parser)


def _add_alignment(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("reference and alignment")
    group.add_argument(
        "--reference",
        metavar="YAML",
        help="floor markers and the like (default: reference.yaml in the folder of the bag)",
    )
    group.add_argument(
        "--align",
        choices=("first_strides", "umeyama4"),
        default="first_strides",
        help="fix the frame by the start and the heading of the first metres, or by the best fit "
        "of yaw and position over the whole walk (default: %(default)s)",
    )
    group.add_argument(
        "--align-length",
        metavar="M",
        type=float,
        default=4.8,
        help="metres over which first_strides fits the heading (default: %(default)s)",
    )
    group.add_argument(
        "--align-feet",
        choices=("common", "each"),
        default="common",
        help="one transform for both feet, or one for each (truth only; default: %(default)s)",
    )


def run(args: argparse.Namespace) -> int:
    """Evaluate, write, print; return the exit code."""
    from ..calibration import calibrated, for_feet
    from ..evaluation import evaluate, track, truth_of
    from ..evaluation.reports import check_directory

    if args.output is not None:
        check_directory(args.output)
    options = _options(args)
    config = _config(args)
    calibration = for_feet(args.calibration)
    recording = _with_reference(load_usable(args.bag, args), args.reference)
    recording = calibrated(recording, calibration)
    trajectory = track(recording, config)
    found = evaluate(
        trajectory, truth=truth_of(recording), reference=recording.reference, options=options
    )
    found = replace(found, notes=(*found.notes, *_objections(recording, config, trajectory)))
    applied = {foot: list(sensor.triads()) for foot, sensor in calibration.items()}
    metrics = {"bag": args.bag, **found.to_dict(), "parameters": config.to_mapping()}
    metrics["calibration"] = applied
    paths = [] if args.output is None else _write(args, found, metrics)
    _print(args, found, {**metrics, "files": [str(path) for path in paths]}, paths)
    return 0


def _options(args: argparse.Namespace) -> Any:
    from ..evaluation import Align, EvaluationError, Options, Pair

    if not args.align_length > 0:
        raise EvaluationError(f"--align-length is {args.align_length:g}; allowed is more than 0 m")
    return Options(Align(args.align), Pair(args.align_feet), args.align_length)


def _config(args: argparse.Namespace) -> TrackerConfig:
    from ..settings import load_config

    overrides = dict(setting(text) for text in args.set)
    if args.method is not None:
        overrides["method"] = args.method
    return load_config(args.config, overrides)


def _with_reference(recording: Recording, path: str | None) -> Recording:
    from ..recording import Reference

    return recording if path is None else replace(recording, reference=Reference.load(path))


def _objections(
    recording: Recording, config: TrackerConfig, trajectory: Trajectory
) -> Iterator[str]:
    """Yield what tracks with nothing between the feet show to be wrong."""
    from ..core import METHODS
    from ..evaluation import track
    from ..inspection import free_config, walk_findings

    if METHODS[config.method].sensors_on_one_shoe:
        return
    free = free_config(config)
    tracks = trajectory if config == free else track(recording, free)
    for finding in walk_findings(tracks):
        yield f"warning: {finding.sentence}"


def _write(args: argparse.Namespace, found: Evaluation, metrics: dict[str, Any]) -> list[Path]:
    from ..evaluation.reports import staged, write_metrics, write_tracks

    with staged(args.output) as folder:
        paths = [write_metrics(folder, metrics), *write_tracks(folder, found)]
        if not args.no_plots:
            from ..evaluation.reports.plots import draw_all

            name = Path(args.bag).name
            paths += draw_all({found.trajectory.method: found}, folder, name)
    return [args.output / path.name for path in paths]


def _print(
    args: argparse.Namespace, found: Evaluation, metrics: dict[str, Any], paths: list[Path]
) -> None:
    from rich.console import Console

    from ..evaluation.reports import walk_table

    if args.json:
        print(json.dumps(metrics, allow_nan=False))
        return
    console = Console(highlight=False)
    if not console.is_terminal:
        console.width = 120
    console.print(walk_table(found, f"{args.bag}, method {found.trajectory.method}"))
    for note in found.notes:
        console.print(note)
    for path in paths:
        print(path)
