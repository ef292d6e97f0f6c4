"""What stamps that jitter cost a track, and what is left of it with the policy ``even``, live.

    python benchmark/jitter.py [--seeds 6]

Simulated rectangles at 100 Hz whose headers are times of arrival over links of some kinds.
"""

from __future__ import annotations

import argparse
from dataclasses import replace

import numpy as np
from rich.console import Console
from rich.table import Table

from dualfoot_ros.core import DualFootError, FloatArray, ImuSeries, IntArray
from dualfoot_ros.evaluation import RunOptions, run
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import Simulation, WalkConfig, simulate
from dualfoot_ros.timing import StampConfig, Stamps

BURST, POLL_NS = 10, 16_000_000
STAND = 400  # samples at the start, of which none is lost
LINKS = (
    ("headers at the sampling", "none", 0.0),
    ("0 to 3 ms late", "uniform 3", 0.0),
    ("0 to 12 ms late", "uniform 12", 0.0),
    ("6 ms late in the mean, exponential", "exponential 6", 0.0),
    ("polled every 16 ms", "polls", 0.0),
    ("ten at a time", "bursts", 0.0),
    ("0 to 12 ms late, 1 % lost", "uniform 12", 0.01),
    ("6 ms late, exponential, 1 % lost", "exponential 6", 0.01),
    ("6 ms late, exponential, 5 % lost", "exponential 6", 0.05),
)


def arrivals(taken: IntArray, link: str, rng: np.random.Generator) -> IntArray:
    """Return when samples taken at (N,) ns arrive over a link, in their order."""
    kind, _, scale = link.partition(" ")
    count = len(taken)
    if kind == "bursts":
        last = np.minimum(np.arange(count) // BURST * BURST + BURST - 1, count - 1)
        late: FloatArray = taken[last] - taken + rng.uniform(0, 5e6, count)[last // BURST]
    elif kind == "polls":
        late = POLL_NS - ((taken - taken[0]) + 3_000_000.0) % POLL_NS
    elif kind == "none":
        return taken
    else:
        draw = rng.uniform(0.0, 1.0, count) if kind == "uniform" else rng.exponential(1.0, count)
        late = 1e6 * float(scale) * draw
    arrived: IntArray = np.maximum.accumulate(taken + late.astype(np.int64)) + np.arange(count)
    return arrived


def evened(series: ImuSeries) -> ImuSeries:
    """Return the series as the policy ``even`` stamps it, without what it withholds."""
    stamps = Stamps(StampConfig(left="even"))
    found = [stamps.stamp("left", t, t) for t in series.stamp_ns.tolist()]
    kept = np.array([stamp is not None for stamp in found])
    given = np.array([stamp for stamp in found if stamp is not None], dtype=np.int64)
    return replace(series[kept], stamp_ns=given)


def rmse(walk: Simulation, feet: list[ImuSeries]) -> float:
    """Return the RMSE of the mid-point of the feet, m; nan where there is no track."""
    recording = Recording(*feet, walk.left_truth, walk.right_truth)
    try:
        report = run(recording, options=RunOptions(check_feet=False)).truth_report
    except DualFootError:  # stamps in bursts may be refused as a whole
        return float("nan")
    return float("nan") if report is None else report.midpoint.rmse_m


def costs(walk: Simulation, seed: int, link: str, lost: float) -> tuple[float, float, float]:
    """Return the errors with the stamps of the sampling, of the arrival, and evened out."""
    rng = np.random.default_rng(seed)
    right, late = [], []
    for series in (walk.left, walk.right):
        keep = rng.random(len(series)) >= lost
        keep[:STAND] = True
        times = arrivals(series.stamp_ns, link, rng)
        right.append(series[keep])
        late.append(replace(series, stamp_ns=times)[keep])
    return rmse(walk, right), rmse(walk, late), rmse(walk, [evened(each) for each in late])


def main() -> None:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=6)
    seeds = range(parser.parse_args().seeds)
    walks = [simulate(WalkConfig(standing=8.0), seed=seed) for seed in seeds]
    table = Table(title=f"RMSE over {len(walks)} walks, median (worst), m")
    for column in ("link", "true stamps", "as they come", "even"):
        table.add_column(column)
    for name, link, lost in LINKS:
        found = np.array([costs(walk, k, link, lost) for k, walk in enumerate(walks)])
        cells = zip(np.median(found, axis=0), found.max(axis=0), strict=True)
        table.add_row(name, *(f"{middle:.3f} ({worst:.2f})" for middle, worst in cells))
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
