"""Whether the trust in the position holds: over simulated walks, and on real closed laps.

``python -m benchmark.trust --walks 100``; ``--data FOLDER`` adds the laps of the dual-feet data
set (default: ``DUALFOOT_DATA``; skipped where it is absent).
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from dualfoot_ros.core import DualFootTracker, FloatArray, Trajectory
from dualfoot_ros.evaluation import track
from dualfoot_ros.evaluation.metrics.position_trust import trust_series
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import WalkConfig, grade, simulate

ROUTES = ("L", "rectangle", "track")
ASKED_AT = (0.05, 0.1, 0.25, 0.5, 0.75)  # share of the walk at which the forecast is judged


def main() -> int:
    """Print the shares in which radius and forecast hold."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--walks", type=int, default=40, help="of each route (default 40)")
    parser.add_argument("--limit", type=float, default=3.0, help="m (default 3)")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--data", type=Path, default=Path(os.environ.get("DUALFOOT_DATA", "")))
    options = parser.parse_args()
    sys.stdout.write("route, walks, radius holds (%), forecasts, forecast holds (%)\n")
    with ProcessPoolExecutor(options.workers) as pool:
        for route in ROUTES:
            judge = partial(simulated, route, options.limit)
            report(route, list(pool.map(judge, range(options.walks))))
    for path in sorted((options.data / "running_track").glob("*.mat")):
        report(path.stem, [closed_lap(path, options.limit)])
    return 0


Judged = tuple[list[bool], list[bool]]


def report(name: str, found: list[Judged]) -> None:
    """Print one line."""
    inside = [ok for radii, _ in found for ok in radii]
    kept = [ok for _, forecasts in found for ok in forecasts]
    share = f"{100.0 * np.mean(kept):.1f}" if kept else "-"
    sys.stdout.write(
        f"{name}, {len(found)}, {100.0 * np.mean(inside):.1f}, {len(kept)}, {share}\n"
    )


def simulated(route: str, limit_m: float, seed: int) -> Judged:
    """Return whether radius and forecast held at each of ``ASKED_AT`` of a simulated walk."""
    made = simulate(WalkConfig(route=route, rate=60.0), grade("consumer"), seed=seed)
    found = DualFootTracker().run(made.left, made.right)
    stamps = found.left.stamp_ns
    true = 0.5 * sum(
        np.column_stack([np.interp(stamps, t.stamp_ns, t.position[:, i]) for i in range(2)])
        for t in (made.left_truth, made.right_truth)
    )
    place = middle(found)
    error = np.linalg.norm(place - place[0] - true + true[0], axis=1)
    epochs, trusts = trust_series(found, limit_m)
    inside, kept = [], []
    for at in (int(share * len(trusts)) for share in ASKED_AT):
        inside.append(bool(error[epochs[at]] <= trusts[at].radius_m))
        if math.isfinite(trusts[at].time_left_s):
            last = min(at + round(trusts[at].time_left_s), len(epochs) - 1)
            kept += [bool((error[epochs[at] : epochs[last] + 1] <= limit_m).all())] * (last > at)
    return inside, kept


def closed_lap(path: Path, limit_m: float) -> Judged:
    """Return whether the radius at the end holds the distance of end and start of a lap."""
    found = track(import_recording(ImportOptions(sources=(path,))))
    place = middle(found)
    epochs, trusts = trust_series(found, limit_m)
    gap = float(np.linalg.norm(place[epochs[-1]] - place[0]))
    passed = list(untrusted(trusts))
    sys.stdout.write(
        f"  {path.stem}: ends {gap:.2f} m off, radius {trusts[-1].radius_m:.2f} m, beyond "
        f"{limit_m:g} m after {passed[0] if passed else math.inf:.0f} s\n"
    )
    return [gap <= trusts[-1].radius_m], []


def untrusted(trusts: list) -> Iterator[float]:
    """Yield the times (s) at which the radius is beyond the limit."""
    for trust in trusts:
        if not trust.trusted:
            yield (trust.stamp_ns - trusts[0].stamp_ns) * 1e-9


def middle(found: Trajectory) -> FloatArray:
    """Return (N, 2) m midway between the feet."""
    place: FloatArray = 0.5 * (found.left.position + found.right.position)[:, :2]
    return place


if __name__ == "__main__":
    sys.exit(main())
