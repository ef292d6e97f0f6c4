"""Faults to inject into the left foot of a simulated walk, and the finding that names each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import Simulation, WalkConfig, simulate

Inject = Callable[[Simulation, np.random.Generator], Recording]


@dataclass(frozen=True)
class Fault:
    """A fault: what it does to a walk, and the kinds of findings of which one names it."""

    name: str
    inject: Inject
    kinds: tuple[FindingKind, ...]


def of_left(change: Callable[[ImuSeries, np.random.Generator], ImuSeries]) -> Inject:
    """Return a fault of the left foot's samples."""
    return lambda made, rng: Recording(change(made.left, rng), made.right)


def rate_times(matrix: float | np.ndarray) -> Inject:
    """Return a fault that multiplies the angular rate by a number or a (3, 3) matrix."""
    by = np.eye(3) * matrix if np.isscalar(matrix) else np.asarray(matrix)
    return of_left(lambda s, _: replace(s, angular_rate=s.angular_rate @ by.T))


def force_times(matrix: float | np.ndarray) -> Inject:
    """Return a fault that multiplies the specific force by a number or a (3, 3) matrix."""
    by = np.eye(3) * matrix if np.isscalar(matrix) else np.asarray(matrix)
    return of_left(lambda s, _: replace(s, specific_force=s.specific_force @ by.T))


def stick(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Hold one axis of the gyro for 3 s of the walk."""
    rate, at = series.angular_rate.copy(), len(series) // 2
    rate[at : at + round(3.0 * series.rate_hz), 0] = rate[at, 0]
    return replace(series, angular_rate=rate)


def clip(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Limit the angular rate to 70 % of its greatest value."""
    limit = 0.7 * float(np.abs(series.angular_rate).max())
    return replace(series, angular_rate=np.clip(series.angular_rate, -limit, limit))


def jitter(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Stamp by arrival: each sample is up to 12 ms late, in order."""
    late = rng.uniform(0.0, 12e6, len(series)).astype(np.int64)
    return replace(series, stamp_ns=np.maximum.accumulate(series.stamp_ns + late))


def ahead(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Stamp by a clock that is 0.3 s ahead."""
    return replace(series, stamp_ns=series.stamp_ns + 300_000_000)


def lose(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Lose 5 % of the samples, anywhere."""
    return series[rng.uniform(size=len(series)) > 0.05]


def shake(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Shake the gyro for 4 s of the walk, so that stances are missed there."""
    rate, at = series.angular_rate.copy(), len(series) // 2
    part = slice(at, at + round(4.0 * series.rate_hz))
    rate[part] += rng.normal(0.0, 3.0, rate[part].shape)
    return replace(series, angular_rate=rate)


def twice(made: Simulation, rng: np.random.Generator) -> Recording:
    """Give the left sensor for both feet."""
    return Recording(made.left, made.left)


def exchange(made: Simulation, rng: np.random.Generator) -> Recording:
    """Exchange the feet."""
    return Recording(made.right, made.left)


def strange(made: Simulation, rng: np.random.Generator) -> Recording:
    """Give the right foot of another, slower walk."""
    config = WalkConfig(route="straight", rate=made.walk.config.rate, speed=0.7)
    return Recording(made.left, simulate(config, seed=99).right)


K = FindingKind
FAULTS = (
    Fault("gyro 57 times too small", rate_times(np.pi / 180), (K.RATE_UNIT,)),
    Fault("gyro 57 times too large", rate_times(180 / np.pi), (K.RATE_UNIT,)),
    Fault("gyro negated", rate_times(-1.0), (K.RATE_AXES,)),
    Fault("gyro, y negated", rate_times(np.diag([1.0, -1.0, 1.0])), (K.RATE_AXES,)),
    Fault("gyro, x and y exchanged", rate_times(np.eye(3)[[1, 0, 2]]), (K.RATE_AXES,)),
    Fault("gyro, axes in turn", rate_times(np.eye(3)[[1, 2, 0]]), (K.RATE_AXES,)),
    Fault("gyro 10 % too small", rate_times(0.9), (K.RATE_SCALE,)),
    Fault("gyro 10 % too large", rate_times(1.1), (K.RATE_SCALE,)),
    Fault("accelerometer, z negated", force_times(np.diag([1.0, 1.0, -1.0])), (K.RATE_AXES,)),
    Fault("accelerometer negated", force_times(-1.0), (K.MIRRORED_FOOT, K.EXCHANGED_FEET)),
    Fault("accelerometer 10 % too small", force_times(0.9), (K.GRAVITY,)),
    Fault("axis of the gyro stuck for 3 s", of_left(stick), (K.STUCK,)),
    Fault("gyro clipped at 70 %", of_left(clip), (K.CLIPPING,)),
    Fault("stamps 0 to 12 ms late", of_left(jitter), (K.JITTER,)),
    Fault("clock 0.3 s ahead", of_left(ahead), (K.CLOCKS_APART,)),
    Fault("5 % of the samples lost", of_left(lose), (K.MISSING_SAMPLES,)),
    Fault("shaken for 4 s", of_left(shake), (K.MISSED_STANCES, K.LONG_STRIDE, K.NO_STANCE)),
    Fault("one sensor for both feet", twice, (K.SAME_SAMPLES,)),
    Fault("right foot of another walk", strange, (K.FEET_APART, K.UNEQUAL_WAYS, K.MISSED_STANCES)),
    Fault("feet exchanged", exchange, (K.EXCHANGED_FEET,)),
)
