"""The point between the feet: half of each, or all of the foot that alone has samples.

As live (``core.Update``): a foot without samples says nothing of where the person is, and the
person is within ``ONE_FOOT_STD`` of the other one.
"""

from __future__ import annotations

import numpy as np

from ..core import ONE_FOOT_STD, FloatArray, IntArray, Trajectory


def person_shares(trajectory: Trajectory) -> FloatArray:
    """Return the shares (2, N) of the left and the right foot in the person, whose sum is one."""
    left, right = trajectory.left.present, trajectory.right.present
    of_left = np.where(left == right, 0.5, np.where(left, 1.0, 0.0))
    return np.array([of_left, 1.0 - of_left])


def person_position(trajectory: Trajectory) -> FloatArray:
    """Return the position (N, 3) m between the sensors of the feet that are there."""
    left, right = person_shares(trajectory)[:, :, None]
    position: FloatArray = left * trajectory.left.position + right * trajectory.right.position
    return position


def person_covariance(trajectory: Trajectory, rows: slice | IntArray) -> FloatArray:
    """Return the covariance (K, 3, 3) m^2 of that position at the epochs ``rows``.

    Var(a l + b r) = a P_l + b P_r - a b Var(l - r) where a + b = 1; without the last, an upper
    bound.
    """
    a, b = person_shares(trajectory)[:, rows, None, None]
    left, right = trajectory.left, trajectory.right
    own = a * left.position_covariance[rows] + b * right.position_covariance[rows]
    joint = own - a * b * trajectory.relative_covariance[rows]
    alone = np.where(a * b == 0.0, ONE_FOOT_STD**2, 0.0) * np.eye(3)
    found: FloatArray = np.where(np.isnan(joint), own, joint) + alone
    return found
