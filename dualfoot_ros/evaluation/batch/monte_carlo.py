"""Consistency of the filter: NEES and NIS over many simulated walks.

For a consistent filter the NEES of a quantity with d dimensions is chi-square distributed with d
degrees of freedom, and so is the NIS of a measurement (Bar-Shalom et al. 2001, section 5.4).  Over
N walks the mean at one moment, divided by d, lies within chi-square quantiles of N d over N d (the
*ensemble* band).  Innovations are white in a consistent filter, so the mean over time and walks of
the NIS has a narrower band, of all M updates (the *time-averaged* band); errors are not white, so
for the NEES every walk counts once there too.

Position and heading of the start are a gauge.  The tracker's is: origin midway between the feet,
x along the first strides (``heading.from_stance`` to ``heading.to_stance``) of the foot that made
them first.  The truth is brought into that gauge by the true positions of the feet at those
strides alone: unlike an alignment to the estimate, this removes no error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...core import (
    FEET,
    METHODS,
    EvaluationError,
    EventKind,
    FloatArray,
    IntArray,
    PoseSeries,
    TrackerConfig,
    Trajectory,
)
from ...recording import Recording
from ...simulation import BarometerConfig, MagnetometerConfig, SensorConfig, WalkConfig, simulate
from ..frames.association import Footfalls
from ..frames.between_poses import turns_between
from ..frames.gauge import Truth, overlap
from ..frames.yaw_transform import YawTransform
from ..metrics.nees import nees
from ..track import track
from .comparison import warm_up

POINTS = 40
CONFIDENCE = 0.95
DIMENSIONS = {"horizontal": 2, "height": 1, "heading": 1}


@dataclass(frozen=True)
class WalkJob:
    """A walk to simulate and track."""

    seed: int
    walk: WalkConfig
    sensor: SensorConfig
    config: TrackerConfig


@dataclass(frozen=True)
class WalkScores:
    """The scores of one walk.

    Attributes
    ----------
    nees : quantity -> (POINTS,) NEES over its dimensions, at equal steps of the walk
    squares : quantity -> mean squared error and mean variance along one axis
    nis : measurement -> (M,) NIS over its dimensions, every update of the walk
    """

    nees: dict[str, FloatArray]
    squares: dict[str, tuple[float, float]]
    nis: dict[str, FloatArray]


def score_walk(job: WalkJob) -> WalkScores:
    """Simulate, track and score one walk, with the sensors of the aids that are on.

    Raises
    ------
    EvaluationError
        When the walk has too few stances to have a heading.
    DualFootError
        When the tracker refuses the walk.
    """
    aids = job.config.aids
    barometer = BarometerConfig() if aids.barometer else None
    magnetometer = MagnetometerConfig() if aids.magnetic_heading else None
    made = simulate(job.walk, job.sensor, None, job.seed, barometer, magnetometer)
    warm_up()
    run = track(Recording(made.left, made.right, pressure=made.pressure), job.config)
    nis = _nis(run)
    run, truth = overlap(run, (made.left_truth, made.right_truth))
    truth = in_gauge(truth, run, job.config)
    scores, squares = _errors(run, truth, job.config)
    return WalkScores(scores, squares, nis)


def in_gauge(truth: Truth, run: Trajectory, config: TrackerConfig) -> Truth:
    """Return the truth in the tracker's frame, which its own first strides define."""
    first, last = config.heading.from_stance, config.heading.to_stance
    events = run.of_kind(EventKind.HEADING)
    leading = FEET.index(events[0].foot) if events else 0
    stood = Footfalls.of((run.left, run.right)[leading]).mean(truth[leading].position)
    if not events or len(stood) <= last + 1:
        raise EvaluationError(f"{len(stood)} stances were found; more than {last + 1} are needed")
    way = stood[last] - stood[first]
    turn = YawTransform(-math.atan2(way[1], way[0]), np.zeros(3))
    middle = 0.5 * (truth[0].position[0] + truth[1].position[0])
    moved = YawTransform(turn.yaw, -turn.matrix @ middle)
    left, right = (_moved(true, moved) for true in truth)
    return left, right


def _moved(true: PoseSeries, by: YawTransform) -> PoseSeries:
    velocity = None if true.velocity is None else by.vector(true.velocity)
    position, attitude = by.position(true.position), by.quaternion(true.quaternion)
    return PoseSeries(true.stamp_ns, position, attitude, velocity)


Scores = tuple[dict[str, FloatArray], dict[str, tuple[float, float]]]


def _errors(run: Trajectory, truth: Truth, config: TrackerConfig) -> Scores:
    """Return the NEES of every quantity at the points, and its mean squares."""
    scores: dict[str, FloatArray] = {}
    squares: dict[str, tuple[float, float]] = {}

    def put(name: str, error: FloatArray, covariance: FloatArray, at: IntArray) -> None:
        scores[name] = nees(error[at], covariance[at])
        variance = np.trace(covariance[at], axis1=1, axis2=2) / error.shape[1]
        squares[name] = float(np.mean(error[at] ** 2)), float(np.mean(variance))

    falls = [Footfalls.of(foot).middle for foot in (run.left, run.right)]
    known = max(int(middle[config.heading.to_stance]) for middle in falls)
    for name, foot, true, middle in zip(
        ("left", "right"), (run.left, run.right), truth, falls, strict=True
    ):
        at = points(middle, known)
        _put_position(put, name, foot.position - true.position, foot.position_covariance[:], at)
        if true.velocity is not None:
            put(f"{name} velocity", foot.velocity - true.velocity, foot.velocity_covariance[:], at)
        turned = turns_between(true.quaternion, foot.quaternion)
        put(f"{name} attitude", turned, foot.attitude_covariance[:], at)
        put(f"{name} heading", turned[:, 2:], foot.attitude_covariance[:, 2:, 2:], at)
    apart = run.left.position - run.right.position - (truth[0].position - truth[1].position)
    at = points(np.sort(np.concatenate(falls)), known)
    _put_position(put, "relative", apart, run.relative_covariance[:], at)
    return scores, squares


Put = Callable[[str, FloatArray, FloatArray, IntArray], None]


def _put_position(
    put: Put, name: str, error: FloatArray, covariance: FloatArray, at: IntArray
) -> None:
    """Score a position as a whole, and its horizontal and vertical parts."""
    put(f"{name} position", error, covariance, at)
    put(f"{name} horizontal", error[:, :2], covariance[:, :2, :2], at)
    put(f"{name} height", error[:, 2:], covariance[:, 2:, 2:], at)


def points(middles: IntArray, first: int) -> IntArray:
    """Return (POINTS,) middles of stances at equal steps from epoch ``first`` to the last."""
    later = middles[middles >= first]
    wanted = np.linspace(first, later[-1], POINTS)
    chosen: IntArray = later[np.abs(later[:, None] - wanted).argmin(axis=0)]
    return chosen


def _nis(run: Trajectory) -> dict[str, FloatArray]:
    """Return the NIS over its dimensions of all zero-velocity updates and constraints."""
    zupt = run.zupt_nis[np.isfinite(run.zupt_nis)] / 3.0
    constraints = [
        event.nis / len(event.innovation)
        for event in run.of_kind(EventKind.CONSTRAINT)
        if np.isfinite(event.nis) and len(event.innovation)
    ]
    return {"zero velocity": zupt, "constraint": np.array(constraints)}


@dataclass(frozen=True)
class Score:
    """The consistency of one quantity over all walks.

    Attributes
    ----------
    kind : "NEES" or "NIS"
    dimensions : degrees of freedom (of a constraint: of its innovation)
    mean : NEES or NIS over the dimensions, mean over time and walks; 1 if consistent
    band : where the mean lies with probability ``CONFIDENCE`` if the filter is consistent
    curve : (POINTS,) means over the walks at equal steps (NEES only)
    curve_band : where each of them lies with that probability
    inside : share of the points that lie within
    error, std : root mean square error along one axis, and the standard deviation of the filter
    """

    name: str
    kind: str
    dimensions: int
    mean: float
    band: tuple[float, float]
    count: int
    curve: FloatArray | None = None
    curve_band: tuple[float, float] | None = None
    inside: float | None = None
    error: float | None = None
    std: float | None = None


def band(count: int, dimensions: int) -> tuple[float, float]:
    """Return the band of the mean of ``count`` chi-squares over their degrees of freedom."""
    from scipy.special import gammaincinv  # scipy.stats takes five times as long to load

    freedom = count * dimensions
    shares = [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2]
    low, high = 2.0 * gammaincinv(freedom / 2, shares) / freedom
    return float(low), float(high)


def summarise(walks: Sequence[WalkScores], config: TrackerConfig) -> list[Score]:
    """Return the scores of all quantities over ``walks``."""
    scores = [_nees_score(name, walks) for name in walks[0].nees]
    for name in walks[0].nis:
        values = np.concatenate([walk.nis[name] for walk in walks])
        dimensions = 3 if name == "zero velocity" else constraint_dimensions(config)
        if len(values):
            limits = band(len(values), dimensions)
            mean = float(values.mean())
            scores.append(Score(name, "NIS", dimensions, mean, limits, len(values)))
    return scores


def _nees_score(name: str, walks: Sequence[WalkScores]) -> Score:
    curve = np.mean([walk.nees[name] for walk in walks], axis=0)
    dimensions = DIMENSIONS.get(name.partition(" ")[2], 3)
    limits = band(len(walks), dimensions)
    squares = np.mean([walk.squares[name] for walk in walks], axis=0)
    return Score(
        name=name,
        kind="NEES",
        dimensions=dimensions,
        mean=float(curve.mean()),
        band=limits,
        count=len(walks),
        curve=curve,
        curve_band=limits,
        inside=float(np.mean((curve >= limits[0]) & (curve <= limits[1]))),
        error=math.sqrt(squares[0]),
        std=math.sqrt(squares[1]),
    )


def constraint_dimensions(config: TrackerConfig) -> int:
    """Return the number of components that the constraint of the method observes at once."""
    return METHODS[config.method](config.constraint).dimensions
