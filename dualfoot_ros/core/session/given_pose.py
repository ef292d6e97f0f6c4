"""A pose of the person that is given from outside, and what its covariance makes of the filter's.

With M (4, 30), the person's position and yaw of the error states, and G (30, 4), the error states
of a track that is shifted and turned as a whole, M G = I. What the filter held of the person's
pose is replaced by the covariance C that is given; what it holds of the feet against each other
stays: P = T P T' + G C G' with T = I - G M.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..errors import ConfigError
from ..kernel import Workspace
from ..kernel import layout as lay
from ..samples.series import FloatArray

JOINT_ERRORS = 2 * lay.ERRORS


class GivenPose(NamedTuple):
    """A pose that the person is to have.

    Attributes
    ----------
    position : (3,) m
    yaw : rad
    covariance : (4, 4) of x, y, z (m) and yaw (rad), or None to leave what the filter holds
    """

    position: FloatArray
    yaw: float
    covariance: FloatArray | None = None


def given_pose(
    position: Sequence[float], yaw: float, covariance: FloatArray | None = None
) -> GivenPose:
    """Return the pose, checked.

    Raises
    ------
    ConfigError
        When ``position`` is not three finite numbers, ``yaw`` is not finite, or ``covariance`` is
        not a symmetric positive semi-definite (4, 4).
    """
    place = np.array(position, dtype=np.float64)
    if place.shape != (3,) or not (np.isfinite(place).all() and math.isfinite(yaw)):
        raise ConfigError(
            f"pose is {place.tolist()} m, {yaw} rad; allowed are three finite numbers and a "
            "finite heading"
        )
    if covariance is not None:
        covariance = np.array(covariance, dtype=np.float64)
        if not is_covariance(covariance):
            raise ConfigError(
                f"covariance of the pose is {covariance.tolist()}; allowed is a symmetric matrix "
                "of x, y, z and yaw without a negative eigenvalue"
            )
    return GivenPose(place, float(yaw), covariance)


def is_covariance(matrix: FloatArray) -> bool:
    """Return whether ``matrix`` is a finite, symmetric, positive semi-definite (4, 4)."""
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        return False
    size = max(1.0, float(np.abs(matrix).max()))
    symmetric = bool(np.abs(matrix - matrix.T).max() <= 1e-9 * size)
    return symmetric and float(np.linalg.eigvalsh(matrix)[0]) >= -1e-9 * size


def apply_covariance(space: Workspace, covariance: FloatArray, *, replace: bool) -> None:
    """Put the ``covariance`` (4, 4) of the person's pose into the filter's.

    With ``replace`` it takes the place of what the filter held of that pose; without, as before
    the first step, it comes on top of what the start leaves open.
    """
    joint = space.covariance()
    spread = _spread(space)
    if replace:
        space.w[lay.WALKED] = 0.0
        keep = np.eye(JOINT_ERRORS) - spread @ _mean_pose()
        joint = keep @ joint @ keep.T
    joint += spread @ covariance @ spread.T
    joint = 0.5 * (joint + joint.T)
    left, right = slice(0, lay.ERRORS), slice(lay.ERRORS, JOINT_ERRORS)
    space.own_block(0)[:] = joint[left, left]
    space.own_block(1)[:] = joint[right, right]
    cross = space.w[lay.PLR : lay.PLR + lay.BLOCK].reshape(lay.ERRORS, lay.ROW)
    cross[:, : lay.ERRORS] = joint[left, right]


def _mean_pose() -> FloatArray:
    """Return M: position and yaw of the person by the error states, whose yaw is negative."""
    rows = np.zeros((4, JOINT_ERRORS))
    for foot in range(2):
        for axis in range(3):
            rows[axis, lay.position_row(foot, axis)] = 0.5
        rows[3, lay.attitude_row(foot, 2)] = -0.5
    return rows


def _spread(space: Workspace) -> FloatArray:
    """Return G: what a shift and a turn of the whole track are in the error states."""
    columns = np.zeros((JOINT_ERRORS, 4))
    states = space.w[: 2 * lay.FOOT].reshape(2, lay.FOOT)
    middle = states[:, lay.POS : lay.POS + 3].mean(axis=0)
    for foot, state in enumerate(states):
        arm, velocity = state[lay.POS : lay.POS + 3] - middle, state[lay.VEL : lay.VEL + 3]
        for axis in range(3):
            columns[lay.position_row(foot, axis), axis] = 1.0
        for row, vector in ((lay.position_row, arm), (lay.velocity_row, velocity)):
            columns[row(foot, 0), 3], columns[row(foot, 1), 3] = -vector[1], vector[0]
        columns[lay.attitude_row(foot, 2), 3] = -1.0
    return columns
