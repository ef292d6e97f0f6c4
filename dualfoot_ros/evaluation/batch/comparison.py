"""One case on one bag, reduced to the figures that tables and plots of many of them need."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...core import EvaluationError, FloatArray, IntArray, swing_passings
from ...core.compiler import compiled
from ...inspection import Finding, check_usable, mend_clocks
from ...recording import Correction, Recording, find_topics, read_bag
from ..frames.gauge import Options, Truth
from ..metrics.accuracy import Statistics, statistics
from ..metrics.repeated_walk import STRIDE, StridePlace, repeated, stride_place
from ..pipeline import RunOptions, run_checked
from ..plain import plain
from ..whole_evaluation import Evaluation
from .cases import Case

TRACK_POINTS = 1500
NEAR_S = 0.25


@dataclass(frozen=True)
class Job:
    """A case to run on a bag.

    ``left_topic`` and ``right_topic`` are None for the usual ones, or those found by name;
    ``calibration`` is by foot.  ``folder`` is where a relative ``bag`` lies, for a process that
    works elsewhere.
    """

    bag: str
    case: Case
    options: Options
    repeat: int = 1
    left_topic: str | None = None
    right_topic: str | None = None
    allow_nan: bool = False
    calibration: Mapping[str, Correction] = field(default_factory=dict)
    folder: str = ""


Indexed = tuple[int, Job]


def by_bag(jobs: Sequence[Job], processes: int) -> list[list[Indexed]]:
    """Return the jobs with their indices in groups of one bag each, so that it is read once.

    The jobs of the last bags, one for each process, make several groups, which become smaller, so
    that in the end no process is without work for long.
    """
    bags: dict[str, list[Indexed]] = {}
    for index, job in enumerate(jobs):
        bags.setdefault(job.bag, []).append((index, job))
    whole = max(0, len(bags) - processes) if processes > 1 else len(bags)
    groups = list(bags.values())
    return groups[:whole] + _divided(groups[whole:], processes)


def _divided(groups: Sequence[list[Indexed]], processes: int) -> list[list[Indexed]]:
    """Return parts of the groups, each half of what is left for one process: one of each in turn.

    So a process that takes part after part mostly stays with its group.
    """
    parts = []
    rest = [group for group in groups if group]
    while rest:
        sharing = processes / len(groups)
        sizes = [math.ceil(len(group) / sharing / 2) for group in rest]
        parts += [group[:size] for group, size in zip(rest, sizes, strict=True)]
        left = [group[size:] for group, size in zip(rest, sizes, strict=True)]
        rest = [group for group in left if group]
    return parts


@dataclass(frozen=True)
class Tracks:
    """Tracks from above for a figure: (K, 2) m by foot, thinned."""

    estimate: Mapping[str, FloatArray]
    truth: Mapping[str, FloatArray]
    markers: Mapping[str, FloatArray]


@dataclass(frozen=True)
class Entry:
    """The figures of one case on one bag.

    Attributes
    ----------
    metrics : the figures of ``dualfoot evaluate --json``
    minima : m, estimate minus truth of the distance between the feet where they truly pass
        closest, the same moments for every method; None without truth (Liu et al. 2023, Table II)
    stride : the feet at the 68th stride, None on shorter walks (Ma and Särkkä 2023, Table I)
    run_s : CPU time of time alignment and tracking, s (Liu et al. 2023, Table IV)
    warnings : sentences on the samples of the bag, whatever the case
    """

    bag: str
    case: Case
    metrics: dict[str, Any]
    minima: Statistics | None
    stride: StridePlace | None
    run_s: float
    tracks: Tracks
    warnings: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return all figures as plain values."""
        figures: dict[str, Any] = plain(
            {
                "bag": self.bag,
                "case": self.case.label,
                "swept": self.case.swept,
                **self.metrics,
                "distance_error_at_minima_m": self.minima and asdict(self.minima),
                "stride": self.stride and {"number": STRIDE, **asdict(self.stride)},
                "run_s": self.run_s,
            }
        )
        return figures


def compare_one(job: Job) -> Entry:
    """Run a job.

    Raises
    ------
    DualFootError
        When the bag cannot be used, or nothing was tracked; or for a repeated walk with an aid
        whose measurements cannot be repeated.
    """
    _check_repeatable(job)
    topics = job.left_topic, job.right_topic
    recording, findings = _read(_path(job), topics, job.allow_nan, job.repeat)
    warm_up()
    options = RunOptions(alignment=job.options, calibration=job.calibration, check_feet=False)
    evaluation = run_checked(recording, job.case.config, options, findings)
    return Entry(
        job.bag,
        job.case,
        evaluation.to_dict(),
        _distance_errors(evaluation),
        stride_place(evaluation.tracked, evaluation.markers.get("right")),
        evaluation.run_s or 0.0,
        _tracks(evaluation),
        tuple(finding.sentence for finding in findings),
    )


def _path(job: Job) -> str:
    return str(Path(job.folder) / job.bag)


def _check_repeatable(job: Job) -> None:
    """Refuse aids whose field or pressure would jump where one round follows another."""
    aids = job.case.config.aids
    for name in ("barometer", "magnetic_heading"):
        if job.repeat > 1 and getattr(aids, name):
            raise EvaluationError(
                f"aids.{name} is on with --repeat {job.repeat}; a round that is repeated "
                "elsewhere has no air pressure or magnetic field, so leave the aid off"
            )


@lru_cache(maxsize=1)
def _read(
    bag: str, names: tuple[str | None, str | None], allow_nan: bool, repeat: int
) -> tuple[Recording, tuple[Finding, ...]]:
    """Read and check a bag; a process that runs several methods in a row on it does so once."""
    recording = mend_clocks(read_bag(Path(bag), topics=find_topics(bag, *names).topics))
    findings = check_usable(recording, allow_not_finite=allow_nan)
    return repeated(recording, repeat), findings


@lru_cache(maxsize=1)
def warm_up() -> None:
    """Load or make the compiled kernel in this process.

    So it does not count in anyone's run time, and no other process is started to make it.
    """
    try:
        compiled()
    except ImportError:
        return


def _distance_errors(evaluation: Evaluation) -> Statistics | None:
    """Return the statistics of Table II at the true minima, None without truth or passings."""
    if evaluation.truth is None:
        return None
    run = evaluation.trajectory
    at = least_distances(evaluation.truth, run.left.stance, run.right.stance)
    if len(at) == 0:
        return None
    apart = np.linalg.norm((run.left.position - run.right.position)[at], axis=1)
    true = np.linalg.norm(
        (evaluation.truth[0].position - evaluation.truth[1].position)[at], axis=1
    )
    return statistics(apart - true)


def least_distances(truth: Truth, left_stance: np.ndarray, right_stance: np.ndarray) -> IntArray:
    """Return the (K,) epochs at which the feet are truly closest, one a passing."""
    left, right = truth
    apart = np.linalg.norm(left.position - right.position, axis=1)
    near = max(1, int(NEAR_S * 1e9 / float(np.median(np.diff(left.stamp_ns)))))
    closest = []
    passings = swing_passings(left.position, right.position, left_stance, right_stance)
    for middle in passings.index:
        first = max(0, int(middle) - near)
        closest.append(first + int(np.argmin(apart[first : int(middle) + near + 1])))
    return np.unique(np.array(closest, dtype=np.int64))


def _tracks(evaluation: Evaluation) -> Tracks:
    estimate = {name: thinned(foot.position) for name, foot in evaluation.feet_tracks.items()}
    truth = {} if evaluation.truth is None else dict(zip(estimate, evaluation.truth, strict=True))
    aligned = evaluation.markers if evaluation.aligned_to == "markers" else {}
    return Tracks(
        estimate,
        {name: thinned(series.position) for name, series in truth.items()},
        {name: points[:, :2] for name, points in aligned.items()},
    )


def thinned(position: FloatArray) -> FloatArray:
    """Return at most ``TRACK_POINTS`` of (N, 3) positions from above, the last one included."""
    rows = np.linspace(0, len(position) - 1, min(len(position), TRACK_POINTS)).round().astype(int)
    return position[rows, :2]
