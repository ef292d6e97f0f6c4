"""Many walks and many methods: comparison, Monte Carlo, worker processes."""

from .cases import Case, Sweep, case_names, make_cases
from .comparison import Entry, Job, by_bag, compare_one
from .monte_carlo import Score, WalkJob, WalkScores, score_walk, summarise
from .parallel import Failure, Pool, default_jobs

__all__ = [
    "Case",
    "Entry",
    "Failure",
    "Job",
    "Pool",
    "Score",
    "Sweep",
    "WalkJob",
    "WalkScores",
    "by_bag",
    "case_names",
    "compare_one",
    "default_jobs",
    "make_cases",
    "score_walk",
    "summarise",
]
