"""Distance between the feet, and how often they are crossed, at the moments when they pass.

A passing is the middle of a swing (:func:`~dualfoot_ros.core.swing_passings`).  The feet are
*crossed* at a passing when the left foot is on the right of the right foot, seen in the direction
of walking.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, FootTrajectory, IntArray, picked, swing_passings
from .accuracy import Statistics, statistics


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
    passed = swing_passings(left.position, right.position, left.stance, right.stance)
    passed = passed.where(left.present & right.present)
    at = constrained if len(constrained) else passed.index
    apart = np.linalg.norm(picked(left.position, at) - picked(right.position, at), axis=1)
    error, crossed = None, None
    if truth is not None:
        true = np.linalg.norm(picked(truth[0], at) - picked(truth[1], at), axis=1)
        error = statistics(apart - true)
        crossed = (
            swing_passings(*truth, left.stance, right.stance)
            .where(left.present & right.present)
            .crossed_percent
        )
    return FeetReport(
        moments="constraint" if len(constrained) else "passing",
        distance_m=statistics(apart),
        distance_error_m=error,
        passings=len(passed.index),
        crossed=int(np.sum(passed.lateral_m < 0)),
        crossed_percent=passed.crossed_percent,
        truth_crossed_percent=crossed,
    )
