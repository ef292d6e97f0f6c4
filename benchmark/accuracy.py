"""The distribution of errors over real walks: the tables of docs/explanation/accuracy.md.

    python benchmark/accuracy.py [DATA] [-o CURVES.png]

DATA is the folder of the dual-feet data set; without it nothing is done.  Parameters were chosen
on rectangles ccw 1 to 8 and cw, the figures of eight and the lap ccw_1; rectangles ccw 9 to 15 and
the lap cw_1 only checked.

Three parts: every method, the default with one change of 0.2 taken back, and every method with a
cure for the heading on top.  The cures use gyro matrices from the five figures of eight (which
they then do not check), with the accelerometers calibrated by the six attitudes of the data set.
``-o`` draws the cumulative curves of the first and the last part.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from dualfoot_ros.calibration import (
    SensorCalibration,
    calibrate_walks,
    fit_accelerometer,
    load_sources,
    segments_of,
)
from dualfoot_ros.core import FloatArray, TrackerConfig
from dualfoot_ros.evaluation import Evaluation, run
from dualfoot_ros.evaluation.reports.plots.style import legend_above, new_figure, save
from dualfoot_ros.recording import Recording
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
# What a user can add: matrices from figures of eight, and aids.
CURES = {
    "with matrix": {},
    "with matrix and straight_lines": {"aids.straight_lines": True},
    "with matrix and magnetic_heading": {"aids.magnetic_heading": True},
}
SENSORS = {"left": "B", "right": "A"}  # first letter of the files in DATA/calibration
QUANTILES = (0.1, 0.25, 0.5, 0.75, 0.9, 1.0)
COLUMNS = ("marker RMSE (m)", "closure (%)", "height (m)", "crossed (%)")
Walks = Mapping[str, list[Recording]]
Sensors = Mapping[str, SensorCalibration]


@dataclass
class Curves:
    """The figures (N, 4) of all walks, by what was done and by method."""

    found: dict[str, dict[str, FloatArray]] = field(default_factory=dict)

    def draw(self, path: Path) -> Path:
        """Draw the share of walks up to each marker error and each closing error."""
        figure, axes = new_figure(9.0, 2.3 * len(self.found), len(self.found), 2, sharex="col")
        for row, (title, methods) in zip(axes, self.found.items(), strict=True):
            for column, axis in enumerate(row):
                for name, figures in methods.items():
                    values = np.sort(figures[np.isfinite(figures[:, column]), column])
                    share = 100.0 * np.arange(1, len(values) + 1) / len(values)
                    axis.step(values, share, where="post", label=name)
                axis.set_ylim(0.0, 102.0)
            row[0].set_ylabel("share of walks (%)")
            row[1].set_title(title, fontsize=9, loc="right")
        for axis, name in zip(axes[-1], COLUMNS, strict=False):
            axis.set_xlabel(name)
            axis.set_xlim(left=0.0)
        legend_above(axes[0, 0])
        return save(figure, path)


def main() -> int:
    """Run every walk with every method, change and cure; print the tables, draw the curves."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("data", type=Path, nargs="?", default=Path("../shared/data/dual_feet"))
    parser.add_argument("-o", "--output", type=Path, help="picture of the cumulative curves")
    args = parser.parse_args()
    data: Path = args.data
    if not data.is_dir():
        sys.stdout.write(f"no data in '{data}', nothing to do\n")
        return 0
    walks = {group: [read(path) for path in files_of(data, *at)] for group, at in GROUPS.items()}
    curves = Curves()
    every_method("", walks, curves, {})
    for name, changes in WITHOUT.items():
        config = TrackerConfig.from_mapping({"method": "spacing_vector", **changes})
        table(f"spacing_vector, {name}", walks, config)
    sensors = matrices(walks["figures of eight (chose)"], accelerometers(data / "calibration"))
    corrected = {group: [each.corrected(sensors) for each in walks[group]] for group in walks}
    for cure, aid in CURES.items():
        every_method(cure, corrected, curves, aid)
    if args.output is not None:
        sys.stdout.write(f"{curves.draw(args.output)}\n")
    return 0


def every_method(title: str, walks: Walks, curves: Curves, aid: Mapping[str, object]) -> None:
    """Print the tables of all methods and keep their figures for the curves."""
    kept = curves.found[title or "nothing set, nothing calibrated"] = {}
    for method in METHODS:
        config = TrackerConfig.from_mapping({"method": method, **aid})
        kept[method] = table(f"method {method} {title}".rstrip(), walks, config)


def files_of(data: Path, where: str, numbers: range) -> Iterator[Path]:
    """Yield the files of a group whose last number is in ``numbers``."""
    folder, _, pattern = where.partition("/")
    for path in sorted((data / folder).glob(f"{pattern}*.mat")):
        if int(path.stem.rpartition("_")[2]) in numbers:
            yield path


def read(path: Path) -> Recording:
    """Return the recording of a file."""
    return import_recording(ImportOptions(sources=(path,)))


def accelerometers(folder: Path) -> Sensors:
    """Return the accelerometer calibration of both sensors, from six attitudes each."""
    return {foot: accelerometer(folder, letter) for foot, letter in SENSORS.items()}


def accelerometer(folder: Path, letter: str) -> SensorCalibration:
    """Return the accelerometer calibration from the files whose names begin with ``letter``."""
    [named] = load_sources(sorted(folder.glob(f"{letter}*.csv"))).values()
    segments = [segment for name, series in named for segment in segments_of(series, name)]
    return SensorCalibration(accelerometer=fit_accelerometer(segments).triad())


def matrices(eights: list[Recording], given: Sensors) -> Sensors:
    """Return ``given`` with the gyro matrices that the figures of eight tell."""
    named = [(f"eight {k}", each) for k, each in enumerate(eights, start=1)]
    return calibrate_walks(named, None, dict(given)).sensors(dict(given))


def table(title: str, walks: Walks, config: TrackerConfig) -> FloatArray:
    """Print median and worst of each group and the cumulative curve; return all figures (N, 4)."""
    out = sys.stdout.write
    out(f"\n{title}\n\n| walks | n | {' | '.join(COLUMNS)} |\n")
    out("|---|---|---|---|---|---|\n")
    every: list[FloatArray] = []
    for group, recordings in walks.items():
        found = np.array([figures(run(each, config)) for each in recordings])
        every.append(found)
        cells = [f"{np.nanmedian(c):.3g} / {np.nanmax(c):.3g}" for c in found.T if has(c)]
        if not has(found[:, 0]):
            cells.insert(0, "")
        out(f"| {group} | {len(recordings)} | {' | '.join(cells)} |\n")
    whole = np.vstack(every)
    for name, column in zip(COLUMNS[:2], whole.T, strict=False):
        curve = np.nanquantile(column, QUANTILES)
        steps = ", ".join(f"{q:.0%} {v:.3g}" for q, v in zip(QUANTILES, curve, strict=True))
        out(f"\ncumulative {name}: {steps}\n")
    sys.stdout.flush()
    return whole


def has(column: np.ndarray) -> bool:
    """Return whether any walk has the figure."""
    return bool(np.isfinite(column).any())


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
