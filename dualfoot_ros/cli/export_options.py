"""Options of ``dualfoot evaluate`` for the track in the formats of other programs."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from .arguments import recording_name

if TYPE_CHECKING:
    from ..evaluation import Evaluation
    from ..evaluation.exports import FloorPlan, GeoOrigin


@dataclass(frozen=True)
class ExportOptions:
    """What is written beside figures and tracks: on the map, as a bag, on a floor plan."""

    name: str
    origin: GeoOrigin | None
    estimate_bag: bool
    floor_plan: FloorPlan | None

    @classmethod
    def of(cls, args: argparse.Namespace) -> ExportOptions:
        """Read the options.

        Raises
        ------
        EvaluationError
            When one is not understood, needs another one, or needs ``-o``.
        OSError
            When the floor plan cannot be read.
        """
        from ..evaluation import EvaluationError
        from ..evaluation.exports import FloorPlan, GeoOrigin

        given = [name for name in OPTIONS if getattr(args, name) not in (None, False)]
        if given and args.output is None:
            option = given[0].replace("_", "-")
            raise EvaluationError(f"--{option} writes a file; give -o DIR too")
        origin = None if args.origin is None else GeoOrigin.parse(args.origin)
        plan = None
        if args.floor_plan is not None:
            plan = FloorPlan.load(args.floor_plan, args.scale, args.start_pixel)
        elif args.scale is not None or args.start_pixel is not None:
            raise EvaluationError(
                "--scale and --start-pixel belong to --floor-plan, which is missing"
            )
        return cls(Path(recording_name(args)).name, origin, args.estimate_bag, plan)


OPTIONS = ("origin", "estimate_bag", "floor_plan")


def add_export_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    group = parser.add_argument_group("exports, beside the report in DIR")
    group.add_argument(
        "--origin",
        metavar="LAT,LON[,HEADING]",
        help="where the walk starts, degrees WGS 84, and the compass bearing of its first metres: "
        "also write person.geojson, person.kml and person.gpx",
    )
    group.add_argument(
        "--estimate-bag",
        action="store_true",
        help="also write odometry and paths as an MCAP bag, DIR/estimate_bag",
    )
    group.add_argument(
        "--floor-plan", metavar="PNG", help="picture under the track in report.html"
    )
    group.add_argument(
        "--scale", metavar="M", type=float, help="metres for one pixel of the floor plan"
    )
    group.add_argument(
        "--start-pixel",
        metavar="COLUMN,ROW[,DEG]",
        help="where the walk starts on the floor plan, and the direction of its first metres "
        "(0 right, 90 up)",
    )


def write_exports(folder: Path, result: Evaluation, options: ExportOptions) -> list[Path]:
    """Write the person's track, and what ``options`` ask for; return the paths."""
    from ..evaluation.exports import write_estimate_bag, write_geo_files, write_person

    paths = write_person(folder, result.person)
    if options.origin is not None:
        paths += write_geo_files(folder, result.person, options.origin, options.name)
    if options.estimate_bag:
        paths.append(write_estimate_bag(folder, result.trajectory, result.person))
    return paths
