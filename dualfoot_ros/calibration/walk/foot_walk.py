"""The samples of one foot on a walk, as the fit of the gyro matrix needs them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...core import (
    BoolArray,
    CalibrationError,
    EventKind,
    FloatArray,
    FootTrajectory,
    ImuSeries,
    Increments,
    IntArray,
    Levelled,
    TrackerConfig,
    Trajectory,
    quaternion_matrix,
    stance_bounds,
    stance_middles,
)
from ...core.alignment import FootStand, WindowSlider

FEWEST_STANCES = 8  # of a foot on a walk
BEFORE_WALK_S = 0.5  # of the stand that is kept
NO_GAP_S = 0.2  # longer intervals are bridged, not integrated
LEAST_WAY_M = 0.3  # between stances; a shorter way has no direction


@dataclass(frozen=True)
class FootWalk:
    """One foot on one walk, from shortly before its first swing on.

    Attributes
    ----------
    interval_s : (N,) s, the interval that ends at each sample
    force : (N, 3) m/s^2, less the bias that the stand shows along the vertical
    rate : (N, 3) rad/s, less the bias of the stand
    bias_std : rad/s, standard deviation of that bias
    stance : (N,) bool, zero velocity
    attitude : (3, 3) R_nb before the first sample
    up, forward : (3,) of the standing foot, in the axes of the sensor
    turns : (K,) rad about the vertical from each stance to the next
    gravity : m/s^2
    increments : what the samples are
    """

    interval_s: FloatArray
    force: FloatArray
    rate: FloatArray
    bias_std: float
    stance: BoolArray
    attitude: FloatArray
    up: FloatArray
    forward: FloatArray
    turns: FloatArray
    gravity: float
    increments: Increments

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.rate)

    @property
    def duration_s(self) -> float:
        """Length of the walk."""
        return float(self.interval_s.sum())


def foot_walk(
    series: ImuSeries, trajectory: Trajectory, foot: str, config: TrackerConfig
) -> FootWalk:
    """Return the walk of ``foot`` from its samples and the track without constraints.

    Parameters
    ----------
    series : paired samples that ``trajectory`` was made from
    trajectory : of an `unconstrained_config`
    foot : "left" or "right"
    config : that of the trajectory

    Raises
    ------
    CalibrationError
        When the foot took too few steps.
    """
    track: FootTrajectory = getattr(trajectory, foot)
    bounds = stance_bounds(track.stance)
    if len(bounds) < FEWEST_STANCES:
        raise CalibrationError(
            f"{len(bounds)} stances of the {foot} foot were found; needed are {FEWEST_STANCES}, "
            "so walk farther (and see 'dualfoot info' for the stances)"
        )
    stamps = track.stamp_ns
    begin = _begin(stamps, bounds)
    bias, bias_std, gravity = _stand(series, trajectory, foot, int(stamps[begin]), config)
    inside = series[np.isin(series.stamp_ns, stamps[begin:])]
    attitude = quaternion_matrix(track.quaternion[begin])
    up, forward = _axes(track, bounds)
    intervals = np.diff(inside.stamp_ns, prepend=stamps[begin - 1] if begin else stamps[0]) * 1e-9
    return FootWalk(
        interval_s=intervals,
        force=inside.specific_force - (gravity - config.gravity) * attitude[2],
        rate=inside.angular_rate - bias,
        bias_std=bias_std,
        stance=track.stance[begin:],
        attitude=attitude,
        up=up,
        forward=forward,
        turns=_turns(track),
        gravity=config.gravity,
        increments=config.increments.of(foot, series.increments),
    )


def _stand(
    series: ImuSeries, trajectory: Trajectory, foot: str, end_ns: int, config: TrackerConfig
) -> tuple[FloatArray, float, float]:
    """Return gyro bias (3,) rad/s, its deviation and gravity m/s^2 of the stand up to ``end_ns``.

    The whole stand counts, as in the tracker, which goes on refining it; a track that started
    without one keeps what it started from.
    """
    slider, stand = WindowSlider(config.alignment.window), FootStand(config.alignment)
    before = series[series.stamp_ns <= end_ns]
    samples = np.hstack([before.specific_force, before.angular_rate])
    for stamp, values in zip(before.stamp_ns.tolist(), samples, strict=True):
        window = slider.add(stamp, values)
        if window is None:
            continue
        if window.motion(config.alignment, config.gravity):
            stand.clear()
        else:
            stand.add(window)
    if stand.count:
        found = stand.result()
        norm = float(np.linalg.norm(found.specific_force))
        return found.angular_rate, found.rate_std, norm
    start = _start(trajectory)
    return np.array(start.gyro_bias[foot]), start.bias_std, start.gravity[foot]


def _start(trajectory: Trajectory) -> Levelled:
    """Return what the track started from."""
    for event in trajectory.of_kind(EventKind.ALIGNED):
        if isinstance(event.payload, Levelled):
            return event.payload
    raise CalibrationError("the track does not say what it started from")


def _begin(stamps: IntArray, bounds: IntArray) -> int:
    """Return the epoch shortly before the first swing."""
    first, end = bounds[0]
    if first > 0:
        return 0
    before = int(stamps[end - 1]) - round(BEFORE_WALK_S * 1e9)
    return max(0, int(np.searchsorted(stamps, before)))


def _axes(track: FootTrajectory, bounds: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return up and forward (3,) of the standing foot in the axes of its sensor."""
    middles = (bounds[:, 0] + bounds[:, 1] - 1) // 2
    rotations = [quaternion_matrix(track.quaternion[k]) for k in middles]
    up = np.mean([rotation[2] for rotation in rotations], axis=0)
    up /= np.linalg.norm(up)
    forward = np.zeros(3)
    for k in range(1, len(middles) - 1):
        way = track.position[middles[k + 1]] - track.position[middles[k - 1]]
        length = math.hypot(way[0], way[1])
        if length > 2.0 * LEAST_WAY_M:
            forward += rotations[k].T @ (np.array([way[0], way[1], 0.0]) / length)
    forward -= up * float(up @ forward)
    size = float(np.linalg.norm(forward))
    if size == 0.0:
        raise CalibrationError("the feet did not get ahead, so the foot's direction is unknown")
    return up, forward / size


def _turns(track: FootTrajectory) -> FloatArray:
    """Return by how much (K,) rad the foot turned about the vertical between its stances."""
    rotations = [quaternion_matrix(track.quaternion[k]) for k in stance_middles(track.stance)]
    between = [b @ a.T for a, b in pairwise(rotations)]
    return np.array([math.atan2(m[1, 0] - m[0, 1], m[0, 0] + m[1, 1]) for m in between])
