"""One method on one bag, reduced to what tables and figures of many of them need."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...core import EvaluationError, FloatArray, IntArray
from ...core.kernel import compiled
from ...inspection import require_usable
from ...recording import Recording, Topics, read_bag
from ..evaluate import Evaluation, evaluate
from ..frames.gauge import Options, Truth
from ..metrics.accuracy import Statistics, statistics
from ..metrics.foot_passings import passings
from ..metrics.repeated_walk import STRIDE, StridePlace, repeated, stride_place
from ..plain import plain
from ..track import track, truth_of
from .cases import Case

TRACK_POINTS = 1500
NEAR_S = 0.25


@dataclass(frozen=True)
class Job:
    """A case to run on a bag; topics of the samples, None for the usual ones."""

    bag: str
    case: Case
    options: Options
    repeat: int = 1
    left_topic: str | None = None
    right_topic: str | None = None
    allow_nan: bool = False


@dataclass(frozen=True)
class Tracks:
    """What a figure from above shows: (K, 2) m by foot, thinned."""

    estimate: Mapping[str, FloatArray]
    truth: Mapping[str, FloatArray]
    markers: Mapping[str, FloatArray]


@dataclass(frozen=True)
class Entry:
    """What came of a job.

    Attributes
    ----------
    metrics : everything ``dualfoot evaluate --json`` tells
    minima : estimate minus truth of the distance of the feet where they truly pass closest (m),
        the same moments for every method; None without truth (Liu et al. 2023, Table II)
    stride : the feet at the 68th stride, None on shorter walks (Ma and Särkkä 2023, Table I)
    run_s : CPU time of time alignment and tracking, s (Liu et al. 2023, Table IV)
    """

    bag: str
    case: Case
    metrics: dict[str, Any]
    minima: Statistics | None
    stride: StridePlace | None
    run_s: float
    tracks: Tracks

    def to_dict(self) -> dict[str, Any]:
        """Return all figures as plain values."""
        return plain(
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


def compare_one(job: Job) -> Entry:
    """Run a job.

    Raises
    ------
    DualFootError
        When the bag cannot be used, or nothing was tracked; or for a repeated walk with an aid
        that needs what is not repeated.
    """
    _check_repeatable(job)
    topics = job.left_topic, job.right_topic
    recording = _read(job.bag, topics, job.allow_nan, job.repeat)
    warm_up()
    begin = time.process_time()
    trajectory = track(recording, job.case.config)
    run_s = time.process_time() - begin
    reference = recording.reference
    truth = truth_of(recording)
    found = evaluate(trajectory, truth=truth, reference=reference, options=job.options)
    markers = None if reference is None else reference.markers.get("right")
    return Entry(
        job.bag,
        job.case,
        found.to_dict(),
        _distance_errors(found),
        stride_place(trajectory, markers),
        run_s,
        _tracks(found),
    )


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
) -> Recording:
    """Read a bag; a process that runs several methods on it in a row reads it once."""
    usual = Topics()
    left, right = (
        replace(foot, imu=name or foot.imu)
        for foot, name in zip((usual.left, usual.right), names, strict=True)
    )
    recording = read_bag(Path(bag), topics=replace(usual, left=left, right=right))
    require_usable(recording, allow_not_finite=allow_nan)
    return repeated(recording, repeat)


@lru_cache(maxsize=1)
def warm_up() -> None:
    """Load or make the compiled kernel in this process.

    So it does not count in anyone's run time, and no other process is started to make it.
    """
    try:
        compiled()
    except ImportError:
        return


def _distance_errors(found: Evaluation) -> Statistics | None:
    """Return the statistics of Table II at the true minima, None without truth or passings."""
    if found.truth is None:
        return None
    run = found.trajectory
    at = least_distances(found.truth, run.left.stance, run.right.stance)
    if len(at) == 0:
        return None
    apart = np.linalg.norm((run.left.position - run.right.position)[at], axis=1)
    true = np.linalg.norm((found.truth[0].position - found.truth[1].position)[at], axis=1)
    return statistics(apart - true)


def least_distances(truth: Truth, left_stance: np.ndarray, right_stance: np.ndarray) -> IntArray:
    """Return the (K,) epochs at which the feet are truly closest, one a passing."""
    left, right = truth
    apart = np.linalg.norm(left.position - right.position, axis=1)
    near = max(1, int(NEAR_S * 1e9 / float(np.median(np.diff(left.stamp_ns)))))
    found = []
    for middle in passings(left.position, right.position, left_stance, right_stance).index:
        first = max(0, int(middle) - near)
        found.append(first + int(np.argmin(apart[first : int(middle) + near + 1])))
    return np.unique(np.array(found, dtype=np.int64))


def _tracks(found: Evaluation) -> Tracks:
    estimate = {name: thinned(foot.position) for name, foot in found.feet_tracks.items()}
    truth = {} if found.truth is None else dict(zip(estimate, found.truth, strict=True))
    aligned = found.markers if found.aligned_to == "markers" else {}
    return Tracks(
        estimate,
        {name: thinned(series.position) for name, series in truth.items()},
        {name: points[:, :2] for name, points in aligned.items()},
    )


def thinned(position: FloatArray) -> FloatArray:
    """Return at most ``TRACK_POINTS`` of (N, 3) positions from above, the last one included."""
    rows = np.linspace(0, len(position) - 1, min(len(position), TRACK_POINTS)).round().astype(int)
    return position[rows, :2]
