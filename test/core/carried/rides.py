"""Simulated rides for the tests: short walks with a floor that moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from dualfoot_ros.core import DualFootTracker, EventKind, Ride, Trajectory
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import (
    MovingFloorConfig,
    Simulation,
    WalkConfig,
    on_moving_floor,
    simulate,
    walk,
)

from ..harness import Pairs, quick_engine

STANDING = {
    "lift": {"speed": 1.0, "way": 4.0},
    "lift down": {"speed": 1.0, "way": -4.0},
    "fast lift": {"speed": 3.0, "way": 20.0, "acceleration": 1.3},
    "vehicle": {"speed": 6.0, "way": 50.0, "acceleration": 1.8},
    "escalator": {"speed": 0.5},
    "walkway": {"speed": 0.65},
}
WALKING = {"escalator": {"speed": 0.5}, "walkway": {"speed": 0.7}}


@cache
def ride(name: str, *, walking: bool = False, rate: float = 60.0, seed: int = 1) -> Simulation:
    """Return a walk with one ride."""
    settings = (WALKING if walking else STANDING)[name]
    kind = "lift" if "lift" in name else name
    way = WalkConfig(
        route="straight",
        rate=rate,
        standing=4.0,
        stops=0 if walking else 1,
        stop_duration=20.0 if name in ("vehicle", "fast lift") else 14.0,
        final_standing=2.0,
    )
    floor = MovingFloorConfig(kind=kind, walking=walking, **settings)
    return simulate(on_moving_floor(walk(way, seed), floor), seed=seed)


def pairs(made: Simulation) -> Pairs:
    """Return the samples of a simulation without lost samples."""
    return Pairs(made.left.stamp_ns, stack_pairs(made.left, made.right))


@dataclass(frozen=True)
class Carried:
    """A tracked ride: its events, and at the end error (3,) and sigma (3,) of the person, m."""

    trajectory: Trajectory
    rides: list[Ride]
    error: np.ndarray
    sigma: np.ndarray


@cache
def tracked(name: str, *, walking: bool = False, method: str = "spacing_vector") -> Carried:
    """Return a ride tracked offline."""
    from dualfoot_ros.core import TrackerConfig

    made = ride(name, walking=walking)
    tracker = DualFootTracker(TrackerConfig(method=method), engine=quick_engine().name)
    found = tracker.run(made.left, made.right)
    rides = [e.payload for e in found.events if e.kind is EventKind.CARRIED]
    ways = []
    for foot, truth in ((found.left, made.left_truth), (found.right, made.right_truth)):
        true = [np.interp(foot.stamp_ns, truth.stamp_ns, truth.position[:, i]) for i in range(3)]
        place = np.column_stack(true)
        ways.append((foot.position[-1] - foot.position[0]) - (place[-1] - place[0]))
    covariance = 0.25 * (
        2.0 * found.left.position_covariance[-1]
        + 2.0 * found.right.position_covariance[-1]
        - found.relative_covariance[-1]
    )
    return Carried(found, rides, np.mean(ways, axis=0), np.sqrt(np.diag(covariance)))
