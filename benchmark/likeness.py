"""Likeness of simulated to real walks: the table of docs/explanation/simulation.md, "How real".

    python benchmark/likeness.py DATA        DATA: folder of the dual-feet data set
    python benchmark/likeness.py             without it, or where it is not: the simulated ones

Real walks: 15 rectangles and 2 laps with two Xsens DOT on the insteps (Ma and Särkkä 2023).
Simulated ones: the like at 60 Hz with ``consumer`` sensors.  Both are brought on one time grid and
go through the same program; a walk counts from its first to its last sample above 2 rad/s.  A
stance is here 0.15 to 0.8 s of angular rate (less its mean over the first 100 samples) below
0.8 rad/s, to have one definition for both.  kappa is where within it the feet of a ``zupt`` track,
default parameters, are closest.  Coning is the sum of alpha' x alpha / 12 about the vertical over
the walk, alpha' and alpha the rotations of two samples in a row, as degrees in 400 m: outwards on
both feet (to the right on the left foot).
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import DualFootTracker, FootTrajectory, ImuSeries
from dualfoot_ros.core.results.trajectory import stance_bounds
from dualfoot_ros.core.samples.series import FloatArray, IntArray
from dualfoot_ros.inspection import require_usable, unconstrained_config
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import align

MOVING, STILL = 2.0, 0.8  # rad/s
SHORTEST_S, LONGEST_S = 0.15, 0.8
AT_REST = 100  # samples
WAY_M = 400.0
COLUMNS = "real rectangles", "simulated, 1.2 m/s", "real laps", "simulated, 1.6 m/s"
ROWS = (  # name, columns of `foot_figures`, digits, whether the median or the range is told
    ("stance, share of the cycle", [0], 2, "range"),
    ("kappa (from estimated tracks, median)", [1], 2, "range"),
    ("angular rate in stance, median (rad/s)", [2], 2, "range"),
    ("99 % of rate x, y, z (rad/s)", [3, 4, 5], 1, "median"),
    ("99 % of force x, y, z (m/s^2)", [6, 7, 8], 0, "median"),
    ("largest force (m/s^2)", [9], 0, "range"),
    ("coning, left foot, right foot (degrees in 400 m)", [10, 11], 0, "median"),
)


def walk_figures(left: ImuSeries, right: ImuSeries) -> FloatArray:
    """Return the figures (12,) of a walk: the mean of its feet's, and the coning of each."""
    left, right = align(left, right)
    tracks = DualFootTracker(unconstrained_config()).run(left, right)
    apart = np.linalg.norm(tracks.left.position - tracks.right.position, axis=1)
    feet = [foot_figures(foot, tracks.left.stamp_ns, apart) for foot in (left, right)]
    coning = [
        side * coning_term(foot, track)
        for side, foot, track in ((-1, left, tracks.left), (1, right, tracks.right))
    ]
    return np.concatenate([np.array(feet).mean(axis=0), coning])


def coning_term(foot: ImuSeries, track: FootTrajectory) -> float:
    """Return the coning term about the vertical, counter-clockwise, in degrees a ``WAY_M``."""
    _, ours, theirs = np.intersect1d(foot.stamp_ns, track.stamp_ns, return_indices=True)
    rate = foot.angular_rate[ours] - foot.angular_rate[:AT_REST].mean(axis=0)
    alpha = rate[1:] * (1e-9 * np.diff(foot.stamp_ns[ours]))[:, None]
    attitude = Rotation.from_quat(track.quaternion[theirs[1:-1]])
    turned = attitude.apply(np.cross(alpha[:-1], alpha[1:]))[:, 2].sum() / 12.0
    return float(np.degrees(turned) * WAY_M / track.distance_m)


def foot_figures(foot: ImuSeries, stamp_ns: IntArray, apart: FloatArray) -> FloatArray:
    """Return share, kappa, rate in stance, 99 % of rate and of force (3 each), largest force."""
    rate = foot.angular_rate - foot.angular_rate[:AT_REST].mean(axis=0)
    size = np.linalg.norm(rate, axis=1)
    moving = np.flatnonzero(size > MOVING)
    walk = np.zeros(len(size), dtype=bool)
    walk[moving[0] : moving[-1]] = True
    first, last = stance_bounds((size < STILL) & walk).T - [[0], [1]]
    length_s = 1e-9 * (foot.stamp_ns[last] - foot.stamp_ns[first])
    counts = (length_s > SHORTEST_S) & (length_s < LONGEST_S)
    begin, end = foot.stamp_ns[first[counts]], foot.stamp_ns[last[counts]]
    return np.array(
        [
            np.median((end - begin)[:-1] / np.diff(begin)),
            np.median(closest(begin, end, stamp_ns, apart)),
            np.median(size[walk & (size < STILL)]),
            *np.percentile(np.abs(rate[walk]), 99, axis=0),
            *np.percentile(np.abs(foot.specific_force[walk]), 99, axis=0),
            np.linalg.norm(foot.specific_force[walk], axis=1).max(),
        ]
    )


def closest(begin: IntArray, end: IntArray, stamp_ns: IntArray, apart: FloatArray) -> list[float]:
    """Return where within each stance (0 to 1) the feet are closest, if not at one of its ends."""
    found = []
    for start, stop in zip(begin, end, strict=True):
        a, b = np.searchsorted(stamp_ns, start), np.searchsorted(stamp_ns, stop, side="right")
        if b - a > 3 and 0 < (k := int(np.argmin(apart[a:b]))) < b - a - 1:
            found.append(float((stamp_ns[a + k] - start) / (stop - start)))
    return found


def real(paths: list[Path]) -> FloatArray:
    """Return the figures of recordings (N, 12)."""
    walks = [import_recording(ImportOptions(sources=(path,))) for path in paths]
    return np.array([walk_figures(*require_usable(walk)) for walk in walks])


def simulated(count: int, route: str, speed: float) -> FloatArray:
    """Return the figures of simulated walks (N, 12), seeds from 0."""
    config = WalkConfig(route=route, rate=60.0, speed=speed)
    walks = [simulate(config, seed=seed) for seed in range(count)]
    return np.array([walk_figures(walk.left, walk.right) for walk in walks])


def words(figures: FloatArray, digits: int, told: str) -> str:
    """Return one cell of the table, from figures (N, K)."""
    if told == "median":
        return ", ".join(f"{x:.{digits}f}" for x in np.median(figures, axis=0))
    return f"{figures.min():.{digits}f}-{figures.max():.{digits}f}"


def main() -> None:
    """Print the table; without the data set its columns of simulated walks only."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = os.environ.get("DUALFOOT_DATA", ".")
    parser.add_argument("data", nargs="?", default=default, help="folder of the data set")
    data = Path(parser.parse_args().data)
    found = [sorted(data.glob(f"{name}/*.mat")) for name in ("rectangle_ccw", "running_track")]
    walks = [simulated(10, "rectangle", 1.2), simulated(3, "track", 1.6)]
    columns = COLUMNS[1::2]
    if all(found):
        walks = [real(found[0]), walks[0], real(found[1]), walks[1]]
        columns = COLUMNS
    else:
        sys.stderr.write(
            f"the dual-feet data set (rectangle_ccw, running_track) is not in '{data}': without "
            "the real walks; name its folder or set DUALFOOT_DATA to it\n"
        )
    print("| |", " | ".join(columns), "|\n|" + (1 + len(columns)) * "---|")
    for name, which, digits, told in ROWS:
        print("|", " | ".join([name, *(words(w[:, which], digits, told) for w in walks)]), "|")


if __name__ == "__main__":
    main()
