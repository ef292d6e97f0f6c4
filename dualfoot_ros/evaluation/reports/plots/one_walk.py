"""Draw every figure that the known references allow."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ....core import FEET
from ...exports import FloorPlan
from ...whole_evaluation import Evaluation
from .distance import draw_distance
from .error_curves import draw_errors, draw_marker_errors
from .stances import draw_stances
from .tracks import draw_tracks


def draw_all(
    runs: Mapping[str, Evaluation],
    directory: Path,
    title: str,
    floor_plan: FloorPlan | None = None,
) -> list[Path]:
    """Draw the figures of one or more runs of the same walk and return their paths."""
    first = next(iter(runs.values()))
    distance = []
    if len(first.tracked_feet) == len(FEET):
        distance.append(draw_distance(runs, directory / "feet_distance.png", title))
    paths = [
        draw_tracks(runs, directory / "tracks.png", title, floor_plan),
        *distance,
        draw_stances(first, directory / "stances.png", title),
    ]
    if first.truth is not None:
        paths.append(draw_errors(runs, directory / "errors.png", title))
    if any(report.errors_m for run in runs.values() for report in run.marker_report.values()):
        paths.append(draw_marker_errors(runs, directory / "marker_errors.png", title))
    return paths
