"""Many walks and many methods: comparison, Monte Carlo, worker processes."""

from .cases import Case, Sweep, case_names, make_cases
from .comparison import Entry, Job, compare_one
from .monte_carlo import Score, WalkJob, WalkScores, score_walk, summarise
from .parallel import Failure, default_jobs, run_each

__all__ = [
    "Case",
    "Entry",
    "Failure",
    "Job",
    "Score",
    "Sweep",
    "WalkJob",
    "WalkScores",
    "case_names",
    "compare_one",
    "default_jobs",
    "make_cases",
    "run_each",
    "score_walk",
    "summarise",
]
