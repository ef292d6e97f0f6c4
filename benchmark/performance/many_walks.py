"""How many times as fast ``compare`` is on two cores as on one, by the wall clock, in turn."""

from __future__ import annotations

import shutil
import tempfile
import time
from pathlib import Path

from .commands import DEMO, DUALFOOT
from .figure import Figure
from .usage import usage_of

BAGS = 8
ROUNDS = 3
WANTED = "1.8 or more"


def compare_figures() -> list[Figure]:
    """Return the best time of one job over that of two: every method on BAGS copies of the demo.

    On a machine that does something else too, two jobs lose more by it than one.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bags = [str(shutil.copytree(DEMO, folder / f"walk_{k}")) for k in range(BAGS)]
        spent: dict[int, list[float]] = {1: [], 2: []}
        for _ in range(ROUNDS):
            for jobs, times in spent.items():
                times.append(_wall_s(bags, jobs, folder / "report"))
    one, two = min(spent[1]), min(spent[2])
    every = ", ".join(f"{a:.1f} / {b:.1f}" for a, b in zip(spent[1], spent[2], strict=True))
    return [Figure(f"compare: {BAGS} bags on two cores", one / two, "one", f"{every} s", WANTED)]


def _wall_s(bags: list[str], jobs: int, report: Path) -> float:
    """Return how long a comparison takes, with its report."""
    options = ["--jobs", str(jobs), "-o", str(report), "--overwrite"]
    start = time.monotonic()
    usage_of([*DUALFOOT, "compare", *bags, *options])
    return time.monotonic() - start
