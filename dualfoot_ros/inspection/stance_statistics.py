"""Where the two feet stood, as the tracker sees it without any constraint between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import (
    DualFootTracker,
    FootTrajectory,
    ImuSeries,
    TrackerConfig,
    Trajectory,
    stance_bounds,
)
from ..timing import AlignerConfig, align


@dataclass(frozen=True)
class Stances:
    """The stances of one foot: how many, their median length (s), their share of the walk."""

    count: int
    median_s: float
    share: float
    distance_m: float


def free_config(config: TrackerConfig) -> TrackerConfig:
    """Return what tracks the feet with nothing between them, for those who compare the tracks.

    Only what finds stands and stances, and where the sensors sit, is taken over.  A constraint or
    an aid would bend the tracks (a field turns with each sensor's own iron), and so would another
    noise or first heading: how far two tracks drift apart is known of the default filter alone.
    """
    return TrackerConfig(
        method="zupt",
        gravity=config.gravity,
        alignment=config.alignment,
        stance=config.stance,
        zupt=config.zupt,
    )


def free_tracks(
    left: ImuSeries, right: ImuSeries, sync: AlignerConfig | None = None
) -> Trajectory:
    """Track both feet without any constraint between them.

    Raises
    ------
    AlignmentError
        Without a standstill.
    """
    return DualFootTracker(TrackerConfig(method="zupt")).run(*align(left, right, sync))


def stances_of(trajectory: Trajectory) -> dict[str, Stances]:
    """Return the stances of both feet."""
    return {"left": _of(trajectory.left), "right": _of(trajectory.right)}


def _of(foot: FootTrajectory) -> Stances:
    bounds = stance_bounds(foot.stance)
    if not len(bounds):
        return Stances(0, float("nan"), 0.0, 0.0)
    lengths = (foot.stamp_ns[bounds[:, 1] - 1] - foot.stamp_ns[bounds[:, 0]]) * 1e-9
    walk = slice(bounds[0, 1], bounds[-1, 0])
    share = float(foot.stance[walk].mean()) if walk.stop > walk.start else 0.0
    return Stances(len(bounds), float(np.median(lengths)), share, foot.distance_m)
