"""Normalised estimation error squared (NEES): consistency of the covariance with the errors.

For a consistent filter ``e' P^-1 e`` has the mean of its number of dimensions (Bar-Shalom et al.
2001, section 5.4), so the figures here, divided by that number, are 1 for a consistent filter and
larger for an over-confident one.  Heading and position are compared after the alignment, so the
errors that it removes do not count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import Covariances, FloatArray, FootTrajectory, IntArray, PoseSeries, picked
from ..frames.between_poses import turns_between

SMALLEST_STD = 1e-4
"""Lower bound of the standard deviations (m, m/s, rad); a hard constraint makes them zero."""


def nees(error: FloatArray, covariance: FloatArray) -> FloatArray:
    """Return (N,) NEES, divided by the dimension D, of (N, D) errors with (N, D, D) covariances.

    Variances along the principal axes are raised to ``SMALLEST_STD`` squared, since a covariance
    is singular by construction right after an equality constraint.
    """
    variance, axes = np.linalg.eigh(covariance)
    along = np.einsum("nji,nj->ni", axes, error)
    nees: FloatArray = np.mean(along**2 / np.maximum(variance, SMALLEST_STD**2), axis=1)
    return nees


@dataclass(frozen=True)
class Consistency:
    """Mean NEES over the stances' middles, divided by the dimension (1 if consistent)."""

    left_position: float
    right_position: float
    left_velocity: float | None
    right_velocity: float | None
    left_attitude: float
    right_attitude: float
    relative_position: float


def consistency(
    feet: tuple[FootTrajectory, FootTrajectory],
    truth: tuple[PoseSeries, PoseSeries],
    middles: tuple[IntArray, IntArray],
    relative_covariance: Covariances,
) -> Consistency:
    """Return the NEES of both aligned feet against the truth at the same stamps."""
    rows = [_foot(foot, true, at) for foot, true, at in zip(feet, truth, middles, strict=True)]
    (left_p, left_v, left_a), (right_p, right_v, right_a) = rows
    at = np.concatenate(middles)
    (left, right), (true_left, true_right) = (
        [picked(each.position, at) for each in both] for both in (feet, truth)
    )
    apart = left - right - (true_left - true_right)
    return Consistency(
        left_position=left_p,
        right_position=right_p,
        left_velocity=left_v,
        right_velocity=right_v,
        left_attitude=left_a,
        right_attitude=right_a,
        relative_position=_mean(apart, relative_covariance, at),
    )


def _foot(
    foot: FootTrajectory, true: PoseSeries, at: IntArray
) -> tuple[float, float | None, float]:
    """Return the mean NEES of position, of velocity where it is known, and of attitude."""
    velocity = None
    if true.velocity is not None:
        off = picked(foot.velocity, at) - picked(true.velocity, at)
        velocity = _mean(off, foot.velocity_covariance, at)
    attitude = float("nan")
    if len(at):
        turned = turns_between(picked(true.quaternion, at), picked(foot.quaternion, at))
        own = Covariances.of(foot.attitude_covariance[at])
        attitude = _mean(turned, own, np.arange(len(at)))
    apart = picked(foot.position, at) - picked(true.position, at)
    position = _mean(apart, foot.position_covariance, at)
    return position, velocity, attitude


def _mean(error: FloatArray, covariance: Covariances, at: IntArray) -> float:
    """Return the mean NEES of the errors (K, 3) at the epochs ``at`` (K,).

    It is nan without epochs or without a covariance.
    """
    there = covariance[at]
    if len(at) == 0 or not np.isfinite(there).all():
        return float("nan")
    return float(np.mean(nees(error, there)))
