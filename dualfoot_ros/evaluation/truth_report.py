"""An aligned trajectory against the truth: positions, strides, headings, consistency."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import BoolArray, FloatArray, FootTrajectory, PoseSeries, Trajectory, new_array
from .frames.association import Footfalls
from .frames.gauge import Truth
from .metrics.accuracy import Errors, StrideErrors, heading_error, position_errors, stride_errors
from .metrics.heading_split import HeadingErrors, heading_errors
from .metrics.nees import Consistency, consistency


@dataclass(frozen=True)
class TruthReport:
    """Everything that needs the truth."""

    left: Errors
    right: Errors
    midpoint: Errors
    left_strides: StrideErrors
    right_strides: StrideErrors
    heading: HeadingErrors
    nees: Consistency


def against_truth(aligned: Trajectory, truth: Truth) -> TruthReport:
    """Compare an aligned trajectory with the truth at its stamps."""
    feet = (aligned.left, aligned.right)
    falls = [Footfalls.of(foot) for foot in feet]
    turns = [heading_error(f.quaternion, t.quaternion) for f, t in zip(feet, truth, strict=True)]
    both = _where(aligned.left.present & aligned.right.present)
    heading = heading_errors(*(turn[both] for turn in turns))
    left, right, midpoint = _positions(feet, truth, falls)
    return TruthReport(
        left=left,
        right=right,
        midpoint=midpoint,
        left_strides=stride_errors(feet[0], truth[0], falls[0], turns[0]),
        right_strides=stride_errors(feet[1], truth[1], falls[1], turns[1]),
        heading=heading,
        nees=consistency(
            feet, truth, (falls[0].middle, falls[1].middle), aligned.relative_covariance
        ),
    )


def _positions(
    feet: tuple[FootTrajectory, FootTrajectory], truth: Truth, falls: list[Footfalls]
) -> tuple[Errors, Errors, Errors]:
    """Return the errors of both feet and of the middle between them."""
    walked = [f.walked(t.position, t.stamp_ns) for f, t in zip(falls, truth, strict=True)]
    error, other = (_apart(f, t) for f, t in zip(feet, truth, strict=True))
    there = [_where(foot.present) for foot in feet]
    left, right = (
        position_errors(off[rows], way[rows])
        for off, way, rows in zip((error, other), walked, there, strict=True)
    )
    error += other
    error /= 2
    both, way = _where(feet[0].present & feet[1].present), (walked[0] + walked[1]) / 2
    return left, right, position_errors(error[both], way[both])


def _apart(foot: FootTrajectory, true: PoseSeries) -> FloatArray:
    """Return the errors (N, 3) m of a foot."""
    apart: FloatArray = np.subtract(
        foot.position, true.position, out=new_array(true.position.shape)
    )
    return apart


def _where(present: BoolArray) -> BoolArray | slice:
    """Return the epochs (N,) that count: those with samples, or all where none has any."""
    return slice(None) if present.all() or not present.any() else present
