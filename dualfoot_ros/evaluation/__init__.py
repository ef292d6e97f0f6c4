"""Metrics, reports and plots of a walk: against truth, floor markers, or the feet themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..core import EvaluationError
from ..lazy_face import lazy_face
from .plain import plain
from .track import as_live, pair_samples, track, track_samples, track_walk, truth_of

if TYPE_CHECKING:
    from .frames.gauge import Options
    from .frames.yaw_transform import Align, Pair
    from .notes import config_notes
    from .pipeline import RunOptions, run
    from .published import published_trajectory
    from .reports.demo_table import Report, demo_report
    from .tracked_person import PersonTrack, person_track
    from .whole_evaluation import Evaluation, evaluate

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

__getattr__, __dir__ = lazy_face(__name__)
