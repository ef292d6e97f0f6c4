"""Errors of one foot, or of the mid-point of both, against the truth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core import (
    FloatArray,
    FootTrajectory,
    PoseSeries,
    picked,
    row_blocks,
    row_lengths,
    unwrapped_angles,
)
from ..frames.association import Footfalls

NO_LENGTH = 1e-6
MARKS_M = 200.0
"""Errors are given at every 200 m of the way, as in Table III of Liu et al. 2023."""


@dataclass(frozen=True)
class Errors:
    """Position errors over a walk; m, three-dimensional unless named otherwise.

    Attributes
    ----------
    rmse_m, max_m : over all epochs (``rmse_m`` is the absolute trajectory error, ATE)
    rmse_horizontal_m, rmse_vertical_m : the same in and out of the plane
    end_m : at the last epoch
    end_percent : of the walked distance of the truth (None where that is zero)
    at_distance_m : error where the truth has walked 200, 400, ... m
    """

    rmse_m: float
    rmse_horizontal_m: float
    rmse_vertical_m: float
    max_m: float
    end_m: float
    end_percent: float | None
    distance_m: float
    at_distance_m: dict[str, float]


def position_errors(error: FloatArray, walked: FloatArray, marks_m: float = MARKS_M) -> Errors:
    """Summarise (N, 3) position errors along the (N,) walked distance."""
    size = row_lengths(error)
    distance = float(walked[-1])
    marks = np.arange(1, int(distance / marks_m) + 1) * marks_m
    return Errors(
        rmse_m=rms(size),
        rmse_horizontal_m=rms(row_lengths(error[:, :2])),
        rmse_vertical_m=rms(error[:, 2]),
        max_m=float(size.max()),
        end_m=float(size[-1]),
        end_percent=percent(float(size[-1]), distance),
        distance_m=distance,
        at_distance_m={f"{mark:g}": float(size[np.argmax(walked >= mark)]) for mark in marks},
    )


@dataclass(frozen=True)
class StrideErrors:
    """Relative pose error, stride by stride (Sturm et al. 2012, with one stride as the delta).

    Attributes
    ----------
    strides : their number
    rmse_m, max_m : error of the displacement from stance to stance, the estimate turned by its
        heading error at the start of the stride, so that drift of before does not count
    turn_rmse_deg : error of the change of heading within a stride
    length_ratio : estimated over true length, summed over all strides
    """

    strides: int
    rmse_m: float
    max_m: float
    turn_rmse_deg: float
    length_ratio: float


def stride_errors(
    estimate: FootTrajectory, truth: PoseSeries, falls: Footfalls, turn: FloatArray
) -> StrideErrors:
    """Compare every stride, from the middle of one stance to that of the next, with the truth.

    ``turn`` (N,) is the :func:`heading_error` of the estimate.
    """
    at = falls.middle
    if len(at) < 2:
        nan = float("nan")
        return StrideErrors(0, nan, nan, nan, nan)
    heading = turn[at]
    moved = turned(np.diff(picked(estimate.position, at), axis=0), -heading[:-1])
    true = np.diff(picked(truth.position, at), axis=0)
    size = np.linalg.norm(moved - true, axis=1)
    length = [np.linalg.norm(v[:, :2], axis=1).sum() for v in (moved, true)]
    return StrideErrors(
        strides=len(size),
        rmse_m=rms(size),
        max_m=float(size.max()),
        turn_rmse_deg=float(np.degrees(rms(np.diff(heading)))),
        length_ratio=float(length[0] / length[1]) if length[1] > 0 else float("nan"),
    )


def heading_error(estimate: FloatArray, truth: FloatArray) -> FloatArray:
    """Return (N,) rad by which the estimate is turned about the vertical, unwrapped.

    It is the twist about z of ``R_estimate R_truth'``, which no roll or pitch of the foot enters.
    """
    turn = np.empty(len(truth))
    for part in row_blocks(len(turn)):
        ex, ey, ez, ew = np.asarray(estimate[part]).T
        tx, ty, tz, tw = np.asarray(truth[part]).T
        z = ez * tw - ew * tz - ex * ty + ey * tx
        w = ew * tw + ex * tx + ey * ty + ez * tz
        turn[part] = 2.0 * np.arctan2(z, w)
    return unwrapped_angles(turn)


def turned(vectors: FloatArray, yaw: FloatArray) -> FloatArray:
    """Return (N, 3) vectors, each turned about z by its own (N,) yaw."""
    c, s = np.cos(yaw), np.sin(yaw)
    x, y, z = vectors.T
    return np.column_stack([c * x - s * y, s * x + c * y, z])


@dataclass(frozen=True)
class Statistics:
    """Mean, root mean square, maximum and standard deviation, as Liu et al. 2023, Table II."""

    count: int
    mean: float
    rms: float
    max: float
    std: float


def statistics(values: FloatArray | Sequence[float]) -> Statistics:
    """Return the statistics of (N,) values; the maximum is that of their size."""
    values = np.asarray(values, dtype=float)
    if len(values) == 0:
        nan = float("nan")
        return Statistics(0, nan, nan, nan, nan)
    largest = float(np.abs(values).max())
    return Statistics(len(values), float(values.mean()), rms(values), largest, float(values.std()))


def rms(values: FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


def percent(part: float, whole: float) -> float | None:
    """Return ``part`` in percent of ``whole``, or None where the whole is zero."""
    return 100.0 * part / whole if whole > NO_LENGTH else None
