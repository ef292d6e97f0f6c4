"""How well the person's heading follows the route in simulation, and whether its sigma holds.

``python -m benchmark.person_heading``: RMS error within a second of a corner and elsewhere, the
largest error, and the NEES; the route's start is straight, so that headings have the same origin.
"""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np

from dualfoot_ros.core import DualFootTracker, FloatArray, ImuPair, IntArray, PersonTracker
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import Simulation, WalkConfig, grade, simulate

ROUTES = ("L", "rectangle")
RATES = (60.0, 100.0, 200.0)
GRID_M = 0.02
AROUND = 60, 120  # points of the grid behind and ahead of the last place
TURNING = 0.02  # rad/s
NEAR_S = 1.0


def main() -> int:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=4, help="walks a line (default 4)")
    options = parser.parse_args()
    sys.stdout.write("route, Hz, corners (deg RMS), elsewhere (deg RMS), largest (deg), NEES\n")
    for route in ROUTES:
        for rate in RATES:
            rows = np.concatenate([errors(route, rate, k) for k in range(options.seeds)])
            error, near, variance = rows.T
            corner = near > 0.0
            sys.stdout.write(
                f"{route}, {rate:.0f}, {rms(error[corner]):.1f}, {rms(error[~corner]):.1f}, "
                f"{math.degrees(np.abs(error).max()):.1f}, {np.mean(error**2 / variance):.2f}\n"
            )
    return 0


def rms(error: FloatArray) -> float:
    """Return the root mean square of errors (N,) rad in degrees."""
    return math.degrees(float(np.sqrt(np.mean(error**2))))


def errors(route: str, rate: float, seed: int) -> FloatArray:
    """Return (N, 3): heading error (rad), 1 near a corner, and the variance (rad^2)."""
    config = WalkConfig(route=route, rate=rate)
    made = simulate(config, grade("consumer"), seed=seed)
    tracker, person = DualFootTracker(engine="compiled"), PersonTracker()
    values = stack_pairs(made.left, made.right)
    pairs = zip(made.left.stamp_ns.tolist(), values, strict=True)
    people = [p for s, v in pairs if (p := person.add(tracker.add(ImuPair(s, v))))]
    known = [p for p in people if p.heading_known]
    stamps = np.array([p.stamp_ns for p in known])
    truth = true_headings(made, stamps)
    estimate = np.array([p.heading for p in known])
    error = np.mod(estimate - truth + math.pi, math.tau) - math.pi
    seconds = (stamps - stamps[0]) * 1e-9
    turning = seconds[np.abs(np.gradient(truth, seconds)) > TURNING]
    near = np.abs(seconds[:, None] - turning[None, ::5]).min(axis=1) < NEAR_S
    return np.column_stack([error, near, [p.pose_covariance[5, 5] for p in known]])


def true_headings(made: Simulation, stamps: IntArray) -> FloatArray:
    """Return (N,) rad: the direction of the route at the point next to the middle of the feet."""
    feet = made.left_truth, made.right_truth
    places = 0.5 * sum(
        np.column_stack([np.interp(stamps, t.stamp_ns, t.position[:, i]) for i in range(2)])
        for t in feet
    )
    route = made.walk.route
    grid = np.linspace(0.0, route.length, int(route.length / GRID_M) + 1)
    points = route.point(grid, np.zeros_like(grid))
    at, progress = 0, []
    for place in places:
        first = max(0, at - AROUND[0])
        apart = np.square(points[first : at + AROUND[1]] - place).sum(axis=1)
        at = first + int(np.argmin(apart))
        progress.append(grid[at])
    return route.heading(np.array(progress))


if __name__ == "__main__":
    sys.exit(main())
