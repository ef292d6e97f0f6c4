"""Alignment of the trajectory of both feet to its truth or to floor markers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from ...core import (
    FEET,
    BoolArray,
    EvaluationError,
    FloatArray,
    IntArray,
    PoseSeries,
    Trajectory,
)
from .association import Footfalls, as_slice, truth_at, within
from .yaw_transform import FIRST_STRIDES_M, Align, Pair, YawTransform, fit

Truth = tuple[PoseSeries, PoseSeries]


class Options(NamedTuple):
    """The alignment: method, one transform for both feet or for each, length (m)."""

    align: Align = Align.FIRST_STRIDES
    pair: Pair = Pair.COMMON
    length_m: float = FIRST_STRIDES_M

    def words(self, to: str) -> str:
        """Describe how the frame is fixed to ``to``; markers always take one transform."""
        separate = self.pair is Pair.EACH and to == "truth"
        feet = "one transform for each foot" if separate else "one transform for both feet"
        if self.align is Align.UMEYAMA4:
            how = "yaw and translation of the best fit over the whole walk"
        else:
            how = f"start, and heading over the first {self.length_m:g} m"
        return f"{self.align.value} ({how}), {feet}, to the {to}"


Markers = Mapping[str, FloatArray]
"""Where a foot ("left", "right" or both) stood, stance by stance: (K, 3) m, in order."""


def overlap(trajectory: Trajectory, truth: Truth) -> tuple[Trajectory, Truth]:
    """Return the epochs that lie within the truth of both feet, and the truth at their stamps."""
    stamps = trajectory.left.stamp_ns
    keep = as_slice(known_to(stamps, truth))
    left, right = trajectory.left.cut(keep), trajectory.right.cut(keep)
    relative = trajectory.relative_covariance.cut(keep)
    known = (truth_at(stamps[keep], truth[0]), truth_at(stamps[keep], truth[1]))
    return replace(trajectory, left=left, right=right, relative_covariance=relative), known


def known_to(stamps: IntArray, truth: Truth) -> BoolArray:
    """Return the mask (N,) of the stamps that lie within the truth of both feet."""
    known: BoolArray = within(stamps, truth[0]) & within(stamps, truth[1])
    return known


def find_transforms(
    trajectory: Trajectory, truth: Truth | None, markers: Markers, options: Options
) -> tuple[dict[str, YawTransform], str | None]:
    """Return the transform of each foot and the reference it aligns to; none without one.

    Raises
    ------
    EvaluationError
        When ``first_strides`` finds no heading in the walk.
    """
    if truth is not None:
        return _to_truth(trajectory, truth, options), "truth"
    one = to_markers(trajectory, markers, options)
    return ({}, None) if one is None else ({"left": one, "right": one}, "markers")


def _to_truth(trajectory: Trajectory, truth: Truth, options: Options) -> dict[str, YawTransform]:
    estimates, references = [], []
    for foot, true in zip((trajectory.left, trajectory.right), truth, strict=True):
        falls = Footfalls.of(foot)
        if options.align is Align.FIRST_STRIDES and len(falls) == 0:
            raise EvaluationError(
                "no stance was found in the time of the truth, so first_strides has no start; "
                "align with umeyama4"
            )
        whole = options.align is Align.UMEYAMA4
        estimates.append(foot.position if whole else falls.mean(foot.position))
        references.append(true.position if whole else falls.mean(true.position))
    pairs = list(zip(estimates, references, strict=True))
    first = [bool(foot.present[0]) for foot in (trajectory.left, trajectory.right)]
    begun = [pair for pair, there in zip(pairs, first, strict=True) if there] or pairs
    if options.pair is Pair.COMMON or len(begun) < len(pairs):  # a late foot has no start to join
        one = fit(options.align, [e for e, _ in begun], [r for _, r in begun], options.length_m)
        return {"left": one, "right": one}
    return {
        foot: fit(options.align, [e], [r], options.length_m)
        for foot, (e, r) in zip(FEET, pairs, strict=True)
    }


def to_markers(trajectory: Trajectory, markers: Markers, options: Options) -> YawTransform | None:
    """Fit the feet that stood on markers; return None without markers or with too few stances.

    With ``umeyama4`` a foot whose stances are not as many as its markers does not take part.
    """
    estimates, references = [], []
    for foot, points in markers.items():
        stood = stood_on(trajectory, foot)
        known = min(len(stood), len(points))
        whole = options.align is Align.UMEYAMA4
        if known >= 2 and not (whole and len(stood) != len(points)):
            estimates.append(stood[:known])
            references.append(points[:known])
    if not estimates:
        return None
    return fit(options.align, estimates, references, options.length_m)


def stood_on(trajectory: Trajectory, foot: str) -> FloatArray:
    """Return (M, 3) m, the mean position of every stance of a foot."""
    track = trajectory.left if foot == "left" else trajectory.right
    return Footfalls.of(track).mean(track.position)


def apply_transforms(trajectory: Trajectory, transforms: dict[str, YawTransform]) -> Trajectory:
    """Return the trajectory in the frame of the reference, covariances included."""
    if not transforms:
        return trajectory
    left, right = transforms["left"], transforms["right"]
    return replace(
        trajectory,
        left=left.foot(trajectory.left),
        right=right.foot(trajectory.right),
        relative_covariance=trajectory.relative_covariance.turned(left.matrix),
    )
