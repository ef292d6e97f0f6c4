"""The distribution of errors over real walks: the tables of docs/explanation/accuracy.md.

    python benchmark/accuracy.py [DATA]

DATA is the folder of the dual-feet data set; without it nothing is done.  Parameters were chosen
on rectangles ccw 1 to 8 and cw, the figures of eight and the lap ccw_1; rectangles ccw 9 to 15 and
the lap cw_1 only checked.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.evaluation import Evaluation, run
from dualfoot_ros.recording.importers import ImportOptions, import_recording

GROUPS = {
    "rectangles ccw 1-8 (chose)": ("rectangle_ccw", range(1, 9)),
    "rectangles ccw 9-15 (checked)": ("rectangle_ccw", range(9, 16)),
    "rectangles cw (chose)": ("rectangle_cw", range(1, 100)),
    "figures of eight (chose)": ("figure_eight", range(1, 100)),
    "lap ccw_1 (chose)": ("running_track/*ccw", range(1, 2)),
    "lap cw_1 (checked)": ("running_track/*_cw", range(1, 2)),
}
METHODS = ("zupt", "idc", "spacing_vector")
# What was changed in 0.2: without each, the others in place.
WITHOUT = {
    "as it is": {},
    "zupt.heading_correction full": {"zupt.heading_correction": "full"},
    "increments averaged": {"increments.left": "averaged", "increments.right": "averaged"},
    "height_std 0": {"spacing_vector.height_std": 0.0},
    "detector fixed": {"stance.detector": "fixed"},
    "last_stand off": {"alignment.last_stand": False},
}
QUANTILES = (0.1, 0.25, 0.5, 0.75, 0.9, 1.0)


def main() -> int:
    """Run every walk with every method and every cure left out; print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path, nargs="?", default=Path("../shared/data/dual_feet"))
    data: Path = parser.parse_args().data
    if not data.is_dir():
        sys.stdout.write(f"no data in '{data}', nothing to do\n")
        return 0
    walks = {group: list(files_of(data, *where)) for group, where in GROUPS.items()}
    for method in METHODS:
        table(f"method {method}", walks, TrackerConfig(method=method))
    for name, changes in WITHOUT.items():
        config = TrackerConfig.from_mapping({"method": "spacing_vector", **changes})
        table(f"spacing_vector, {name}", walks, config)
    return 0


def files_of(data: Path, where: str, numbers: range) -> Iterator[Path]:
    """Yield the files of a group whose last number is in ``numbers``."""
    folder, _, pattern = where.partition("/")
    for path in sorted((data / folder).glob(f"{pattern}*.mat")):
        if int(path.stem.rpartition("_")[2]) in numbers:
            yield path


def table(title: str, walks: dict[str, list[Path]], config: TrackerConfig) -> None:
    """Print one line a group: median and worst of each figure; and the cumulative curve."""
    out = sys.stdout.write
    out(f"\n{title}\n\n| walks | n | marker RMSE (m) | closure (%) | height (m) | crossed (%) |\n")
    out("|---|---|---|---|---|---|\n")
    every: list[np.ndarray] = []
    for group, paths in walks.items():
        found = np.array([figures(evaluate(path, config)) for path in paths])
        every.append(found)
        cells = [f"{np.nanmedian(c):.3g} / {np.nanmax(c):.3g}" for c in found.T if has(c)]
        if not has(found[:, 0]):
            cells.insert(0, "")
        out(f"| {group} | {len(paths)} | {' | '.join(cells)} |\n")
    whole = np.vstack(every)
    for name, column in (("marker RMSE (m)", whole[:, 0]), ("closure (%)", whole[:, 1])):
        curve = np.nanquantile(column, QUANTILES)
        steps = ", ".join(f"{q:.0%} {v:.3g}" for q, v in zip(QUANTILES, curve, strict=True))
        out(f"\ncumulative {name}: {steps}\n")


def has(column: np.ndarray) -> bool:
    """Return whether any walk has the figure."""
    return bool(np.isfinite(column).any())


def evaluate(path: Path, config: TrackerConfig) -> Evaluation:
    """Return the evaluation of one walk."""
    return run(import_recording(ImportOptions(sources=(path,))), config)


def figures(result: Evaluation) -> tuple[float, float, float, float]:
    """Return marker RMSE (m), closure of the mean (%), height of the mean (m), crossed (%)."""
    markers = [each.rmse_m for each in result.marker_report.values()]
    tracks = (result.trajectory.left, result.trajectory.right)
    ends = np.mean([track.position[-1] - track.position[0] for track in tracks], axis=0)
    way = np.mean([track.distance_m for track in tracks])
    closure = 100.0 * float(np.linalg.norm(ends[:2])) / way
    crossed = result.feet.crossed_percent or 0.0
    return (markers[0] if markers else np.nan, closure, abs(float(ends[2])), crossed)


if __name__ == "__main__":
    sys.exit(main())
