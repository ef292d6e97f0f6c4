"""A recording through time alignment and tracker: paired samples, then the tracks of both feet."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ..core import (
    FEET,
    BiasPrior,
    DualFootTracker,
    EvaluationError,
    FieldSeries,
    ImuSeries,
    PressureSeries,
    TrackerConfig,
    Trajectory,
    bias_after,
    fields_of,
    stance_middles,
)
from ..recording import Recording
from ..timing import align_with_report
from .frames.association import as_slice
from .frames.gauge import Truth

NO_SAMPLES = ImuSeries(np.empty(0, dtype=np.int64), np.empty((0, 3)), np.empty((0, 3)))


@dataclass(frozen=True)
class PairedSamples:
    """The samples of both feet on one time grid, and what the aids measured beside them.

    Attributes
    ----------
    left, right : series with equal stamps; NaN where that foot is missing
    pressure : air pressure by "left", "right" or "both", as it was measured
    fields : magnetic field by "left" or "right", as it was measured
    counters : of the time alignment, what became of the samples
    stands : what the last stands tell of the gyro biases, kept for the next run of the samples
    """

    left: ImuSeries
    right: ImuSeries
    pressure: Mapping[str, PressureSeries]
    fields: Mapping[str, FieldSeries]
    counters: Mapping[str, int]
    stands: dict[Hashable, BiasPrior | None] = field(default_factory=dict, compare=False)


def track(
    recording: Recording,
    config: TrackerConfig | None = None,
    priors: Mapping[str, BiasPrior] | None = None,
) -> Trajectory:
    """Bring both sensors of a recording on one time grid and track them.

    Air pressure and magnetic field go along, for the aids, as they were measured.  The counters of
    the time alignment join those of the tracker under ``sync.``.  ``priors`` are gyro biases that
    are known beforehand, by foot; with ``alignment.last_stand`` the end of the recording tells of
    them too.

    Raises
    ------
    EvaluationError
        When there are no samples, the feet share no time, or nobody walked after the first
        standstill; or the magnetic heading is on without any magnetic field.
    DualFootError
        What time alignment and tracker refuse: two recordings in one, no standstill.
    """
    return track_walk(pair_samples(recording), config, priors)


def track_walk(
    samples: PairedSamples,
    config: TrackerConfig | None = None,
    priors: Mapping[str, BiasPrior] | None = None,
    *,
    covariances: bool = True,
) -> Trajectory:
    """Track paired samples in which somebody walks; raise as :func:`track`.

    Without ``covariances`` there is nan in their place, and a third of the memory is needed.
    """
    trajectory = track_samples(samples, config, priors, covariances=covariances)
    _check_walked(trajectory, samples.left)
    return trajectory


def pair_samples(recording: Recording) -> PairedSamples:
    """Return the samples of both feet on one time grid; NaN where a foot is missing.

    Raises
    ------
    EvaluationError
        When there are no samples, or the feet share no time.
    TimingError
        When the stamps of a foot jump back and go on from there: two recordings in one.
    """
    measured = _samples(recording)
    left, right, report = align_with_report(*measured)
    if all(map(len, measured)) and report.overlap_s <= 0.0:
        raise EvaluationError(
            f"the feet share no time (overlap {report.overlap_s:.1f} s), so there are no pairs of "
            "samples; were both recorded together, and are their clocks synchronised?"
        )
    counters = {**report.counters, **_clocks_set(recording)}
    return PairedSamples(left, right, recording.pressure, fields_of(*measured), counters)


def _clocks_set(recording: Recording) -> dict[str, int]:
    """Return the counters of the clocks that were set back, as the streaming aligner has them."""
    steps = [step.feet for step in recording.clock_steps]
    alone = {f"{foot}_clock_set": steps.count((foot,)) for foot in FEET}
    return {**alone, "restarts": len(steps) - sum(alone.values())}


def track_samples(
    samples: PairedSamples,
    config: TrackerConfig | None = None,
    priors: Mapping[str, BiasPrior] | None = None,
    *,
    covariances: bool = True,
) -> Trajectory:
    """Track paired samples, even if nobody walks in them; ``covariances`` as in `track_walk`.

    Raises
    ------
    EvaluationError
        When the magnetic heading is on without any magnetic field.
    AlignmentError
        When there is neither a standstill nor a stance of each foot.
    """
    if config is not None and config.aids.magnetic_heading and not samples.fields:
        raise EvaluationError(
            "aids.magnetic_heading is on but the recording has no magnetic field of either foot; "
            "record sensor_msgs/MagneticField on /left/imu/mag and /right/imu/mag with the stamps "
            "of the samples, or leave the aid off"
        )
    tracker = DualFootTracker(config)
    for foot, prior in bias_priors(samples, tracker.config, priors or {}).items():
        tracker.declare_bias(foot, prior)
    measured = samples.left, samples.right, samples.pressure, samples.fields
    trajectory = tracker.run(*measured, covariances=covariances)
    paired = {f"sync.{name}": count for name, count in samples.counters.items()}
    return replace(trajectory, counters={**paired, **trajectory.counters})


def as_live(config: TrackerConfig) -> TrackerConfig:
    """Return the configuration with which an offline run gives the bits of the nodes.

    They cannot know the end of the walk.
    """
    return replace(config, alignment=replace(config.alignment, last_stand=False))


def bias_priors(
    samples: PairedSamples, config: TrackerConfig, known: Mapping[str, BiasPrior]
) -> dict[str, BiasPrior]:
    """Return the gyro biases that are known of each foot before the run."""
    priors = dict(known)
    if not config.alignment.last_stand:
        return priors
    for foot in FEET:
        after = _last_stand(samples, foot, config)
        if after is not None:
            priors[foot] = after.also(priors.get(foot))
    return priors


def _last_stand(samples: PairedSamples, foot: str, config: TrackerConfig) -> BiasPrior | None:
    """Return what the last stand of a foot tells; the search is made once for like settings."""
    key = foot, config.alignment, config.gravity, config.noise
    if key not in samples.stands:
        series = samples.left if foot == FEET[0] else samples.right
        there = np.asarray(~np.isnan(series.specific_force).any(axis=1))
        samples.stands[key] = bias_after(series[as_slice(there)], config)
    return samples.stands[key]


def truth_of(recording: Recording) -> Truth | None:
    """Return the truth of both feet, or None when a foot has none."""
    left, right = recording.left_truth, recording.right_truth
    if left is None or right is None or min(len(left), len(right)) < 2:
        return None
    return left, right


def _check_walked(trajectory: Trajectory, samples: ImuSeries) -> None:
    """Refuse a recording whose only standstill comes after the walk."""
    late_s = (trajectory.start_ns - int(samples.stamp_ns[0])) * 1e-9
    feet = trajectory.left, trajectory.right
    strides = max(len(stance_middles(foot.stance)) for foot in feet) - 1
    if strides < 1 and late_s > 0.5 * samples.duration_s:
        raise EvaluationError(
            f"the first standstill ends {late_s:.1f} s into the {samples.duration_s:.1f} s of the "
            "recording and nobody walked after it; stand still with both feet before walking"
        )


def _samples(recording: Recording) -> tuple[ImuSeries, ImuSeries]:
    """Return the samples of both feet; of one that is missing, none."""
    left, right = (recording.imu(foot) or NO_SAMPLES for foot in FEET)
    if len(left) or len(right):
        return left, right
    raise EvaluationError(
        "the recording holds no samples of either foot; 'dualfoot info' lists its topics, "
        "--left-topic and --right-topic name others"
    )
