"""Memory: what a tracker holds for good, and what a batch run needs for an hour of samples."""

from __future__ import annotations

import tracemalloc

from dualfoot_ros.core import DualFootTracker, TrackerConfig

from .cases import Walk


def memory(walk: Walk, method: str) -> dict[str, float]:
    """Return MiB: a live tracker's own, and the peak of `run` for an hour at the walk's rate."""
    tracker = DualFootTracker(TrackerConfig(method=method), engine="compiled")
    tracemalloc.start()
    for pair in walk.pairs:
        tracker.add(pair)
    live = tracemalloc.get_traced_memory()[0]
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    batch = DualFootTracker(TrackerConfig(method=method), engine="compiled")
    result = batch.run(walk.left, walk.right)
    kept, peak = (value - before for value in tracemalloc.get_traced_memory())
    tracemalloc.stop()
    hours = walk.duration_s / 3600.0
    del result
    mib = 1024.0**2
    return {
        "live_mib": live / mib,
        "batch_peak_mib_per_hour": peak / hours / mib,
        "result_mib_per_hour": kept / hours / mib,
    }
