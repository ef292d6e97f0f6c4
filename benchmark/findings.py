"""Findings on injected faults, and false alarms: the table of docs/explanation/reliability.md.

    python -m benchmark.findings [DATA]      DATA: folder of the dual-feet data set

Each fault is injected into simulated walks (routes x seeds) and counts as named when one of its
kinds is found.  Clean walks of several gaits, and the real ones where they are there, must show
nothing; those whose clocks were not synchronised are synchronised first.
"""

from __future__ import annotations

import argparse
import os
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track as progress
from rich.table import Table

from dualfoot_ros.core import DualFootError
from dualfoot_ros.evaluation import track
from dualfoot_ros.inspection import (
    Finding,
    coupled_findings,
    findings_of,
    tracker_findings,
    unconstrained_config,
    walk_findings,
)
from dualfoot_ros.recording import Recording
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import synchronise

from .injected_faults import FAULTS

ROUTES: tuple[dict[str, Any], ...] = (
    {"route": "rectangle"},
    {"route": "figure_eight", "rate": 60.0},
    {"route": "L", "rate": 200.0, "speed": 1.5},
)
GAITS: tuple[dict[str, Any], ...] = (
    *ROUTES,
    {"speed": 0.6},
    {"speed": 1.8},
    {"mounting": "heel"},
    {"laps": 3},
    {"route": "straight"},
    {"gait": {"wobble": 0.3, "roll_over": 0.12}},
    {"gait": {"tremor": 0.04, "footprint_std": 0.05, "cycle_std": 0.05}},
)
DATA = Path(__file__).resolve().parents[2] / "shared" / "data" / "dual_feet"


def all_findings(recording: Recording) -> list[Finding]:
    """Return the findings that ``dualfoot info`` has; none on tracks where it cannot track."""
    found = list(findings_of(recording))
    if any(finding.is_error for finding in found):
        return found
    try:
        found += walk_findings(track(recording, unconstrained_config()))
        coupled = track(recording)
        found += [*coupled_findings(coupled), *tracker_findings(coupled)]
    except DualFootError:
        pass
    return found


def inject(seeds: int, console: Console) -> dict[str, tuple[int, int]]:
    """Return how often each fault was named, and in how many walks."""
    walks = [
        simulate(WalkConfig.from_mapping(route), seed=seed)
        for route in ROUTES
        for seed in range(seeds)
    ]
    named: dict[str, tuple[int, int]] = {}
    for fault in progress(FAULTS, "faults", console=console, transient=True):
        found = [
            {f.kind for f in all_findings(fault.inject(walk, np.random.default_rng(seed)))}
            for seed, walk in enumerate(walks)
        ]
        named[fault.name] = sum(not kinds.isdisjoint(fault.kinds) for kinds in found), len(walks)
    return named


def clean(seeds: int, console: Console) -> tuple[Counter[str], int]:
    """Return the false alarms on simulated walks by kind, and the number of walks."""
    alarms: Counter[str] = Counter()
    for gait in progress(GAITS, "gaits", console=console, transient=True):
        for seed in range(seeds):
            made = simulate(WalkConfig.from_mapping(gait), seed=100 + seed)
            alarms.update(f.kind.value for f in all_findings(Recording(made.left, made.right)))
    return alarms, seeds * len(GAITS)


def real_walks(folder: Path) -> Iterator[tuple[str, Recording]]:
    """Yield the walks of the dual-feet data set, on common clocks."""
    for path in sorted(folder.glob("*/*.mat")):
        recording = import_recording(ImportOptions(sources=(path,)))
        if path.parent.name == "unsynchronised":
            assert recording.left is not None and recording.right is not None
            both = synchronise(recording.left, recording.right)
            recording = replace(recording, left=both.left, right=both.right)
        yield f"{path.parent.name}/{path.stem}", recording


def real(folder: Path, console: Console) -> tuple[Counter[str], int, int]:
    """Return the alarms on real walks, the number of walks, and the exchanges recognised."""
    alarms: Counter[str] = Counter()
    walks = list(real_walks(folder))
    recognised = 0
    for name, walk in progress(walks, "real walks", console=console, transient=True):
        found = all_findings(walk)
        alarms.update(finding.kind.value for finding in found)
        for finding in found:
            console.print(f"{name}: {finding.sentence}")
        other = all_findings(Recording(walk.right, walk.left))
        recognised += any(finding.kind == "swapped" for finding in other)
    return alarms, len(walks), recognised


def main() -> int:
    """Inject, count and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    default = Path(os.environ.get("DUALFOOT_DATA", DATA))
    parser.add_argument("data", nargs="?", type=Path, default=default, help="real walks")
    parser.add_argument("--seeds", type=int, default=2, help="of each route (default: 2)")
    parser.add_argument("--clean", type=int, default=4, help="seeds of each gait (default: 4)")
    arguments = parser.parse_args()
    console, notes = Console(), Console(stderr=True)
    table = Table("fault", "named")
    for name, (named, walks) in inject(arguments.seeds, notes).items():
        table.add_row(name, f"{named} of {walks}")
    alarms, walks = clean(arguments.clean, notes)
    table.add_row("none: simulated walks with an alarm", f"{dict(alarms) or 0} in {walks}")
    if arguments.data.is_dir():
        alarms, walks, recognised = real(arguments.data, notes)
        table.add_row("none: real walks with an alarm", f"{dict(alarms) or 0} in {walks}")
        table.add_row("feet exchanged, real walks", f"{recognised} of {walks}")
    else:
        notes.print(f"no real walks in {arguments.data}: skipped")
    console.print(table)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
