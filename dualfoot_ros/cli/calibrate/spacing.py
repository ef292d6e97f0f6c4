"""``dualfoot calibrate spacing``: c0, kappa and step width from a recorded walk."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..arguments import (
    add_config_arguments,
    add_recording_argument,
    add_usable_arguments,
    load_usable,
    recording_name,
    tracker_config,
)
from . import common

if TYPE_CHECKING:
    from ...calibration import SpacingFit

HELP = (
    "distance of the feet in passing (c0), moment of passing (kappa) and step width, from a walk"
)
FIRST = "  dualfoot calibrate spacing walk -o gait.yaml\n"
EXAMPLES = f"""\
examples:
{FIRST}\
  dualfoot evaluate walk --config gait.yaml
  dualfoot calibrate spacing walk --json

Walk round something, at best some turns to either side: on a straight line the distance of the
feet is unobservable, since the place where each track starts is unknown.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_recording_argument(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.yaml",
        help="parameter file to write, for --config and the nodes, with a figure beside it",
    )
    parser.add_argument("--overwrite", action="store_true", help="replace an existing FILE.yaml")
    add_config_arguments(parser, "; only gravity, alignment, stance and zupt count here")
    common.add_output_arguments(parser)
    add_usable_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Track without constraints, fit, write, print; return the exit code."""
    from ...calibration import CalibrationError, fit_spacing
    from ...evaluation import track
    from ...inspection import unconstrained_config
    from ...recording import check_file

    if args.output is not None:
        check_file(args.output, overwrite=args.overwrite)
    config = unconstrained_config(tracker_config(args))
    fit = fit_spacing(track(load_usable(args.bag, args), config), config)
    if fit.swapped:
        raise CalibrationError(_exchanged_message(fit))
    files = [] if args.output is None else _write(args, fit)
    lines = [*_lines(recording_name(args), fit), *map(str, files)]
    common.show(args, {**_facts(fit), "files": [str(f) for f in files]}, lines)
    if not fit.seen:
        common.warn(_unobservable_message(fit))
    return 0


def _exchanged_message(fit: SpacingFit) -> str:
    return (
        f"the left foot walks {-fit.feet.spacing_m:.2f} +- {fit.feet.std_m:.2f} m on the right of "
        "the right one, so the sensors are exchanged; exchange --left-topic and --right-topic"
    )


def _unobservable_message(fit: SpacingFit) -> str:
    return (
        f"the walk turned through {math.degrees(fit.feet.turned_rad):.0f} degrees, which leaves "
        f"the distance of the feet unknown ({fit.feet.spacing_m:.2f} +- {fit.feet.std_m:.2f} m): "
        "without turns the place where each track starts is unobservable, and over a long way the "
        "tracks drift; walk a few turns to either side within some 50 m. Only kappa is estimated"
    )


def _write(args: argparse.Namespace, fit: SpacingFit) -> list[Path]:
    from ...calibration import parameter_text
    from ...recording import write_text

    name = Path(recording_name(args)).name
    remarks = [f"The feet in passing, measured on '{name}' ('dualfoot calibrate spacing').", ""]
    remarks += [line.strip() for line in _lines(name, fit)]
    text = parameter_text(fit.parameters(), [r for r in remarks if r])
    return common.write_with_figure(
        args.output,
        lambda path: write_text(path, text),
        common.figure_path(args.output, "passing"),
        None if args.no_plots else partial(_draw, fit, name),
    )


def _draw(fit: SpacingFit, name: str, path: Path) -> None:
    from ...calibration.plots import draw_spacing

    draw_spacing(fit, path, name)


def _lines(name: str, fit: SpacingFit) -> Iterator[str]:
    feet = fit.feet
    yield (
        f"{name}: the feet pass {len(fit.passings)} times, the walk turns through "
        f"{math.degrees(feet.turned_rad):.0f} degrees"
    )
    if fit.seen:
        yield f"  lateral distance in passing {feet.spacing_m:.3f} +- {feet.std_m:.3f} m"
        yield f"  c0 {fit.c0_m:.3f} m, the swinging foot being {fit.height_m:.3f} m up"
        yield f"  step width {fit.step_width_m:.3f} m"
    else:
        yield "  c0 and step width: not observable on this walk"
    if math.isfinite(feet.scatter_m):
        yield f"  the distance varies by {feet.scatter_m:.3f} m from step to step"
    else:
        yield "  how it varies from step to step: not observable, the walk is nowhere straight"
    yield f"  kappa {fit.kappa:.3f}, from step to step +- {fit.kappa_std:.3f}"


def _facts(fit: SpacingFit) -> dict[str, Any]:
    feet, seen = fit.feet, fit.seen
    return {
        "seen": seen,
        "spacing_m": feet.spacing_m if seen else None,
        "spacing_std_m": feet.std_m,
        "step_to_step_m": feet.scatter_m,
        "c0_m": fit.c0_m if seen else None,
        "height_m": fit.height_m,
        "step_width_m": fit.step_width_m if seen else None,
        "kappa": fit.kappa,
        "kappa_std": fit.kappa_std,
        "passings": len(fit.passings),
        "turned_deg": math.degrees(feet.turned_rad),
        "parameters": fit.parameters(),
    }
