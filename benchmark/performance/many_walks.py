"""How many times as fast many walks are on two cores as on one, by the wall clock, in turn."""

from __future__ import annotations

import shutil
import tempfile
import time
from pathlib import Path

from .commands import DEMO, DUALFOOT
from .figure import Figure
from .usage import usage_of

BAGS = 8
WALKS = 200
WANTED = "1.8 or more"


def compare_figures() -> list[Figure]:
    """Return the gain of ``compare`` and ``consistency``; all methods on BAGS copies of the demo.

    On a machine that does something else too, two jobs lose more by it than one.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bags = [str(shutil.copytree(DEMO, folder / f"walk_{k}")) for k in range(BAGS)]
        report = ["-o", str(folder / "report"), "--overwrite"]
        return [
            _on_two_cores(f"compare: {BAGS} bags", ["compare", *bags, *report], rounds=3),
            _on_two_cores(
                f"consistency: {WALKS} walks", ["consistency", "--walks", str(WALKS)], 1
            ),
        ]


def _on_two_cores(what: str, command: list[str], rounds: int) -> Figure:
    """Return the best time of one job over the best of two."""
    spent: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(rounds):
        for jobs, times in spent.items():
            times.append(_wall_s([*command, "--jobs", str(jobs)]))
    ratio = min(spent[1]) / min(spent[2])
    every = ", ".join(f"{a:.1f} / {b:.1f}" for a, b in zip(spent[1], spent[2], strict=True))
    return Figure(f"{what} on two cores", ratio, "one", f"{every} s", WANTED)


def _wall_s(command: list[str]) -> float:
    start = time.monotonic()
    usage_of([*DUALFOOT, *command])
    return time.monotonic() - start
