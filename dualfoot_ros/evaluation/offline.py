"""Run the tracker over a recording: what `dualfoot evaluate` and the tables of methods do."""

from __future__ import annotations

from ..core import DualFootTracker, TrackerConfig, Trajectory
from ..core.series import ImuSeries
from ..core.trajectory import FEET
from ..recording.recording import Recording
from ..timing import align
from .align import Truth
from .errors import EvaluationError


def track(recording: Recording, config: TrackerConfig | None = None) -> Trajectory:
    """Bring both sensors of a recording on one time grid and track them.

    Raises
    ------
    EvaluationError
        When a foot is missing or has no samples.
    DualFootError
        What time alignment and tracker refuse: no overlap, no standstill.
    """
    left, right = align(_samples(recording, "left"), _samples(recording, "right"))
    return DualFootTracker(config).run(left, right)


def truth_of(recording: Recording) -> Truth | None:
    """Return the truth of both feet, or None when a foot has none."""
    left, right = recording.left_truth, recording.right_truth
    if left is None or right is None or min(len(left), len(right)) < 2:
        return None
    return left, right


def _samples(recording: Recording, foot: str) -> ImuSeries:
    samples = recording.imu(foot)
    if samples is not None and len(samples) > 0:
        return samples
    other = FEET[1 - FEET.index(foot)]
    there = recording.imu(other)
    only = there is not None and len(there) > 0
    what = f"only the {other} foot" if only else "neither foot"
    raise EvaluationError(
        f"no samples of the {foot} foot: the recording holds {what}, and both are needed; "
        f"'dualfoot info' lists its topics, --{foot}-topic names another one"
    )
