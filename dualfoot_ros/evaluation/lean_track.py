"""A trajectory with no more covariances than its figures and its report need.

Those of velocity and attitude are the greater half of the memory of a walk, and are looked at only
in the middles of the stances (against a truth), and once a second (how far the place is known).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..core import BoolArray, FootTrajectory, IntArray, Trajectory, stance_middles
from .frames.gauge import Truth, known_to
from .metrics.position_trust import trust_epochs


def lean(trajectory: Trajectory, truth: Truth | None) -> Trajectory:
    """Return the trajectory; where nobody will look, velocity and attitude have nan covariances.

    Raises
    ------
    EvaluationError
        When the truth does not overlap the estimate.
    """
    stamps = trajectory.left.stamp_ns
    if len(stamps) == 0:
        return trajectory
    looked_at = trust_epochs(stamps)
    keep = np.zeros(len(stamps), dtype=bool) if truth is None else known_to(stamps, truth)
    left, right = (_foot(foot, looked_at, keep) for foot in (trajectory.left, trajectory.right))
    return replace(trajectory, left=left, right=right)


def _foot(foot: FootTrajectory, looked_at: IntArray, keep: BoolArray) -> FootTrajectory:
    stood = np.flatnonzero(keep)[stance_middles(foot.stance[keep])]
    return replace(
        foot,
        velocity_covariance=foot.velocity_covariance.only(stood),
        attitude_covariance=foot.attitude_covariance.only(np.union1d(stood, looked_at)),
    )
