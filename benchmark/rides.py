"""What rides cost a track: lifts, escalators, walkways and cars, looked for and not looked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from dualfoot_ros.core import EventKind, FloatArray, TrackerConfig
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import MovingFloorConfig, WalkConfig, on_moving_floor, simulate
from dualfoot_ros.simulation import walk as make_walk

RIDES: dict[str, tuple[dict[str, object], float]] = {  # settings, duration of the stop, s
    "lift, 12 m at 1 m/s": ({"kind": "lift", "way": 12.0}, 25.0),
    "lift, 40 m at 3 m/s": ({"kind": "lift", "way": 40.0, "speed": 3.0}, 35.0),
    "lift, 6 m down": ({"kind": "lift", "way": -6.0}, 20.0),
    "escalator, standing on it": ({"kind": "escalator", "speed": 0.5}, 18.0),
    "escalator, walking on it": ({"kind": "escalator", "speed": 0.5, "walking": True}, 0.0),
    "walkway, standing on it": ({"kind": "walkway", "speed": 0.65}, 30.0),
    "walkway, walking on it": ({"kind": "walkway", "speed": 0.65, "walking": True}, 0.0),
    "car, 200 m": (
        {"kind": "vehicle", "way": 200.0, "speed": 12.0, "acceleration": 1.5},
        60.0,
    ),
}


@dataclass(frozen=True)
class Ride:
    """What came of a ride: events, and of the person error and sigma (2,) m, level and up."""

    said: int
    error: FloatArray
    sigma: FloatArray


def ridden(settings: dict[str, object], stop_s: float, seed: int, *, watch: bool) -> Ride:
    """Track a rectangle with a ride."""
    way = WalkConfig(stops=1, stop_duration=stop_s) if stop_s else WalkConfig()
    moved = on_moving_floor(make_walk(way, seed), MovingFloorConfig.from_mapping(settings))
    made = simulate(moved, seed=seed)
    config = TrackerConfig.from_mapping({"floor.watch": watch})
    found = track(Recording(made.left, made.right), config)
    errors = []
    for foot, truth in ((found.left, made.left_truth), (found.right, made.right_truth)):
        first, last = np.searchsorted(truth.stamp_ns, foot.stamp_ns[[0, -1]])
        last = min(int(last), len(truth.stamp_ns) - 1)
        true = truth.position[last] - truth.position[first]
        errors.append(foot.position[-1] - foot.position[0] - true)
    error = np.mean(errors, axis=0)
    covariance = 0.25 * (
        2.0 * (found.left.position_covariance[-1] + found.right.position_covariance[-1])
        - found.relative_covariance[-1]
    )
    level = float(np.sqrt(np.linalg.eigvalsh(covariance[:2, :2]).max()))
    said = sum(event.kind is EventKind.CARRIED for event in found.events)
    return Ride(
        said,
        np.array([np.hypot(error[0], error[1]), abs(error[2])]),
        np.array([level, np.sqrt(covariance[2, 2])]),
    )


def ride_rows(seeds: int) -> Iterator[tuple[str, str]]:
    """Yield what rides cost a track, without looking for them and with it."""
    for name, (settings, stop_s) in RIDES.items():
        before, now = (
            [ridden(settings, stop_s, seed, watch=watch) for seed in range(seeds)]
            for watch in (False, True)
        )
        median, worst, unseen = (
            f"{level:.2f} m level, {up:.2f} m up"
            for level, up in (
                np.median([r.error for r in now], axis=0),
                np.max([r.error for r in now], axis=0),
                np.median([r.error for r in before], axis=0),
            )
        )
        sigma = np.median([r.sigma for r in now], axis=0)
        held = np.mean([(r.error <= 2.0 * r.sigma).all() for r in now])
        yield (
            name,
            f"said in {sum(r.said == 2 for r in now)} of {seeds}; error {median} (median), "
            f"{worst} (worst); sigma {sigma[0]:.2f} and {sigma[1]:.2f} m; within 2 sigma in "
            f"{held:.0%}; not looked for: {unseen}",
        )
