"""An epoch of both feet in batch and live, beside the C epoch in the same minute."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from dualfoot_ros.core import DualFootTracker, TrackerConfig

from ..cases import Walk
from .c_epoch import CEpoch
from .figure import Figure

METHODS = {"zupt": "zupt", "idc": "idc", "default": TrackerConfig().method}
BATCH_WANTED = {"zupt": 1.5, "idc": 2.5, "default": 2.5}
LIVE_WANTED = 4.0


def epoch_figures(c: CEpoch, repetitions: int) -> list[Figure]:
    """Return the CPU time of an epoch by method, batch and live, over that of the C epoch."""
    cases = [
        (f"{kind} {name}", run(c.walk, method), wanted)
        for kind, run in (("batch", _batch), ("live", _live))
        for name, method in METHODS.items()
        for wanted in (BATCH_WANTED[name] if kind == "batch" else LIVE_WANTED,)
    ]
    costs: dict[str, list[float]] = {name: [] for name, _, _ in cases}
    ratios: dict[str, list[float]] = {name: [] for name, _, _ in cases}
    for repetition in range(repetitions + 1):
        for name, run_case, _ in cases:
            us, unit = run_case(), c.us()
            if repetition:  # the first one warms up
                costs[name].append(us)
                ratios[name].append(us / unit)
    return [
        Figure(
            name,
            statistics.median(ratios[name]),
            "C",
            f"{statistics.median(costs[name]):.2f} us",
            wanted,
        )
        for name, _, wanted in cases
    ]


def _batch(walk: Walk, method: str) -> Callable[[], float]:
    def run() -> float:
        tracker = DualFootTracker(TrackerConfig(method=method), engine="compiled")
        start = time.process_time()
        tracker.run(walk.left, walk.right)
        return 1e6 * (time.process_time() - start) / len(walk.pairs)

    return run


def _live(walk: Walk, method: str) -> Callable[[], float]:
    def run() -> float:
        add = DualFootTracker(TrackerConfig(method=method), engine="compiled").add
        start = time.process_time()
        for pair in walk.pairs:
            add(pair)
        return 1e6 * (time.process_time() - start) / len(walk.pairs)

    return run
