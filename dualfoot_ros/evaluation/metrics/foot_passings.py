"""The feet against each other: distance when they pass, and whether they pass on their sides.

A *passing* is the middle of a swing: the moment when the swinging foot goes by the standing one.
It is taken from the stances alone, so that it is the same moments for every method.  The feet are
*crossed* at a passing when the left foot is on the right of the right foot, seen in the direction
of walking: the way the swinging foot makes in the middle half of its swing.  Swings that move the
foot by less than 0.3 m (shuffling, turning on the spot) have no direction and are not counted.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, FootTrajectory, IntArray, stance_bounds
from .accuracy import Statistics, statistics

MIN_STRIDE_M = 0.3


@dataclass(frozen=True)
class Passings:
    """The moments at which one foot passes the other.

    Attributes
    ----------
    index : (K,) epoch
    lateral_m : (K,) m by which the left foot is on the left of the right one; negative: crossed
    distance_m : (K,) m, three-dimensional distance between the feet
    """

    index: IntArray
    lateral_m: FloatArray
    distance_m: FloatArray

    @property
    def crossed_percent(self) -> float | None:
        """Share of the passings at which the feet are crossed, in percent."""
        return float(100.0 * np.mean(self.lateral_m < 0)) if len(self.index) else None


def passings(
    left: FloatArray, right: FloatArray, left_stance: np.ndarray, right_stance: np.ndarray
) -> Passings:
    """Find the passings of two (N, 3) tracks of equal stamps with (N,) stances each."""
    found = sorted(
        [*_swings(left, left_stance), *_swings(right, right_stance)], key=lambda s: s[0]
    )
    index = np.array([moment for moment, _ in found], dtype=np.int64)
    way = np.reshape([direction for _, direction in found], (-1, 2))
    apart = (left - right)[index]
    lateral = way[:, 0] * apart[:, 1] - way[:, 1] * apart[:, 0]
    return Passings(index, lateral, np.linalg.norm(apart, axis=1))


def _swings(position: FloatArray, stance: np.ndarray) -> Iterable[tuple[int, FloatArray]]:
    """Yield the middle epoch and the unit direction of every swing between two stances."""
    bounds = stance_bounds(stance)
    for begin, end in zip(bounds[:-1, 1], bounds[1:, 0], strict=True):
        quarter = (end - begin) // 4
        way = (position[end - 1 - quarter] - position[begin + quarter])[:2]
        stride = np.linalg.norm((position[end] - position[begin - 1])[:2])
        if stride >= MIN_STRIDE_M and np.any(way):
            yield int((begin + end - 1) // 2), way / np.linalg.norm(way)


@dataclass(frozen=True)
class FeetReport:
    """Distance between the feet and crossings.

    ``distance_m`` are statistics of the estimated distance, ``distance_error_m`` of estimate
    minus truth (None without truth), both at ``moments``: "constraint" where the method applied
    constraints, otherwise "passing".
    """

    moments: str
    distance_m: Statistics
    distance_error_m: Statistics | None
    passings: int
    crossed: int
    crossed_percent: float | None
    truth_crossed_percent: float | None


def feet_report(
    left: FootTrajectory,
    right: FootTrajectory,
    constrained: IntArray,
    truth: tuple[FloatArray, FloatArray] | None = None,
) -> FeetReport:
    """Summarise both feet; ``constrained`` are the epochs (K,) at which a constraint applied."""
    passed = passings(left.position, right.position, left.stance, right.stance)
    at = constrained if len(constrained) else passed.index
    apart = np.linalg.norm((left.position - right.position)[at], axis=1)
    error, crossed = None, None
    if truth is not None:
        error = statistics(apart - np.linalg.norm((truth[0] - truth[1])[at], axis=1))
        crossed = passings(*truth, left.stance, right.stance).crossed_percent
    return FeetReport(
        moments="constraint" if len(constrained) else "passing",
        distance_m=statistics(apart),
        distance_error_m=error,
        passings=len(passed.index),
        crossed=int(np.sum(passed.lateral_m < 0)),
        crossed_percent=passed.crossed_percent,
        truth_crossed_percent=crossed,
    )
