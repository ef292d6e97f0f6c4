"""Errors of the gait parameters on simulated walks, against the exact truth of the simulator.

    python -m benchmark.gait_accuracy            the table of docs/reference/gait.md

Truth is taken by the same definitions from the exact motion: placements from the true positions in
the true stances, contact and lift-off from the plan of the walk, angles from the true shoe.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from dualfoot_ros.core import Covariances, FootTrajectory, IntArray, PoseSeries
from dualfoot_ros.evaluation import pair_samples, track_samples, truth_of
from dualfoot_ros.evaluation.gait import (
    PARAMETERS,
    FootContacts,
    Stride,
    find_contacts,
    strides_of,
)
from dualfoot_ros.recording import Recording
from dualfoot_ros.settings import load_config
from dualfoot_ros.simulation import Simulation, WalkConfig, simulate
from dualfoot_ros.simulation.footprints import HEEL_STRIKE, TOE_OFF
from dualfoot_ros.simulation.walk import START_NS

WALKS = (
    {"route": "rectangle", "laps": 4},
    {"route": "track", "speed": 1.5},
    {"route": "figure_eight", "laps": 3, "speed": 0.9},
)
SAME_STRIDE_NS = 200_000_000


def main() -> None:
    """Simulate, track, and print mean and standard deviation of every error."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--method", default="spacing_vector")
    args = parser.parse_args()
    pairs = [p for walk in WALKS for seed in range(args.seeds) for p in compare(walk, seed, args)]
    print(f"{len(pairs)} steady strides, {len(WALKS)} walks, {args.seeds} seeds, {args.method}")
    print("| parameter | mean of the truth | mean error | standard deviation of the error |")
    print("|---|---|---|---|")
    for name, words in PARAMETERS.items():
        print(f"| {words} | " + " | ".join(_figures(pairs, name)) + " |")


def _figures(pairs: list[tuple[Stride, Stride]], name: str) -> Iterator[str]:
    both = np.array([[getattr(stride, name) for stride in pair] for pair in pairs])
    both = both[np.isfinite(both).all(axis=1)]
    error = both[:, 0] - both[:, 1]
    digits = 2 if name.endswith(("deg", "percent", "min")) else 3
    for value in (both[:, 1].mean(), error.mean(), error.std()):
        yield f"{value:.{digits}f}"


def compare(
    walk: dict[str, str | float], seed: int, args: argparse.Namespace
) -> Iterator[tuple[Stride, Stride]]:
    """Yield the steady strides of a walk as estimated and as they truly were."""
    simulation = simulate(WalkConfig.from_mapping(walk), seed=seed)
    recording = Recording(
        simulation.left, simulation.right, simulation.left_truth, simulation.right_truth
    )
    tracked = track_samples(pair_samples(recording), load_config(None, {"method": args.method}))
    estimated = strides_of(tracked.left, tracked.right)
    for true in true_strides(simulation):
        near = [
            s
            for s in estimated
            if s.foot == true.foot and abs(s.end_ns - true.end_ns) < SAME_STRIDE_NS
        ]
        if near and near[0].steady and true.steady:
            yield near[0], true


def true_strides(simulation: Simulation) -> tuple[Stride, ...]:
    """Return the strides by the exact motion and the plan of the walk."""
    truth = truth_of(
        Recording(simulation.left, simulation.right, simulation.left_truth, simulation.right_truth)
    )
    assert truth is not None
    stances = simulation.left_stances, simulation.right_stances
    tracks = [_true_track(*pair) for pair in zip(truth, stances, strict=True)]
    contacts = [_true_contacts(simulation, index, tracks[index]) for index in range(2)]
    return strides_of(tracks[0], tracks[1], (contacts[0], contacts[1]))


def _true_track(truth: PoseSeries, stances: IntArray) -> FootTrajectory:
    stamps = truth.stamp_ns
    stance = np.zeros(len(stamps), dtype=bool)
    for first, last in np.searchsorted(stamps, stances):
        stance[first:last] = True
    speed = np.zeros((len(stamps), 3))
    none = Covariances.of(np.zeros((len(stamps), 3, 3)))
    return FootTrajectory(
        stamps, truth.position, speed, truth.quaternion, stance, none, none, none
    )


def _true_contacts(simulation: Simulation, index: int, track: FootTrajectory) -> FootContacts:
    """Return contact and lift-off as the walk was planned, and the true angles of the shoe."""
    walked = simulation.walk
    prints = walked.footprints
    rows = prints.rows_of(walked.sides[index])[1:]
    start, window = prints.heel_off_s[rows], prints.flat_s[rows] - prints.heel_off_s[rows]
    off, on = start + TOE_OFF * window, start + HEEL_STRIKE * window
    shoe = walked.shoes[index].spline
    begin = simulation.left_truth.stamp_ns[0] if index == 0 else simulation.right_truth.stamp_ns[0]
    origin = (int(begin) - START_NS) * 1e-9
    nan = [math.nan]
    return replace(
        find_contacts(track),
        contact_s=np.append(nan, on - origin),
        lift_off_s=np.append(off - origin, nan),
        contact_deg=np.append(nan, -np.degrees(shoe(on)[:, 4])),
        lift_off_deg=np.append(-np.degrees(shoe(off)[:, 4]), nan),
    )


if __name__ == "__main__":
    main()
