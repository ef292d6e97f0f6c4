"""Arguments, sources and output that the kinds of ``dualfoot calibrate`` share."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...core import FEET, FORWARD_LEFT_UP
from ..arguments import (
    add_json_argument,
    add_no_plots_argument,
    add_topic_arguments,
)
from ..printing import print_json, print_warning, progress
from ..table_options import add_single_table_arguments, given_layout, known_layout

if TYPE_CHECKING:
    from ...calibration import Calibration
    from ...core import ImuSeries
    from ...recording import Topics


def add_sensor_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the sources of sensors at rest and the file to write."""
    parser.add_argument(
        "source",
        nargs="+",
        type=Path,
        metavar="SOURCE",
        help="tables of one sensor (.csv and the like), or bags",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.yaml",
        help="calibration file to write, with a figure beside it; a calibration file that is "
        "there already is added to",
    )
    parser.add_argument(
        "--foot", choices=("left", "right"), help="foot the exports are of, or the one of a bag"
    )
    parser.add_argument(
        "--axes",
        default=FORWARD_LEFT_UP,
        metavar="AXES",
        help="device axes that point forward, left and up, as in 'dualfoot import' "
        "(exports only; default: %(default)s)",
    )
    add_single_table_arguments(parser)
    add_output_arguments(parser)
    add_topic_arguments(parser)


def add_output_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--json`` and ``--no-plots``."""
    add_json_argument(parser)
    add_no_plots_argument(parser, "draw no figure")


def load(args: argparse.Namespace) -> dict[str, list[tuple[str, ImuSeries]]]:
    """Read the sources by sensor."""
    from ...calibration import load_sources
    from ...recording.importers import ImportOptions

    tables = ImportOptions(
        force_unit=args.force_unit,
        rate_unit=args.rate_unit,
        layout=given_layout(args),
        known_layout=known_layout(args),
    )
    topics = _topics(args)
    with progress("reading"):
        return load_sources(args.source, args.foot, axes=args.axes, topics=topics, tables=tables)


def _topics(args: argparse.Namespace) -> Topics | None:
    """Return the topics that ``args`` names; None to find them in each bag by their names."""
    from ...recording import choose_topics

    given = {foot: getattr(args, f"{foot}_topic") for foot in FEET}
    return choose_topics({}, given).topics if any(given.values()) else None


def existing(path: Path | None) -> Calibration:
    """Return the calibration that ``path`` holds already; refuse any other file."""
    from ...calibration import Calibration
    from ...recording import check_file

    if path is None or not path.exists():
        return Calibration()
    check_file(path, overwrite=True)  # a device could be read without end
    return Calibration.load(path)


def check_parameters(args: argparse.Namespace) -> None:
    """Refuse a parameter file that would replace something else."""
    from ...calibration import CalibrationError
    from ...recording import check_file

    if args.parameters is None:
        return
    if args.output is not None and args.parameters.resolve() == args.output.resolve():
        raise CalibrationError(
            f"-o and --parameters both name '{args.parameters}'; a calibration and parameters of "
            "the filter are two files, so choose another name for one of them"
        )
    check_file(args.parameters, overwrite=args.overwrite)


def figure_path(output: Path, subject: str, sensors: Sequence[str] = ()) -> Path:
    """Return where the figure beside ``output`` goes; one foot alone has its name in it."""
    one = len(sensors) == 1 and sensors[0] in FEET and sensors[0] not in output.stem
    foot = f"{sensors[0]}_" if one else ""
    return output.with_name(f"{output.stem}_{foot}{subject}.png")


def write_with_figure(
    output: Path,
    write: Callable[[Path], object],
    figure: Path,
    draw: Callable[[Path], object] | None,
) -> list[Path]:
    """Write ``output`` and draw the figure beside it, both or none; return what was written."""
    from ...recording import new_file

    if draw is None:
        write(output)
        return [output]
    with new_file(output) as written, new_file(figure) as drawn:
        draw(drawn)
        write(written)
    return [output, figure]


def show(args: argparse.Namespace, facts: Mapping[str, Any], lines: list[str]) -> None:
    """Print ``facts`` as JSON or ``lines`` for people."""
    if args.json:
        print_json(facts)
    else:
        print("\n".join(lines))


def warn(sentence: str) -> None:
    """Print a warning on standard error."""
    print_warning("calibrate", sentence)


def warn_of_doubts(loaded: Mapping[str, Sequence[tuple[str, ImuSeries]]], triad: str) -> None:
    """Print what is wrong with recordings from which ``triad`` was calibrated all the same."""
    from ...calibration import doubts, still_spans
    from ...timing import clean

    for name, series in (named for sources in loaded.values() for named in sources):
        good = clean(series).series
        for sentence in doubts(series, name, triad, [good[s] for s in still_spans(good)]):
            warn(sentence)


def numbers(values: Any, digits: int) -> str:
    """Return a vector as text."""
    return "(" + ", ".join(f"{v:+.{digits}f}" for v in values) + ")"
