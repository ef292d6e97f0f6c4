"""``dualfoot calibrate walk``: gyro matrices of both sensors from ordinary walks."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import (
    BAG,
    add_config_arguments,
    add_usable_arguments,
    load_usable,
    tracker_config,
)
from ..printing import progress
from . import common
from .walk_lines import result_facts, result_lines

if TYPE_CHECKING:
    from ...calibration import Calibration, PivotFit, SensorCalibration, WalkCalibration
    from ...recording import Reference

HELP = "scale and misalignment of both gyros from ordinary walks, without any known point"
FIRST = "  dualfoot calibrate walk eights/* -o both.yaml\n"
EXAMPLES = f"""\
examples:
{FIRST}\
  dualfoot evaluate lap --calibration both.yaml
  dualfoot calibrate walk eights/* -o both.yaml --parameters pivot.yaml
  dualfoot calibrate walk eights/* --json

Stand still for some seconds, then walk a figure of eight with tight turns, both ways round, for
one to two minutes; several walks are better than one. Calibrate the accelerometers into the same
FILE.yaml first. Loops and floor markers in reference.yaml are not used but checked: errors before
and after, each walk with the matrix of the other walks.
"""
LARGEST_MISALIGNMENT = 0.1  # rad


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "bags", nargs="+", metavar="BAG", help=f"{BAG} of a walk with both sensors"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.yaml",
        help="calibration file to write; accelerometers and gyro biases that it holds already "
        "are used and kept",
    )
    parser.add_argument(
        "--parameters",
        type=Path,
        metavar="FILE.yaml",
        help="write the pivot of the foot that suits the loops (zupt.lever_back; with floor "
        "markers zupt.lever_arm too)",
    )
    parser.add_argument(
        "--overwrite", action="store_true", help="replace an existing file of --parameters"
    )
    parser.add_argument(
        "--misalignment",
        type=float,
        metavar="RAD",
        help="what the axes of an accelerometer may be off, by its sheet, where that is not "
        "calibrated (default: 0.003)",
    )
    add_config_arguments(parser, "; of the checks; stances and pivot count for the fit")
    common.add_output_arguments(parser)
    add_usable_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Fit, check, write, print; return the exit code."""
    from ...calibration import MISALIGNMENT, calibrate_walks, fit_pivot

    misalignment = _misalignment(args, MISALIGNMENT)
    config = tracker_config(args)
    existing = common.existing(args.output)
    common.check_parameters(args)
    recordings = [(Path(path).name, load_usable(path, args)) for path in args.bags]
    _check_loops(args, [each.reference for _, each in recordings])
    given = _given(existing)
    with progress("calibrating") as update:
        result = calibrate_walks(
            recordings, config, given, misalignment=misalignment, progress=update
        )
        sensors = result.sensors(given)
        pivot = fit_pivot([each for _, each in recordings], config, sensors)
    files = _write(args, existing, result, pivot)
    lines = [*result_lines(result, pivot), *map(str, files)]
    facts = {**result_facts(result, pivot), "files": [str(f) for f in files]}
    common.show(args, facts, lines)
    for name, foot in result.feet.items():
        for sentence in foot.remarks():
            common.warn(f"{name}: {sentence}")
    return 0


def _misalignment(args: argparse.Namespace, usual: float) -> float:
    from ...calibration import CalibrationError

    value = usual if args.misalignment is None else float(args.misalignment)
    if not 0.0 <= value <= LARGEST_MISALIGNMENT:
        raise CalibrationError(
            f"--misalignment is {value:g}; allowed is 0 to {LARGEST_MISALIGNMENT:g} rad"
        )
    return value


def _check_loops(args: argparse.Namespace, references: Sequence[Reference | None]) -> None:
    """Refuse a file for the pivot where none can be found, before the minutes of the fit."""
    from ...calibration import CalibrationError

    if args.parameters is not None and not any(each and each.closed_loop for each in references):
        raise CalibrationError(
            "no walk is a loop by its reference.yaml, so the pivot is not observable and "
            f"'{args.parameters}' is not written; see 'closed_loop' in the files reference"
        )


def _given(existing: Calibration) -> dict[str, SensorCalibration]:
    from ...core import FEET

    return {foot: sensor for foot in FEET if (sensor := existing.sensors.get(foot)) is not None}


def _write(
    args: argparse.Namespace,
    existing: Calibration,
    result: WalkCalibration,
    pivot: PivotFit | None,
) -> list[Path]:
    from ...calibration import parameter_text
    from ...recording import write_text

    files = []
    if args.output is not None:
        calibration = existing
        for name, foot in result.feet.items():
            calibration = calibration.with_triad(name, "gyro", foot.triad())
        calibration.save(args.output)
        files.append(args.output)
    if args.parameters is not None:
        assert pivot is not None  # there is a loop
        remarks = ["The pivot of the foot from loops ('dualfoot calibrate walk')."]
        write_text(args.parameters, parameter_text(pivot.parameters(), remarks))
        files.append(args.parameters)
    return files
