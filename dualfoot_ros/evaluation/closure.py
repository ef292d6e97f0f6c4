"""How far the end of a walk is from its start."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.series import FloatArray
from ..core.trajectory import FootTrajectory
from .accuracy import percent
from .association import Footfalls


@dataclass(frozen=True)
class Closure:
    """Distance from the first to the last stance; an error where the walk is a loop.

    ``midpoint_*`` is the gap of the point midway between the feet, ``mean_m`` the mean of the
    gaps of the feet (never smaller).  Percent are of the distance walked.
    """

    left_m: float
    right_m: float
    mean_m: float
    midpoint_m: float
    left_percent: float | None
    right_percent: float | None
    mean_percent: float | None
    midpoint_percent: float | None


def closure(left: FootTrajectory, right: FootTrajectory) -> Closure | None:
    """Return the gaps between first and last stance (horizontal), None without any stance."""
    feet = (left, right)
    falls = [Footfalls.of(foot) for foot in feet]
    if min(len(f) for f in falls) == 0:
        return None
    gaps = [_gap(f.mean(foot.position)) for f, foot in zip(falls, feet, strict=True)]
    sizes = [float(np.linalg.norm(gap)) for gap in gaps]
    ways = [foot.distance_m for foot in feet]
    mean, midpoint = float(np.mean(sizes)), float(np.linalg.norm(np.mean(gaps, axis=0)))
    way = float(np.mean(ways))
    return Closure(
        *sizes,
        mean,
        midpoint,
        percent(sizes[0], ways[0]),
        percent(sizes[1], ways[1]),
        percent(mean, way),
        percent(midpoint, way),
    )


def _gap(stood: FloatArray) -> FloatArray:
    return (stood[-1] - stood[0])[:2]
