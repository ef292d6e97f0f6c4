"""The person of a simulated walk, followed update by update, beside the truth of the route."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from dualfoot_ros.core import (
    DualFootTracker,
    EventKind,
    ImuPair,
    PersonEstimate,
    PersonTracker,
    SmoothedPerson,
    Smoother,
    TrackerConfig,
)
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import Simulation, WalkConfig, grade, simulate

from ..harness import quick_engine

GRID_M = 0.02


@dataclass(frozen=True)
class Followed:
    """What a live tracker says of the person, and the walk."""

    made: Simulation
    people: list[PersonEstimate]
    smoothed: list[SmoothedPerson]
    turned_ns: list[int]

    @property
    def known(self) -> int:
        """Index of the first estimate whose heading is known."""
        return [p.heading_known for p in self.people].index(True)


@cache
def follow(route: str, rate: float, seed: int = 3) -> Followed:
    """Follow the person over a walk with a consumer sensor on each foot."""
    config = WalkConfig(route=route, rate=rate, standing=4.0)
    made = simulate(config, grade("consumer"), seed=seed)
    tracker = DualFootTracker(TrackerConfig(), engine=quick_engine().name)
    person, smoother = PersonTracker(), Smoother()
    found = Followed(made, [], [], [])
    values = stack_pairs(made.left, made.right)
    for stamp, row in zip(made.left.stamp_ns.tolist(), values, strict=True):
        update = tracker.add(ImuPair(stamp, row))
        turned = any(e.kind is EventKind.HEADING for e in update.announced)
        if turned:
            found.turned_ns.append(stamp)
        estimate = person.add(update)
        if estimate is None:
            continue
        found.people.append(estimate)
        smooth = smoother.add(estimate, moved=turned)
        if smooth is not None:
            found.smoothed.append(smooth)
    return found


def true_places(made: Simulation, stamps: np.ndarray) -> np.ndarray:
    """Return (N, 3) m midway between the sensors at ``stamps``."""
    feet = made.left_truth, made.right_truth
    return 0.5 * sum(
        np.column_stack([np.interp(stamps, t.stamp_ns, t.position[:, i]) for i in range(3)])
        for t in feet
    )


def true_headings(made: Simulation, stamps: np.ndarray) -> np.ndarray:
    """Return (N,) rad: the direction of the route where the person is."""
    route = made.walk.route
    grid = np.linspace(0.0, route.length, int(route.length / GRID_M) + 1)
    points = route.point(grid, np.zeros_like(grid))
    at, headings = 0, []
    for place in true_places(made, stamps)[:, :2]:
        first = max(0, at - 60)
        apart = np.square(points[first : at + 120] - place).sum(axis=1)
        at = first + int(np.argmin(apart))
        headings.append(grid[at])
    return route.heading(np.array(headings))
