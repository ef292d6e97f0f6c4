"""How long a pair takes from its samples to the fusion, and how many lack a foot, by max_delay.

    python benchmark/pair_latency.py [--runs 12] [--minutes 5] [--seed 0]

Both feet send 100 samples a second through the streaming aligner in the order of their arrival.
The latency of a pair is from its stamp to the arrival of the sample that completes it.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table

from dualfoot_ros.core.results.events import FEET
from dualfoot_ros.core.samples.series import IntArray
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing import Aligner, AlignerConfig

STEP_NS, APART_NS = 10_000_000, 3_000_000
DELAYS_S = (0.25, 0.5, 1.0, 2.0)
Feet = dict[str, tuple[IntArray, IntArray]]


def steady(stamp_ns: IntArray, rng: np.random.Generator) -> IntArray:
    """Return the arrivals (N,) ns over a link with a jitter of half a millisecond."""
    delay_ns = 1e9 * (0.001 + rng.exponential(0.0005, len(stamp_ns)))
    return np.maximum.accumulate(stamp_ns + np.round(delay_ns).astype(np.int64))


def bluetooth(stamp_ns: IntArray, rng: np.random.Generator) -> IntArray:
    """Return the arrivals (N,) ns over Bluetooth Low Energy with a random connection interval."""
    return arrivals(BleLinkConfig(interval=float(rng.uniform(0.015, 0.05))), stamp_ns, rng)


def feet(link: Callable[..., IntArray], lost: float, minutes: float, seed: int) -> Feet:
    """Return stamps and arrivals of both feet; a share of the samples is ``lost``."""
    made = {}
    for k, foot in enumerate(FEET):
        rng = np.random.default_rng([seed, k])
        stamp_ns = np.arange(round(60.0 * minutes * 1e9 / STEP_NS)) * STEP_NS + k * APART_NS
        arrived_ns, keep = link(stamp_ns, rng), rng.random(len(stamp_ns)) >= lost
        made[foot] = (stamp_ns[keep], arrived_ns[keep])
    return made


def run(streams: Feet, max_delay: float) -> tuple[list[float], int]:
    """Return the latencies (ms) of all pairs, and the number of those with one foot only."""
    aligner, values = Aligner(AlignerConfig(max_delay=max_delay)), np.zeros(6)
    order = sorted(
        (int(arrived), int(stamp), foot)
        for foot, both in streams.items()
        for stamp, arrived in zip(*both, strict=True)
    )
    latencies = [
        1e-6 * (arrived - pair.stamp_ns)
        for arrived, stamp, foot in order
        for pair in aligner.push(foot, stamp, values)
    ]
    return latencies, sum(aligner.counters[f"{foot}_missing"] for foot in FEET)


def latency_table(runs: int, minutes: float, seed: int) -> Table:
    """Return the table."""
    table = Table(title=f"{runs} runs of {minutes:g} min")
    for column in ("links", "max_delay s", "pairs of one foot", "in runs", "latency ms, median",
                   "99 %", "largest"):  # fmt: skip
        table.add_column(column)
    kinds = {"steady": (steady, 0.0), "steady, 5 % lost": (steady, 0.05), "BLE": (bluetooth, 0.0)}
    for name, (link, lost) in kinds.items():
        streams = [feet(link, lost, minutes, seed + k) for k in range(runs)]
        for max_delay in DELAYS_S:
            latencies, late = zip(*(run(each, max_delay) for each in streams), strict=True)
            all_of_them = np.concatenate(latencies)
            figures = (np.median(all_of_them), np.quantile(all_of_them, 0.99), all_of_them.max())
            table.add_row(name, str(max_delay), str(sum(late)), str(np.count_nonzero(late)),
                          *(f"{figure:.2f}" for figure in figures))  # fmt: skip
    return table


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=12)
    parser.add_argument("--minutes", type=float, default=5.0, help="length of a run")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    Console(width=120).print(latency_table(args.runs, args.minutes, args.seed))


if __name__ == "__main__":
    main()
