"""The point between the feet: half of each, or all of the foot that alone has samples.

As live (``core.Update``): a foot without samples says nothing of where the person is, and the
person is within ``ONE_FOOT_STD`` of the other one.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..core import (
    ONE_FOOT_STD,
    BoolArray,
    Covariances,
    FloatArray,
    IntArray,
    Trajectory,
    new_array,
    picked,
    row_blocks,
)

BLOCK = 1 << 12  # epochs whose matrices are made at once
ALL = slice(None)


def person_shares(trajectory: Trajectory, rows: slice | IntArray | BoolArray = ALL) -> FloatArray:
    """Return the shares (2, N) of the left and the right foot in the person, whose sum is one."""
    left, right = trajectory.left.present[rows], trajectory.right.present[rows]
    of_left = np.where(left == right, 0.5, np.where(left, 1.0, 0.0))
    return np.array([of_left, 1.0 - of_left])


def person_position(trajectory: Trajectory, rows: slice | IntArray) -> FloatArray:
    """Return the position (K, 3) m between the sensors of the feet that are there."""
    a, b = person_shares(trajectory, rows)[:, :, None]
    left, right = (picked(f.position, rows) for f in (trajectory.left, trajectory.right))
    position: FloatArray = a * left + b * right
    return position


def person_positions(trajectory: Trajectory) -> FloatArray:
    """Return that position at all epochs, (N, 3) m."""
    positions = new_array(trajectory.left.position.shape)
    for rows in row_blocks(len(positions)):
        positions[rows] = person_position(trajectory, rows)
    return positions


def person_covariance(trajectory: Trajectory, rows: slice | IntArray | BoolArray) -> FloatArray:
    """Return the covariance (K, 3, 3) m^2 of that position at the epochs ``rows``.

    Var(a l + b r) = a P_l + b P_r - a b Var(l - r) where a + b = 1; without the last, an upper
    bound.
    """
    a, b = person_shares(trajectory, rows)[:, :, None, None]
    left, right = trajectory.left, trajectory.right
    own = a * left.position_covariance[rows] + b * right.position_covariance[rows]
    joint = own - a * b * trajectory.relative_covariance[rows]
    alone = np.where(a * b == 0.0, ONE_FOOT_STD**2, 0.0) * np.eye(3)
    found: FloatArray = np.where(np.isnan(joint), own, joint) + alone
    return found


class PersonCovariances(Covariances):
    """Covariances (N, 3, 3) m^2 of that position, which are calculated when they are looked at."""

    def __init__(self, trajectory: Trajectory) -> None:
        """Take those of ``trajectory``."""
        self._trajectory = trajectory

    def __len__(self) -> int:
        """Return the number of matrices."""
        return len(self._trajectory.left)

    def cut(self, keep: BoolArray | slice) -> Covariances:
        """Return those that a mask (N,) or a slice of neighbours keeps."""
        return Covariances.of(person_covariance(self._trajectory, keep))

    def turned(self, rotation: FloatArray) -> Covariances:
        """Return them turned by a rotation (3, 3)."""
        return Covariances.of(np.asarray(self)).turned(rotation)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        """Return all of them, (N, 3, 3)."""
        found = np.empty(self.shape, dtype=dtype)
        for first in range(0, len(self), BLOCK):
            rows = slice(first, first + BLOCK)
            found[rows] = person_covariance(self._trajectory, rows)
        return found

    def _picked(self, at: Any) -> FloatArray:
        """Return the matrices (..., 3, 3) of epochs ``at``, of any shape."""
        found = person_covariance(self._trajectory, np.ravel(at))
        return found.reshape(*np.shape(at), 3, 3)
