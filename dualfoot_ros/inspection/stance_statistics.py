"""Stances of both feet in figures, and the configuration that tracks them without constraints."""

from __future__ import annotations

from dataclasses import dataclass

from ..core import FootTrajectory, TrackerConfig, Trajectory, median, stance_bounds


@dataclass(frozen=True)
class StanceStatistics:
    """The stances of one foot.

    Attributes
    ----------
    count : their number
    median_s : s, median length; nan without stances
    share : of the walk (from the end of the first stance to the start of the last), 0 to 1
    distance_m : m, walked from stance to stance
    """

    count: int
    median_s: float
    share: float
    distance_m: float


def unconstrained_config(config: TrackerConfig | None = None) -> TrackerConfig:
    """Return the configuration that tracks each foot by itself, with stances as in ``config``.

    Two such tracks can be compared.  Only the parameters of standstills and stances, and where the
    sensors sit, are taken over.  A constraint or an aid would bend the tracks (a magnetic field
    turns with each sensor's own iron), and so would another noise or first heading: how far two
    tracks drift apart is known of the default filter alone.
    """
    config = config or TrackerConfig()
    return TrackerConfig(
        method="zupt",
        gravity=config.gravity,
        increments=config.increments,
        alignment=config.alignment,
        stance=config.stance,
        zupt=config.zupt,
    )


def stance_statistics(trajectory: Trajectory) -> dict[str, StanceStatistics]:
    """Return the statistics of both feet by name."""
    return {"left": _summarise(trajectory.left), "right": _summarise(trajectory.right)}


def _summarise(foot: FootTrajectory) -> StanceStatistics:
    bounds = stance_bounds(foot.stance)
    if not len(bounds):
        return StanceStatistics(0, float("nan"), 0.0, 0.0)
    lengths = (foot.stamp_ns[bounds[:, 1] - 1] - foot.stamp_ns[bounds[:, 0]]) * 1e-9
    walk = slice(bounds[0, 1], bounds[-1, 0])
    share = float(foot.stance[walk].mean()) if walk.stop > walk.start else 0.0
    return StanceStatistics(len(bounds), median(lengths), share, foot.distance_m)
