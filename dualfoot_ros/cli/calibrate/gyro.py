"""``dualfoot calibrate gyro``: bias and its uncertainty, noise from the Allan deviation."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import common

if TYPE_CHECKING:
    from ...calibration import GyroFit

HELP = "gyro bias from a standstill, and the noise of gyro and accelerometer from a long one"
FIRST = "  dualfoot calibrate gyro night.csv --foot right -o right.yaml\n"
EXAMPLES = f"""\
examples:
{FIRST}\
  dualfoot calibrate gyro desk -o both.yaml                         a bag of both sensors
  dualfoot calibrate gyro desk --parameters noise.yaml              noise.* for --config
  dualfoot calibrate gyro desk --json

A few seconds give the bias, minutes the white noise, hours the bias instability and the driving
noise of the bias. Walking adds scale factor errors and the shocks of the steps, so noise.yaml is a
lower bound, not a recommendation.
"""
DEG = 180.0 / math.pi


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    common.add_sensor_arguments(parser)
    parser.add_argument(
        "--parameters",
        type=Path,
        metavar="FILE.yaml",
        help="write the noise parameters of the filter, as far as the standstill shows them",
    )
    parser.add_argument(
        "--overwrite", action="store_true", help="replace an existing file of --parameters"
    )


def run(args: argparse.Namespace) -> int:
    """Fit, write, print; return the exit code."""
    from ...calibration import fit_gyro

    common.check_parameters(args)
    calibration = common.existing(args.output)
    loaded = common.load(args)
    fits = {name: fit_gyro(sources) for name, sources in loaded.items()}
    noise = _noise(fits)
    files = [] if args.parameters is None else [_write_parameters(args.parameters, fits, noise)]
    if args.output is not None:
        for name, fit in fits.items():
            calibration = calibration.with_triad(name, "gyro", fit.triad())
        files += common.write_with_figure(
            args.output,
            calibration.save,
            common.figure_path(args.output, "allan", list(fits)),
            None if args.no_plots else partial(_draw, fits),
        )
    lines = [line for name, fit in fits.items() for line in _lines(name, fit)]
    lines += [f"{name}: {value:.3g}" for name, value in noise.items()]
    facts = {name: _facts(fit) for name, fit in fits.items()}
    shown = {**facts, "parameters": noise, "files": [str(f) for f in files]}
    common.show(args, shown, [*lines, *map(str, files)])
    common.warn_of_doubts(loaded, "gyro")
    for name, fit in fits.items():
        for sentence in fit.unseen():
            common.warn(f"{name}: {sentence}")
    return 0


def _noise(fits: dict[str, GyroFit]) -> dict[str, float]:
    """Return the parameters that every sensor shows, those of the worst one."""
    from ...core import NoiseConfig

    parameters = [fit.noise(NoiseConfig().bias_time) for fit in fits.values()]
    shared = [name for name in parameters[0] if all(name in other for other in parameters)]
    return {name: max(other[name] for other in parameters) for name in shared}


def _write_parameters(path: Path, fits: dict[str, GyroFit], noise: dict[str, float]) -> Path:
    from ...calibration import CalibrationError, parameter_text
    from ...recording import write_text

    seconds = min(fit.standstill.duration_s for fit in fits.values())
    if not noise:
        raise CalibrationError(
            f"{seconds:.1f} s of standstill show no noise parameter, so '{path}' is not written; "
            "record some minutes for the white noise, some hours for the rest"
        )
    remarks = [
        f"Noise at rest, from the Allan deviation of {seconds:.0f} s ('dualfoot calibrate gyro').",
        "A lower bound: walking adds scale factors and shocks (docs/explanation/calibration.md).",
    ]
    rounded = {name: float(f"{value:.3g}") for name, value in noise.items()}
    write_text(path, parameter_text(rounded, remarks))
    return path


def _draw(fits: dict[str, GyroFit], path: Path) -> None:
    from ...calibration.plots import draw_allan

    draw_allan(fits, path)


def _lines(name: str, fit: GyroFit) -> Iterator[str]:
    still = fit.standstill
    yield f"{name}: standstill of {still.duration_s:.1f} s, {still.rate_hz:.1f} Hz"
    yield (
        f"  gyro bias {common.numbers(fit.bias, 6)} rad/s, "
        f"{common.numbers(fit.bias * DEG, 4)} deg/s"
    )
    yield (
        f"  +- {common.numbers(fit.bias_std, 6)} rad/s in this standstill; the next switching-on "
        "has another bias, which the filter measures anew from every stand"
    )
    for triad, axes in fit.slopes.items():
        for label, unit, values in (
            ("white noise N", "1/sqrt(Hz)", [s.white for s in axes]),
            ("bias instability B", "", [s.floor for s in axes]),
            ("random walk K", "1/sqrt(s)", [s.walk for s in axes]),
        ):
            figures = ", ".join("-" if v is None else f"{v:.3g}" for v in values)
            base = "rad/s" if triad == "gyro" else "m/s^2"
            yield f"  {triad:<13} {label:<19} x, y, z: {figures} {base} {unit}".rstrip()


def _facts(fit: GyroFit) -> dict[str, Any]:
    from dataclasses import asdict

    return {
        "bias": fit.bias,
        "bias_std": fit.bias_std,
        "duration_s": fit.standstill.duration_s,
        "slopes": {triad: [asdict(s) for s in axes] for triad, axes in fit.slopes.items()},
        "allan": {
            triad: {"tau": curve.tau, "deviation": curve.deviation}
            for triad, curve in fit.curves.items()
        },
        "unseen": list(fit.unseen()),
    }
