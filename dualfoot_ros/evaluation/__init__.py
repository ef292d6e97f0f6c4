"""Metrics, reports and plots of a walk: against truth, floor markers, or the feet themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..core import EvaluationError
from .evaluate import Evaluation, evaluate
from .frames.gauge import Options
from .frames.yaw_transform import Align, Pair
from .notes import config_notes
from .person_track import PersonTrack, person_track
from .plain import plain
from .published import published_trajectory
from .run import RunOptions, run
from .track import as_live, pair_samples, track, track_samples, track_walk, truth_of

if TYPE_CHECKING:
    from .reports.demo_table import Report, demo_report

__all__ = [
    "Align",
    "Evaluation",
    "EvaluationError",
    "Options",
    "Pair",
    "PersonTrack",
    "Report",
    "RunOptions",
    "as_live",
    "config_notes",
    "demo_report",
    "evaluate",
    "pair_samples",
    "person_track",
    "plain",
    "published_trajectory",
    "run",
    "track",
    "track_samples",
    "track_walk",
    "truth_of",
]


def __getattr__(name: str) -> Any:
    """Return a name of the reports, whose modules take a third of the time to import the rest."""
    if name not in ("Report", "demo_report"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from .reports import demo_table

    return getattr(demo_table, name)
