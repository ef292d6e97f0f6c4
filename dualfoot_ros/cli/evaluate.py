"""``dualfoot evaluate``: one method on one bag; figures, TUM files, plots."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import (
    add_align_argument,
    add_config_arguments,
    add_json_argument,
    add_method_argument,
    add_no_plots_argument,
    add_recording_argument,
    add_report_arguments,
    add_usable_arguments,
    load_bag,
    recording_name,
    tracker_config,
)
from .printing import print_json, print_paths, table_console

if TYPE_CHECKING:
    from ..evaluation import Evaluation, RunOptions
    from ..recording import Correction

HELP = "run one method on a bag and evaluate the tracks of both feet"
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
    add_recording_argument(parser)
    add_method_argument(parser)
    add_config_arguments(parser)
    parser.add_argument(
        "--calibration",
        metavar="FILE",
        action="append",
        default=[],
        help="calibration file of 'dualfoot calibrate', or left=FILE, right=FILE; may be repeated",
    )
    add_report_arguments(parser)
    add_json_argument(parser)
    add_no_plots_argument(parser)
    _add_alignment(parser)
    add_usable_arguments(parser)


def _add_alignment(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("reference and alignment")
    group.add_argument(
        "--reference",
        metavar="YAML",
        help="floor markers and the like (default: reference.yaml in the folder of the bag)",
    )
    add_align_argument(
        group,
        "fix the frame by the start and the heading of the first metres, or by the best fit of "
        "yaw and position over the whole walk",
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
    from .. import evaluation
    from ..calibration import for_feet
    from ..evaluation.reports import check_directory

    if args.output is not None:
        check_directory(args.output)
    calibration = for_feet(args.calibration)
    options = _options(args, calibration)
    config = tracker_config(args)
    result = evaluation.run(load_bag(args.bag, args), config, options)
    metrics = {
        "bag": recording_name(args),
        **result.to_dict(),
        "parameters": config.to_mapping(),
        "calibration": {foot: list(c.triads()) for foot, c in calibration.items()},
    }
    paths = [] if args.output is None else _write(args, result, metrics)
    _print(args, result, {**metrics, "files": [str(path) for path in paths]}, paths)
    return 0


def _options(args: argparse.Namespace, calibration: Mapping[str, Correction]) -> RunOptions:
    from ..evaluation import Align, EvaluationError, Options, Pair, RunOptions
    from ..recording import Reference

    if not args.align_length > 0:
        raise EvaluationError(f"--align-length is {args.align_length:g}; allowed is more than 0 m")
    return RunOptions(
        alignment=Options(Align(args.align), Pair(args.align_feet), args.align_length),
        reference=None if args.reference is None else Reference.load(args.reference),
        calibration=calibration,
        allow_not_finite=args.allow_nan,
    )


def _write(args: argparse.Namespace, result: Evaluation, metrics: dict[str, Any]) -> list[Path]:
    from ..evaluation.reports import METRICS, report_folder, write_json, write_tracks

    with report_folder(args.output) as folder:
        paths = [write_json(folder / METRICS, metrics), *write_tracks(folder, result)]
        if not args.no_plots:
            from ..evaluation.reports.plots import draw_all

            paths += draw_all(
                {result.trajectory.method: result}, folder, Path(recording_name(args)).name
            )
    return [args.output / path.name for path in paths]


def _print(
    args: argparse.Namespace, result: Evaluation, metrics: dict[str, Any], paths: list[Path]
) -> None:
    from ..evaluation.reports import walk_table

    if args.json:
        print_json(metrics)
        return
    console = table_console()
    console.print(walk_table(result, f"{recording_name(args)}, method {result.trajectory.method}"))
    for note in result.notes:
        console.print(note)
    print_paths(paths)
