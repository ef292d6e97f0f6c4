"""Golden tracks: what the tracker made of five recorded walks, and making them anew.

``make golden`` writes ``test/golden/*.csv`` from the walks beside them and from ``bags/demo``;
``python scripts/golden_tracks.py --walks`` simulates the walks anew as well.  Both are done on
purpose only, and the commit says why the tracks have changed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from dualfoot_ros.core import DualFootTracker, FloatArray, ImuSeries, TrackerConfig
from dualfoot_ros.recording import read_bag
from dualfoot_ros.simulation import ClockConfig, WalkConfig, grade, simulate
from dualfoot_ros.timing import align

ROOT = Path(__file__).resolve().parents[1]
GOLDEN = ROOT / "test" / "golden"
METHODS = ("zupt", "idc", "spacing_vector")
EVERY = 100  # epochs
FORCE_STEP, RATE_STEP = 5e-3, 1e-3  # m/s^2 and rad/s of one count, as in a 16-bit sensor
BAG = "demo"
SKEWED = (
    ClockConfig(offset=3600.0, drift=40.0, phase=0.3, drops=0.01, drop_burst=3.0),
    ClockConfig(offset=3600.0, drift=-25.0, phase=0.8, drops=0.01),
)
WALKS = {  # name: walk, grade of the sensors, clocks, seed
    "corner_60_hz": ({"route": "L", "rate": 60.0, "standing": 4.0}, "good", None, 11),
    "rectangle_100_hz": ({"route": "rectangle", "standing": 4.0}, "consumer", None, 12),
    "stairs_100_hz": ({"route": "stairs", "standing": 4.0}, "consumer", None, 13),
    "clocks_gaps_pause": (
        {"route": "L", "rate": 100.0, "standing": 4.0, "stops": 1, "stop_duration": 6.0},
        "consumer",
        SKEWED,
        14,
    ),
}


def main() -> int:
    """Write the tracks, and the walks when asked to."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--walks", action="store_true", help="simulate the walks anew as well")
    if parser.parse_args().walks:
        for name in WALKS:
            write_walk(name)
    for name in (BAG, *WALKS):
        for method in METHODS:
            path = track_file(name, method)
            np.savetxt(path, track(name, method), fmt="%.10f", delimiter=",", header=HEADER)
            sys.stdout.write(f"wrote {path.relative_to(ROOT)}\n")
    return 0


HEADER = "seconds since the first epoch, left x y z (m), right x y z (m)"


def track_file(name: str, method: str) -> Path:
    """Return the file of a golden track."""
    return GOLDEN / f"{name}_{method}.csv"


def track(name: str, method: str) -> FloatArray:
    """Return (N, 7) seconds and positions (m) of both feet at every hundredth epoch."""
    left, right = read_walk(name) if name != BAG else read_demo()
    config = TrackerConfig.from_mapping({"method": method})
    result = DualFootTracker(config).run(*align(left, right))
    seconds = (result.left.stamp_ns - result.left.stamp_ns[0]) * 1e-9
    rows = np.column_stack([seconds, result.left.position, result.right.position])
    return rows[::EVERY]


def read_demo() -> tuple[ImuSeries, ImuSeries]:
    """Return the recordings of both feet in ``bags/demo``."""
    recording = read_bag(ROOT / "bags" / BAG)
    return recording.left, recording.right


def read_walk(name: str) -> tuple[ImuSeries, ImuSeries]:
    """Return the recordings of both feet of a walk that was simulated and counted."""
    with np.load(GOLDEN / f"{name}.npz") as stored:
        return _series(stored, "left"), _series(stored, "right")


def _series(stored: Mapping[str, np.ndarray], foot: str) -> ImuSeries:
    steps = np.concatenate([[0], np.cumsum(stored[f"{foot}_steps"], dtype=np.int64)])
    return ImuSeries(
        stored[f"{foot}_first"] + steps,
        stored[f"{foot}_force"] * FORCE_STEP,
        stored[f"{foot}_rate"] * RATE_STEP,
    )


def write_walk(name: str) -> None:
    """Simulate a walk and keep it as whole counts, so that it is the same everywhere."""
    walk, sensors, clocks, seed = WALKS[name]
    made = simulate(WalkConfig.from_mapping(walk), grade(sensors), clocks, seed)
    stored: dict[str, np.ndarray] = {}
    for foot, series in (("left", made.left), ("right", made.right)):
        stored[f"{foot}_first"] = series.stamp_ns[:1]
        stored[f"{foot}_steps"] = np.diff(series.stamp_ns).astype(np.int32)
        stored[f"{foot}_force"] = counts(series.specific_force, FORCE_STEP)
        stored[f"{foot}_rate"] = counts(series.angular_rate, RATE_STEP)
    GOLDEN.mkdir(exist_ok=True)
    np.savez_compressed(GOLDEN / f"{name}.npz", **stored)


def counts(values: FloatArray, step: float) -> np.ndarray:
    """Return values (N, 3) in whole steps of 16 bits."""
    return np.clip(np.round(values / step), -32768, 32767).astype(np.int16)


if __name__ == "__main__":
    sys.exit(main())
