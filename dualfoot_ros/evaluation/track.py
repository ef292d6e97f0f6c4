"""Run the tracker over a recording: what `dualfoot evaluate` and the tables of methods do."""

from __future__ import annotations

from dataclasses import replace

from ..core import (
    FEET,
    DualFootTracker,
    EvaluationError,
    ImuSeries,
    TrackerConfig,
    Trajectory,
    fields_of,
    stance_middles,
)
from ..recording import Recording
from ..timing import align_with_report
from .frames.gauge import Truth


def track(recording: Recording, config: TrackerConfig | None = None) -> Trajectory:
    """Bring both sensors of a recording on one time grid and track them.

    Air pressure and magnetic field go along, for the aids, as they were measured.  The counters of
    the time alignment join those of the tracker under ``sync.``.

    Raises
    ------
    EvaluationError
        When a foot is missing or has no samples, the feet share no time, or nobody walked after
        the first standstill; or the magnetic heading is on without any magnetic field.
    DualFootError
        What time alignment and tracker refuse: two recordings in one, no standstill.
    """
    samples = _samples(recording, "left"), _samples(recording, "right")
    fields = fields_of(*samples)
    if config is not None and config.aids.magnetic_heading and not fields:
        raise EvaluationError(
            "aids.magnetic_heading is on but the recording has no magnetic field of either foot; "
            "record sensor_msgs/MagneticField on /left/imu/mag and /right/imu/mag with the stamps "
            "of the samples, or leave the aid off"
        )
    left, right, report = align_with_report(*samples)
    if len(left) == 0:
        raise EvaluationError(
            f"the feet share no time (overlap {report.overlap_s:.1f} s), so there are no pairs of "
            "samples; were both recorded together, and are their clocks synchronised?"
        )
    found = DualFootTracker(config).run(left, right, recording.pressure, fields)
    _check_walked(found, left)
    prepared = {f"sync.{name}": count for name, count in report.counters.items()}
    return replace(found, counters={**prepared, **found.counters})


def _check_walked(found: Trajectory, samples: ImuSeries) -> None:
    """Refuse a recording whose only standstill comes after the walk."""
    late_s = (found.start_ns - int(samples.stamp_ns[0])) * 1e-9
    strides = max(len(stance_middles(foot.stance)) for foot in (found.left, found.right)) - 1
    if strides < 1 and late_s > 0.5 * samples.duration_s:
        raise EvaluationError(
            f"the first standstill ends {late_s:.1f} s into the {samples.duration_s:.1f} s of the "
            "recording and nobody walked after it; stand still with both feet before walking"
        )


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
