"""Gyro matrices from ordinary walks, and what they gain on other walks (docs, calibration).

    python benchmark/walk_calibration.py DATA [ACCELEROMETERS.yaml]

DATA is the folder of the dual-feet data set, ACCELEROMETERS.yaml a calibration file of both
accelerometers (see docs/how_to/calibrate.md).  Without DATA nothing is done.  The matrices are
fitted to the five figures of eight, and to fourteen rectangles; the laps are another person's.  No
parameter was chosen on the clockwise lap or on the rectangles 9 to 15.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from dualfoot_ros.calibration import WalkCalibration, calibrate_walks, for_feet, median_of
from dualfoot_ros.calibration.walk.known_points import WalkErrors, walk_errors
from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording import Correction, Recording
from dualfoot_ros.recording.importers import ImportOptions, import_recording

FOLDERS = ("figure_eight", "rectangle_ccw", "rectangle_cw", "running_track")
METHODS = ("zupt", "spacing_vector")
EXTRAS: Mapping[str, Mapping[str, object]] = {
    "": {},
    "straight_lines": {"aids.straight_lines": True},
    "magnetic_heading": {"aids.magnetic_heading": True},
}
# The rectangles end where they began, turned by a quarter to the right or to the left.
TURNED = {"rectangle_ccw": -1.0, "rectangle_cw": 1.0}
APART_M = 0.15  # of the standing feet, assumed at both ends
Walks = dict[str, Recording]


def main() -> int:
    """Fit, evaluate, print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path, nargs="?", default=Path("../shared/data/dual_feet"))
    parser.add_argument("accelerometers", nargs="*")
    args = parser.parse_args()
    if not args.data.is_dir():
        print(f"no data in '{args.data}', nothing to do")
        return 0
    walks = {name: read(args.data / name) for name in FOLDERS}
    given = for_feet(args.accelerometers)
    report("no matrix", walks, given)
    print_ends("no matrix", walks, given)
    rectangles = {**walks["rectangle_ccw"], **walks["rectangle_cw"]}
    chosen = {name: each for name, each in rectangles.items() if not name.endswith(LEFT_OUT)}
    for what, some in (("figures of eight", walks["figure_eight"]), ("rectangles", chosen)):
        begin = time.process_time()
        fitted = calibrate_walks(list(some.items()), None, given)
        print(f"\nmatrix from {len(some)} {what}, {time.process_time() - begin:.1f} s of CPU")
        print_matrices(fitted)
        report(f"from {what}", walks, fitted.sensors(given))
        print_ends(f"from {what}", walks, fitted.sensors(given))
    return 0


LEFT_OUT = tuple(f"_ccw_{k}" for k in range(9, 16))


def read(folder: Path) -> Walks:
    """Return the recordings of a folder by name."""
    paths = sorted(folder.glob("*.mat"))
    return {path.stem: import_recording(ImportOptions(sources=(path,))) for path in paths}


def print_matrices(fitted: WalkCalibration) -> None:
    """Print the elements of both feet in percent."""
    for name, foot in fitted.feet.items():
        pairs = zip(foot.fit.elements, foot.elements_std, strict=True)
        print(f"  {name:<6}" + "  ".join(f"{100 * v:+.2f} +- {100 * s:.2f}" for v, s in pairs))


def report(title: str, walks: Mapping[str, Walks], sensors: Mapping[str, Correction]) -> None:
    """Print the errors of every folder for each method and aid."""
    for method in METHODS:
        for aid, extra in EXTRAS.items():
            config = TrackerConfig.from_mapping({"method": method, **extra})
            folders = ["running_track"] if aid else list(FOLDERS)
            found = {
                name: [walk_errors(each, config, sensors) for each in walks[name].values()]
                for name in folders
            }
            words = "; ".join(f"{name} {summary(found[name])}" for name in folders)
            print(f"{title}, {method} {aid}: {words}", flush=True)


def print_ends(title: str, walks: Mapping[str, Walks], sensors: Mapping[str, Correction]) -> None:
    """Print by how much each foot, and the point between them, misses where it should end.

    The right foot ends on the marker that it began on, the left one beside it.  Only this shows
    what a constraint does to the foot that no marker measures.
    """
    for method in METHODS:
        config = TrackerConfig(method=method)
        for folder, side in TURNED.items():
            recordings = [each.corrected(sensors) for each in walks[folder].values()]
            found = [ends(each, config, side) for each in recordings]
            left, right, between = np.median(found, axis=0)
            print(
                f"{title}, {method}: {folder} ends off by {left:.3f} m (left), {right:.3f} m "
                f"(right), {between:.3f} m (between)",
                flush=True,
            )


def ends(recording: Recording, config: TrackerConfig, side: float) -> list[float]:
    """Return the misses (m) of the left foot, of the right one and of the point between them."""
    tracked = track(recording, config)
    left, right = (foot.position[-1] - foot.position[0] for foot in (tracked.left, tracked.right))
    left = left - APART_M * np.array([-side, -1.0, 0.0])  # from beside it to beside it, turned
    return [float(np.hypot(*miss[:2])) for miss in (left, right, 0.5 * (left + right))]


def summary(errors: Iterable[WalkErrors]) -> str:
    """Return closing error, marker error and height of a folder in words."""
    errors = list(errors)
    closings = [each.closure_percent for each in errors]
    if len(errors) == len(METHODS):  # the two laps, each by itself
        words = " / ".join("-" if c is None else f"{c:.2f}" for c in closings) + " %"
    else:
        words = f"closes {median_of(closings):.2f} %"
    markers = median_of([each.marker_rmse_m for each in errors])
    heights = [abs(each.height_m) for each in errors if each.height_m is not None]
    words += "" if markers is None else f", markers {markers:.3f} m"
    return f"{words}, height {median_of(heights):.2f} m"


if __name__ == "__main__":
    sys.exit(main())
