"""``dualfoot calibrate accelerometer``: bias, scale and misalignment from attitudes at rest."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...core import STANDARD_GRAVITY
from . import common

if TYPE_CHECKING:
    from ...calibration import AccelerometerFit, CrossValidation, Segment

    Result = tuple[AccelerometerFit, list[Segment], CrossValidation]

HELP = "bias, scale and misalignment of accelerometers held still in six or more attitudes"
GRAVITY = (9.7, 9.9)  # m/s^2, anywhere on Earth
FIRST = "  dualfoot calibrate accelerometer A*.csv -o right.yaml\n"
EXAMPLES = f"""\
examples:
{FIRST}\
  dualfoot calibrate accelerometer B*.csv --foot left -o both.yaml
  dualfoot calibrate accelerometer A*.csv --foot right -o both.yaml      adds the other foot
  dualfoot calibrate accelerometer tumbled -o both.yaml                  a bag of both sensors
  dualfoot calibrate accelerometer A*.csv --gravity 9.8189 --json
  dualfoot evaluate walk --calibration both.yaml

Hold the sensor still for some seconds in each attitude: every axis once up and once down gives
bias and scale; edges and corners as well (nine attitudes or more) give misalignment too.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    common.add_sensor_arguments(parser)
    parser.add_argument(
        "--model",
        choices=("auto", "full", "scale", "bias"),
        default="auto",
        help="parameters to estimate: bias; bias and scale; or also misalignment (full); auto "
        "takes the larger of the last two that the attitudes determine (default: %(default)s)",
    )
    parser.add_argument(
        "--gravity",
        type=float,
        default=STANDARD_GRAVITY,
        metavar="M/S^2",
        help="local gravity, the same as in the filter's configuration (default: %(default)s)",
    )


def run(args: argparse.Namespace) -> int:
    """Fit, write, print; return the exit code."""
    from ...calibration import CalibrationError

    if not GRAVITY[0] <= args.gravity <= GRAVITY[1]:
        raise CalibrationError(
            f"--gravity is {args.gravity:g}; allowed is {GRAVITY[0]:g} to {GRAVITY[1]:g} m/s^2"
        )
    calibration = common.existing(args.output)
    loaded = common.load(args)
    results = {name: _fit(name, sources, args) for name, sources in loaded.items()}
    files: list[Path] = []
    if args.output is not None:
        for name, (fit, _, _) in results.items():
            calibration = calibration.with_triad(name, "accelerometer", fit.triad())
        files = common.write_with_figure(
            args.output,
            calibration.save,
            common.figure_path(args.output, "accelerometer", list(results)),
            None if args.no_plots else partial(_draw, results),
        )
    lines = [line for name, result in results.items() for line in _lines(name, *result)]
    facts = {name: _facts(*result) for name, result in results.items()}
    common.show(args, {**facts, "files": [str(f) for f in files]}, [*lines, *map(str, files)])
    common.warn_of_doubts(loaded, "accelerometer")
    for name, (fit, _, _) in results.items():
        if fit.doubtful:
            common.warn(
                f"{name}: the residuals are large; were all recordings of the same sensor, was it "
                "still, and is --gravity right?"
            )
    return 0


def _fit(name: str, sources: list[tuple[str, Any]], args: argparse.Namespace) -> Result:
    from ...calibration import CalibrationError, cross_validate, fit_accelerometer, segments_of

    segments = [s for label, series in sources for s in segments_of(series, label)]
    try:
        fit = fit_accelerometer(segments, args.model, args.gravity)
    except CalibrationError as error:
        raise CalibrationError(f"{name}: {error}") from None
    return fit, segments, cross_validate(segments, fit)


def _draw(results: dict[str, Result], path: Path) -> None:
    from ...calibration.plots import draw_residuals

    fits = {name: (fit, segments) for name, (fit, segments, _) in results.items()}
    draw_residuals(fits, path)


def _lines(
    name: str, fit: AccelerometerFit, segments: list[Segment], check: CrossValidation
) -> Iterator[str]:
    from ...calibration import MODELS, rms, why_not

    yield (
        f"{name}: {MODELS[fit.model].words} from {len(segments)} standstills in {fit.attitudes} "
        "attitudes"
    )
    yield f"  bias   {common.numbers(fit.bias, 4)} m/s^2, +- {fit.bias_std.max():.4f}"
    for row, title in zip(fit.matrix, ("  matrix", "", ""), strict=True):
        yield f"{title:<8} {common.numbers(row, 5)}"
    width = max(len(s.name) for s in segments)
    yield f"  {'':<{width}}  seconds  |f| - g before   after (m/s^2)"
    rows = zip(segments, fit.residual_before, fit.residual_after, strict=True)
    for segment, before, after in rows:
        figures = f"{segment.duration_s:7.1f}  {before:+14.4f}  {after:+.4f}"
        yield f"  {segment.name:<{width}}  {figures}"
    yield (
        f"  RMS residual {rms(fit.residual_before):.4f} before, {rms(fit.residual_after):.4f} "
        f"m/s^2 after{_why_zero(fit)}"
    )
    yield f"  {check.sentence()}"
    if fit.model == "scale":
        yield f"  no misalignment: {why_not(segments, MODELS['full'], fit.gravity)}"


def _why_zero(fit: AccelerometerFit) -> str:
    if not fit.zero_by_construction:
        return ""
    return (
        f" (zero by construction: {fit.attitudes} attitudes for as many parameters, so it "
        "proves nothing)"
    )


def _facts(
    fit: AccelerometerFit, segments: list[Segment], check: CrossValidation
) -> dict[str, Any]:
    from dataclasses import asdict

    named = [{"name": s.name, "duration_s": s.duration_s, "mean": s.mean} for s in segments]
    return {**asdict(fit), "standstills": named, "cross_validation": asdict(check)}
