"""Growth over a long walk: cost of an epoch from 1 min to hours, memory of a live tracker."""

from __future__ import annotations

import gc
import time
import tracemalloc
from collections.abc import Iterator

from dualfoot_ros.core import DualFootTracker, ImuPair, TrackerConfig

from ..cases import Walk, make_walk
from .figure import Figure

RATE_HZ = 200.0
HOURS = 8.0
MINUTES = (1.0, 60.0, HOURS * 60.0)
SAMPLED_S = 60.0  # of the walk, over which a cost is measured
STOOD_S = 4.0  # at the start of a lap


def growth_figures(hours: float = HOURS) -> list[Figure]:
    """Return the cost of `add` after a minute, an hour and ``hours``, and the memory kept.

    The laps of a walk follow each other without a gap, as fast as the tracker takes them.
    """
    walk = make_walk(RATE_HZ, laps=1)
    tracker = DualFootTracker(TrackerConfig(), engine="compiled")
    costs: dict[float, float] = {}
    kept: dict[float, float] = {}
    feed = _endless(walk)
    done_s = 0.0
    tracemalloc.start()
    for minutes in [m for m in MINUTES if m <= hours * 60.0]:
        _run(tracker, feed, minutes * 60.0 - done_s)
        costs[minutes] = _run(tracker, feed, SAMPLED_S)
        done_s = minutes * 60.0 + SAMPLED_S
        gc.collect()
        kept[minutes] = tracemalloc.get_traced_memory()[0] / 1e6
    tracemalloc.stop()
    first = min(costs)
    return [
        Figure(
            f"growth: add after {minutes:g} min",
            costs[minutes] / costs[first],
            f"after {first:g} min",
            f"{kept[minutes]:.2f} MB kept",
            1.0,
        )
        for minutes in costs
    ]


def _run(tracker: DualFootTracker, feed: Iterator[ImuPair], seconds: float) -> float:
    """Feed so many seconds of the walk; return the CPU time of one pair, s."""
    count = max(0, round(seconds * RATE_HZ))
    start = time.process_time()
    for _ in range(count):
        tracker.add(next(feed))
    return (time.process_time() - start) / max(1, count)


def _endless(walk: Walk) -> Iterator[ImuPair]:
    """Yield laps one after the other: with the stand of the start in the first only."""
    step_ns = round(1e9 / RATE_HZ)
    stamp_ns = walk.pairs[0].stamp_ns
    first = round(STOOD_S * RATE_HZ)
    lap = walk.pairs
    while True:
        for pair in lap:
            yield ImuPair(stamp_ns, pair.values)
            stamp_ns += step_ns
        lap = walk.pairs[first:]
