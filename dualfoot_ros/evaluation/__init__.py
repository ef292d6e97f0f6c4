"""Metrics, reports and plots of a walk: against truth, floor markers, or the feet themselves."""

from .align import Options
from .demo import Report, demo_report
from .errors import EvaluationError
from .evaluate import Evaluation, evaluate
from .frames import Align, Pair
from .offline import track, truth_of
from .published import published_trajectory

__all__ = [
    "Align",
    "Evaluation",
    "EvaluationError",
    "Options",
    "Pair",
    "Report",
    "demo_report",
    "evaluate",
    "published_trajectory",
    "track",
    "truth_of",
]
