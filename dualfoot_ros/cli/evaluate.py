"""``dualfoot evaluate``: one method on one bag; figures, TUM files, plots."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import (
    add_align_argument,
    add_calibration_argument,
    add_config_arguments,
    add_json_argument,
    add_method_argument,
    add_no_plots_argument,
    add_paper_noise_argument,
    add_recording_argument,
    add_report_arguments,
    add_usable_arguments,
    load_bag,
    recording_name,
    tracker_config,
)
from .export_options import ExportOptions, add_export_arguments, write_exports
from .printing import print_json, print_paths, table_console
from .self_calibration import self_calibration

if TYPE_CHECKING:
    from ..calibration import BiasMemory
    from ..evaluation import Evaluation, RunOptions
    from ..recording import Correction, Recording

HELP = "run one method on a bag and evaluate the tracks of both feet"
EXAMPLES = """\
examples:
  dualfoot evaluate walk                            the figures as a table; nothing is written
  dualfoot evaluate walk -o report                  also report.html, TUM files, metrics.json ...
  dualfoot evaluate walk -o report --origin 48.1486,11.5680,90   also GeoJSON, KML, GPX
  dualfoot evaluate walk -o report --floor-plan hall.png --scale 0.02 --start-pixel 310,940,90
  dualfoot evaluate walk --method zupt --json       one JSON object on standard output
  dualfoot evaluate walk --set idc.distance=0.2     another value of one parameter
  dualfoot evaluate walk --set aids.barometer=true  height from the air pressure in the bag
  dualfoot evaluate lap --set aids.magnetic_heading=true   heading from its magnetic field
  dualfoot evaluate walk --reference markers.yaml   floor markers that are not in the bag's folder
  dualfoot evaluate walk --align umeyama4           best fit over the whole walk
  dualfoot evaluate walk --bias-memory shoes.yaml   use and keep the gyro biases of these sensors
  dualfoot evaluate walk --calibration both.yaml    correct the samples first
  dualfoot evaluate walk --calibration left=l.yaml --calibration right=r.yaml
  dualfoot evaluate walk --config liu2023 --paper-noise    with the paper's own noise and c0
  dualfoot evaluate walk --self-calibrate           gyro matrices from the walk itself
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    add_recording_argument(parser)
    add_method_argument(parser)
    add_config_arguments(parser)
    add_paper_noise_argument(parser)
    add_calibration_argument(parser)
    parser.add_argument(
        "--self-calibrate",
        action="store_true",
        help="fit the gyro matrices on the walk itself ('dualfoot calibrate walk') and use them",
    )
    parser.add_argument(
        "--bias-memory",
        metavar="FILE",
        type=Path,
        help="gyro biases that earlier walks of these sensors told; what this one tells is added",
    )
    parser.add_argument(
        "--feet",
        choices=("both", "left", "right"),
        default="both",
        help="track one foot alone; with both, a foot that is missing is said (default: both)",
    )
    add_report_arguments(parser)
    add_json_argument(parser)
    add_no_plots_argument(parser)
    _add_alignment(parser)
    add_export_arguments(parser)
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
    from ..calibration import BiasMemory, for_feet
    from ..evaluation.reports import check_directory
    from ..recording import keep_large_arrays_on_disk

    ExportOptions.of(args)  # refused before the work is done
    if args.output is not None:
        check_directory(args.output, overwrite=args.overwrite)
    keep_large_arrays_on_disk()
    calibration = for_feet(args.calibration)
    memory = BiasMemory() if args.bias_memory is None else BiasMemory.load(args.bias_memory)
    config = tracker_config(args)
    recordings = [load_bag(args.bag, args)]
    notes: tuple[str, ...] = ()
    if args.self_calibrate:
        calibration, notes = self_calibration(args, recordings[0], config, calibration)
    if args.bias_memory is not None:
        memory = memory.without(*_span(recordings[0]))
    options = replace(_options(args, calibration), priors=memory.priors())
    result = evaluation.run(recordings.pop(), config, options)  # its samples are needed no more
    result = replace(result, notes=(*notes, *result.notes))
    metrics = {
        "bag": recording_name(args),
        **result.to_dict(),
        "parameters": config.to_mapping(),
        "calibration": {foot: list(c.triads()) for foot, c in calibration.items()},
        "self_calibrated": args.self_calibrate,
    }
    result = replace(result, tracked=result.trajectory)  # its figures are taken: an hour is 120 MB
    paths = [] if args.output is None else _write(args, result, metrics)
    _remember(args.bias_memory, memory, result)
    _print(args, result, {**metrics, "files": [str(path) for path in paths]}, paths)
    return 0


def _span(recording: Recording) -> tuple[int, int]:
    """Return the first and the last stamp of a recording, ns; 0 without samples."""
    feet = [imu for imu in (recording.left, recording.right) if imu is not None and len(imu)]
    begin = min((int(imu.stamp_ns.min()) for imu in feet), default=0)
    return begin, max((int(imu.stamp_ns.max()) for imu in feet), default=0)


def _remember(path: Path | None, memory: BiasMemory, result: Evaluation) -> None:
    """Add to the memory what the stands of the walk have told, if there is one."""
    from ..calibration import stands_of

    if path is None:
        return
    for foot, stand in stands_of(result.trajectory).items():
        memory.remember(foot, stand)
    memory.save(path)


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
        feet=args.feet,
        all_covariances=args.estimate_bag,
    )


def _write(args: argparse.Namespace, result: Evaluation, metrics: dict[str, Any]) -> list[Path]:
    from ..evaluation.reports import (
        METRICS,
        report_folder,
        write_json,
        write_strides,
        write_tracks,
    )

    exports = ExportOptions.of(args)
    with report_folder(args.output) as folder:
        paths = [write_json(folder / METRICS, metrics), *write_tracks(folder, result)]
        paths.append(write_strides(folder, result))
        paths += write_exports(folder, result, exports)
        if not args.no_plots:
            paths += _draw(args, folder, result, metrics["parameters"], exports)
    return [args.output / path.name for path in paths]


def _draw(
    args: argparse.Namespace,
    folder: Path,
    result: Evaluation,
    parameters: Mapping[str, Any],
    exports: ExportOptions,
) -> list[Path]:
    from ..evaluation.reports.html import write_walk_page
    from ..evaluation.reports.plots import draw_all

    runs, title = {result.trajectory.method: result}, Path(recording_name(args)).name
    page = write_walk_page(folder, runs, title, parameters, exports.floor_plan, exports.origin)
    return [*draw_all(runs, folder, title, exports.floor_plan), page]


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
