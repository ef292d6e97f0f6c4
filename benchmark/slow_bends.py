"""What ``aids.straight_lines`` does on bends that are too slow to look like bends (docs, aids).

    python benchmark/slow_bends.py

Simulated walks: 200 m straight, 400 m of a bend, 200 m straight, consumer sensors, three seeds a
radius.  Printed is the error at the end, mean of both feet, in percent of the way; the heading is
that of the first 100 m.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from dualfoot_ros.core import (
    DualFootTracker,
    FloatArray,
    ImuSeries,
    TrackerConfig,
    Trajectory,
)
from dualfoot_ros.evaluation import truth_of
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import SensorConfig, Simulation, WalkConfig, simulate
from dualfoot_ros.simulation.routes import ROUTES, Route, RouteKind, arc, straight
from dualfoot_ros.timing import align

RADII_M = (200.0, 500.0, 1000.0, 2000.0, math.inf)
BEND_M, STRAIGHT_M, ALIGN_M = 400.0, 200.0, 100.0
SEEDS = range(3)


def main() -> None:
    """Print a row a radius: medians without and with the aid."""
    print("radius (m)   without   with   (end error, % of the way, median)")
    for radius in RADII_M:
        errors = np.array([walk_errors(radius, seed) for seed in SEEDS])
        without, aided = np.median(errors, axis=0)
        print(f"{radius:10.0f} {without:9.2f} {aided:6.2f}", flush=True)


def walk_errors(radius: float, seed: int) -> tuple[float, float]:
    """Return the error at the end in percent, without and with the aid."""
    made = simulate(walk_config(radius), seed=seed, sensor=replace(SensorConfig(), gyro_bias=5e-3))
    pair = align(made.left, made.right)
    return end_error(made, pair, aided=False), end_error(made, pair, aided=True)


def walk_config(radius: float) -> WalkConfig:
    """Return a walk with a bend; its route takes the place of the L."""
    angle = 0.0 if math.isinf(radius) else math.degrees(BEND_M / radius)
    bend = straight(BEND_M) if angle == 0.0 else arc(radius, angle)
    route = Route((straight(STRAIGHT_M), bend, straight(STRAIGHT_M)))
    ROUTES["L"] = RouteKind(lambda: route, "straight, bend, straight")
    return WalkConfig(route="L", rate=60.0, standing=20.0)


def end_error(made: Simulation, pair: tuple[ImuSeries, ImuSeries], *, aided: bool) -> float:
    """Return the error of the mean of both feet at the end, percent of the way."""
    config = TrackerConfig.from_mapping({"aids.straight_lines": aided})
    error_m = end_error_m(made, DualFootTracker(config).run(*pair), ALIGN_M)
    return 100.0 * error_m / (BEND_M + 2.0 * STRAIGHT_M)


def end_error_m(made: Simulation, run: Trajectory, align_m: float) -> float:
    """Return the end error (m) of the mean of both feet, with the heading of ``align_m``, m."""
    truth = truth_of(Recording(made.left, made.right, made.left_truth, made.right_truth))
    assert truth is not None
    stamps = run.left.stamp_ns
    places = [np.stack([np.interp(stamps, t.stamp_ns, x) for x in t.position.T]) for t in truth]
    true = 0.5 * (places[0] + places[1])[:2].T
    middle = 0.5 * (run.left.position + run.right.position)[:, :2]
    turned = aligned(middle - middle[0], true - true[0], align_m)
    return float(np.linalg.norm(turned[-1] - (true - true[0])[-1]))


def aligned(way: FloatArray, true: FloatArray, align_m: float) -> FloatArray:
    """Return ``way`` (N, 2) turned so that it has the true direction where it is so long, m."""
    far = int(np.argmax(np.linalg.norm(true, axis=1) > align_m))
    (x, y), (u, v) = way[far], true[far]
    angle = math.atan2(x * v - y * u, x * u + y * v)
    c, s = math.cos(angle), math.sin(angle)
    turned: FloatArray = way @ np.array([[c, s], [-s, c]])
    return turned


if __name__ == "__main__":
    main()
