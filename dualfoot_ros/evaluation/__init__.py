"""Metrics, reports and plots of a walk: against truth, floor markers, or the feet themselves."""

from ..core import EvaluationError
from .evaluate import Evaluation, evaluate
from .frames.gauge import Options
from .frames.yaw_transform import Align, Pair
from .notes import config_notes
from .person_track import PersonTrack, person_track
from .plain import plain
from .published import published_trajectory
from .reports.demo_table import Report, demo_report
from .run import RunOptions, run
from .track import as_live, pair_samples, track, track_samples, track_walk, truth_of

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
