"""Start-up in a process of its own: with a cold cache, with a warm one, and of a live tracker."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SCRIPT = """
import time; start = time.perf_counter()
import json, numpy as np
from dualfoot_ros.core import DualFootTracker, ImuPair
imported = time.perf_counter()
tracker = DualFootTracker(engine={engine!r})
tracker.add(ImuPair(1, np.zeros(12)))
ready = time.perf_counter()
print(json.dumps([imported - start, ready - start]))
"""


def start_up(engine: str, cache: Path) -> float:
    """Return the seconds from the first import to the first pair taken."""
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT.format(engine=engine)],
        env={**os.environ, "DUALFOOT_CACHE_DIR": str(cache)},
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
    )
    return float(json.loads(done.stdout)[1])


def start_ups(repetitions: int, cold: bool) -> dict[str, float]:
    """Return start-up times in s: compiled with a cold and a warm cache, and live ("auto")."""
    found: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        cache = Path(name)
        first = start_up("compiled", cache)
        if cold:
            found["cold_s"] = first
        runs = [(start_up("compiled", cache), start_up("auto", cache)) for _ in range(repetitions)]
    warm, live = (statistics.median(times) for times in zip(*runs, strict=True))
    found.update(warm_s=warm, live_s=live)
    if cold:
        found["cold_over_warm"] = first / warm
    return found
