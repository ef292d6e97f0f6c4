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
    A foot without a stance has None, and the others are of the foot that has some.
    """

    left_m: float | None
    right_m: float | None
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
    gaps = [_gap(foot) for foot in (left, right)]
    there = [gap for gap in gaps if gap is not None]
    if not there:
        return None
    sizes = [None if gap is None else float(np.linalg.norm(gap)) for gap in gaps]
    ways = [length_m or foot.distance_m for foot in (left, right)]
    known = [(size, way) for size, way in zip(sizes, ways, strict=True) if size is not None]
    mean, way = (sum(values) / len(known) for values in zip(*known, strict=True))
    midpoint = float(np.linalg.norm(sum(there))) / len(there)
    of_left, of_right = (
        None if size is None else percent(size, way) for size, way in zip(sizes, ways, strict=True)
    )
    return Closure(
        left_m=sizes[0],
        right_m=sizes[1],
        mean_m=mean,
        midpoint_m=midpoint,
        left_percent=of_left,
        right_percent=of_right,
        mean_percent=percent(mean, way),
        midpoint_percent=percent(midpoint, way),
    )


def _gap(foot: FootTrajectory) -> FloatArray | None:
    """Return the way (2,) m from the first to the last stance of a foot, if it has any."""
    falls = Footfalls.of(foot)
    if len(falls) == 0:
        return None
    stood = falls.mean(foot.position)
    gap: FloatArray = (stood[-1] - stood[0])[:2]
    return gap
