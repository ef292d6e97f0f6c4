"""What stops on the way and a memory of gyro biases bring on long walks (docs, heading).

    python -m benchmark.long_walk [--seeds 12]

Simulated: 1100 m through streets, consumer sensors that warm up, tracked as it is live (no stand
at the end is used).  The bias of each gyro differs from day to day by 0.25 mrad/s about each axis
(what the shared rectangles of an afternoon leave when the error of a stand is taken off), and the
memory holds what five earlier stands told, each to 0.45 mrad/s.
Printed is the error at the end of the point between the feet, the heading being that of the first
60 m, and the ratio to that of the same walk without stops or memory.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping

import numpy as np

from dualfoot_ros.calibration import BiasMemory, RememberedStand
from dualfoot_ros.core import (
    FEET,
    BiasPrior,
    DualFootTracker,
    FloatArray,
    ImuSeries,
    TrackerConfig,
)
from dualfoot_ros.simulation import Simulation, WalkConfig, simulate
from dualfoot_ros.simulation.sensors import SensorErrors
from dualfoot_ros.timing import align

from .slow_bends import end_error_m

STANDS_S = (0.5, 2.0, 10.0)
STOPS = {"nothing": 0, "three stops of 10 s": 3, "memory of five stands": 0}
DAY_TO_DAY = 2.5e-4  # rad/s
EARLIER, EARLIER_STD = 5, 4.5e-4  # stands in the memory, and how far one is off, rad/s
ALIGN_M = 60.0
AT_REST = 15  # samples of every walk


def main() -> None:
    """Print a row for each length of the stand at the start."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=12, help="walks (default: %(default)s)")
    args = parser.parse_args()
    print("stand at the start, what helps: error at the end (m), median [least, most]; ratio")
    for stand in STANDS_S:
        errors = np.array([walk_errors(stand, k) for k in range(args.seeds)])
        base = errors[:, :1]
        for what, column, ratio in zip(STOPS, errors.T, (errors / base).T, strict=True):
            print(
                f"{stand:5.1f} s  {what:<22} {np.median(column):6.1f} "
                f"[{column.min():.1f}, {column.max():.1f}]  "
                f"{np.median(column) / np.median(base):.2f} (pairwise {np.median(ratio):.2f})",
                flush=True,
            )


def walk_errors(stand: float, seed: int) -> list[float]:
    """Return the errors at the end with nothing, stops, and a memory."""
    found = []
    for what, stops in STOPS.items():
        config = WalkConfig(
            route="city", rate=60.0, standing=stand, stops=stops, stop_duration=10.0
        )
        made = simulate(config, seed=seed)
        priors = remembered(made, seed) if what.startswith("memory") else {}
        found.append(end_error(made, priors))
    return found


def remembered(made: Simulation, seed: int) -> Mapping[str, BiasPrior]:
    """Return what a memory of earlier stands says of both gyros of a walk."""
    memory = BiasMemory()
    sensors = zip(
        FEET, (made.left_errors, made.right_errors), (made.left, made.right), strict=True
    )
    for foot, errors, samples in sensors:
        rng = np.random.default_rng([seed, FEET.index(foot)])
        usual = at_start(errors, samples) + DAY_TO_DAY * rng.standard_normal(3)
        for _ in range(EARLIER):
            told = usual + math.hypot(DAY_TO_DAY, EARLIER_STD) * rng.standard_normal(3)
            x, y, z = told.tolist()
            memory.remember(foot, RememberedStand("", (x, y, z), EARLIER_STD))
    return memory.priors()


def at_start(errors: SensorErrors, samples: ImuSeries) -> FloatArray:
    """Return what a gyro at rest shows (3,) rad/s that has just been switched on."""
    gravity = samples.specific_force[:AT_REST].mean(axis=0)
    bias: FloatArray = errors.rate_bias + errors.rate_warm_up + errors.g_matrix @ gravity
    return bias


def end_error(made: Simulation, priors: Mapping[str, BiasPrior]) -> float:
    """Return by how much the point between the feet is off at the end, m."""
    tracker = DualFootTracker(TrackerConfig())
    for foot, prior in priors.items():
        tracker.declare_bias(foot, prior)
    return end_error_m(made, tracker.run(*align(made.left, made.right)), ALIGN_M)


if __name__ == "__main__":
    main()
