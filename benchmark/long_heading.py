"""How far off the heading of long walks is, and what the methods claim of it.

    python -m benchmark.long_heading [--laps 20] [--seeds 8]

Simulated rectangles the same way round at 60 Hz, without any aid.  The error is by how much the
attitude of a foot has turned against its truth between 30 s and the end, mean of both feet.
"""

from __future__ import annotations

import argparse

import numpy as np
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import FootTrajectory, PoseSeries, TrackerConfig, Trajectory
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import Simulation, WalkConfig, simulate

METHODS = ("idc", "spacing_vector", "zupt")
RATE_HZ = 60.0
FIRST = round(30.0 * RATE_HZ)
SPAN, EVERY = 120, 10  # samples of a mean, and how many of them are looked at


def main() -> None:
    """Print a row for each method."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--laps", type=int, default=20, help="of 162 m (default: %(default)s)")
    parser.add_argument("--seeds", type=int, default=8, help="walks (default: %(default)s)")
    options = parser.parse_args()
    found = np.array([claims(options.laps, seed) for seed in range(options.seeds)])
    print("method: error of the heading (rms) and sigma, rad; NEES")
    for name, (error, std) in zip(METHODS, found.transpose(1, 2, 0), strict=True):
        rms, nees = np.sqrt(np.mean(error**2)), np.mean((error / std) ** 2)
        print(f"{name:<15} {rms:.2f} {std.mean():.2f} {nees:.1f}")


def claims(laps: int, seed: int) -> list[tuple[float, float]]:
    """Return the error of the heading and its standard deviation of each method, rad."""
    config = WalkConfig(route="rectangle", rate=RATE_HZ, laps=laps, standing=8.0)
    made = simulate(config, seed=seed)
    samples = Recording(made.left, made.right)
    return [claim(made, track(samples, TrackerConfig(method=name))) for name in METHODS]


def claim(made: Simulation, found: Trajectory) -> tuple[float, float]:
    """Return the error of the heading at the end of a walk and its standard deviation, rad."""
    last = len(found.left.stamp_ns) - SPAN
    feet = ((found.left, made.left_truth), (found.right, made.right_truth))
    turned = [turn(*foot, last) - turn(*foot, FIRST) for foot in feet]
    variance = [foot.attitude_covariance[last, 2, 2] for foot, _ in feet]
    error = float(np.mean(np.angle(np.exp(1j * np.array(turned)))))
    return error, float(np.mean(np.sqrt(variance)))


def turn(foot: FootTrajectory, truth: PoseSeries, first: int) -> float:
    """Return by how much a foot is turned about the vertical against its truth, rad."""
    rows = np.arange(first, first + SPAN, EVERY)
    there = np.minimum(np.searchsorted(truth.stamp_ns, foot.stamp_ns[rows]), len(truth) - 1)
    apart = Rotation.from_quat(foot.quaternion[rows]) * (
        Rotation.from_quat(truth.quaternion[there]).inv()
    )
    return float(np.angle(np.exp(1j * apart.as_rotvec()[:, 2]).mean()))


if __name__ == "__main__":
    main()
