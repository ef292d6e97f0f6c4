"""Loop closure: the distance from the start of a walk to its end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, FootTrajectory
from ..frames.association import Footfalls
from .accuracy import percent


@dataclass(frozen=True)
class Closure:
    """Distance from the first to the last stance; an error where the walk is a loop.

    ``midpoint_*`` is the gap of the point midway between the feet, ``mean_m`` the mean of the
    gaps of the feet (never smaller).  Percent are of the distance walked (see :func:`closure`).
    """

    left_m: float
    right_m: float
    mean_m: float
    midpoint_m: float
    left_percent: float | None
    right_percent: float | None
    mean_percent: float | None
    midpoint_percent: float | None


def closure(
    left: FootTrajectory, right: FootTrajectory, length_m: float | None = None
) -> Closure | None:
    """Return the gaps between first and last stance (horizontal), None without any stance.

    Percent are of ``length_m`` where it is known, otherwise of the estimated way of each foot.
    """
    falls_left, falls_right = Footfalls.of(left), Footfalls.of(right)
    if min(len(falls_left), len(falls_right)) == 0:
        return None
    gap_left = _gap(falls_left.mean(left.position))
    gap_right = _gap(falls_right.mean(right.position))
    size_left, size_right = float(np.linalg.norm(gap_left)), float(np.linalg.norm(gap_right))
    mean, midpoint = (size_left + size_right) / 2, float(np.linalg.norm(gap_left + gap_right)) / 2
    way_left, way_right = length_m or left.distance_m, length_m or right.distance_m
    way = (way_left + way_right) / 2
    return Closure(
        left_m=size_left,
        right_m=size_right,
        mean_m=mean,
        midpoint_m=midpoint,
        left_percent=percent(size_left, way_left),
        right_percent=percent(size_right, way_right),
        mean_percent=percent(mean, way),
        midpoint_percent=percent(midpoint, way),
    )


def _gap(stood: FloatArray) -> FloatArray:
    gap: FloatArray = (stood[-1] - stood[0])[:2]
    return gap
