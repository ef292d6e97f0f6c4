"""What faults cost: lost samples, holes, one foot alone, clocks that are set, floors that move.

    python -m benchmark.faults [--seeds 8] [--only rides] [--rate 60]

Each fault is put into simulated walks (100 Hz, or ``--rate``), or into streams that go through the
streaming aligner in the order of their arrival.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmark.rides import ride_rows
from dualfoot_ros.core import DualFootError, FloatArray, ImuSeries, Trajectory
from dualfoot_ros.core.results.events import FEET
from dualfoot_ros.evaluation import RunOptions, run, track
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import Simulation, WalkConfig, simulate
from dualfoot_ros.timing import Aligner, align_with_report

STEP_NS = 10_000_000
SECOND = 1_000_000_000
STAND = 800  # samples at the start that every walk keeps
JUMPS_S = {"-1 h": -3600, "-1 s": -1, "+1 s": 1, "+30 d": 30 * 86_400, "+10 y": 3650 * 86_400}
Damage = Callable[[ImuSeries, np.random.Generator], ImuSeries]


def recording(walk: Simulation, left: Damage, right: Damage, seed: int) -> Recording:
    """Return a walk with the damage done to each foot."""
    rngs = [np.random.default_rng([seed, k]) for k in range(len(FEET))]
    return Recording(
        left(walk.left, rngs[0]), right(walk.right, rngs[1]), walk.left_truth, walk.right_truth
    )


def whole(series: ImuSeries, _: np.random.Generator) -> ImuSeries:
    """Return the series as it is."""
    return series


def lossy(series: ImuSeries, rng: np.random.Generator) -> ImuSeries:
    """Return the series without 5 % of its samples, taken at random."""
    keep = rng.random(len(series)) >= 0.05
    keep[:STAND] = True
    return series[keep]


def hole(start_s: float, length_s: float) -> Damage:
    """Return the damage that takes the samples of a stretch away."""

    def damage(series: ImuSeries, _: np.random.Generator) -> ImuSeries:
        since_s = (series.stamp_ns - series.stamp_ns[0]) * 1e-9
        return series[(since_s < start_s) | (since_s >= start_s + length_s)]

    return damage


def middle(trajectory: Trajectory, since_s: float) -> FloatArray:
    """Return the place (3,) m between the feet at a time after the start of the track."""
    at_ns = trajectory.left.stamp_ns[0] + round(since_s * 1e9)
    k = int(np.argmin(np.abs(trajectory.left.stamp_ns - at_ns)))
    place: FloatArray = 0.5 * (trajectory.left.position[k] + trajectory.right.position[k])
    return place


def shift(walk: Simulation, left: Damage, right: Damage, seed: int, at_s: float) -> float:
    """Return how far a fault has moved the track at a time, m."""
    tracks = [track(recording(walk, *d, seed)) for d in ((whole, whole), (left, right))]
    start_s = 1e-9 * float(tracks[0].left.stamp_ns[0] - walk.left.stamp_ns[0])
    places = [middle(each, at_s - start_s) for each in tracks]
    return float(np.linalg.norm(places[1] - places[0]))


def rmse(walk: Simulation, damage: Damage, seed: int) -> float:
    """Return the RMSE of the mid-point of the feet, m."""
    options = RunOptions(check_feet=False)
    report = run(recording(walk, damage, damage, seed), options=options).truth_report
    return float("nan") if report is None else report.midpoint.rmse_m


def track_rows(walks: list[Simulation]) -> Iterator[tuple[str, str]]:
    """Yield what faults cost a track."""
    pairs = np.array([[rmse(w, d, k) for d in (whole, lossy)] for k, w in enumerate(walks)])
    ratio = np.median(pairs[:, 1]) / np.median(pairs[:, 0])
    yield "5 % of the samples lost at random", f"RMSE x {ratio:.2f} (median)"
    for walk_part, start_s in (("before a corner", 15.0), ("in a corner", 20.0)):
        away = hole(start_s, 5.0)
        sides = ((away, whole), (whole, away))
        moved = [shift(w, *side, k, start_s + 15.0) for k, w in enumerate(walks) for side in sides]
        figures = f"{np.median(moved):.2f} m (median), {max(moved):.2f} m (worst)"
        yield f"one foot silent for 5 s {walk_part}, 10 s later", f"track moved by {figures}"
    for what, feet, (start_s, length_s), after_s in (
        ("a hole of 0.1 s of both feet", (hole(20.3, 0.1), hole(20.3, 0.1)), (20.3, 0.1), 8.0),
        ("a hole of 0.3 s of both feet", (hole(20.3, 0.3), hole(20.3, 0.3)), (20.3, 0.3), 8.0),
    ):
        at_s = start_s + length_s + after_s
        try:
            moved = [shift(w, *feet, k, at_s) for k, w in enumerate(walks)]
        except DualFootError as error:
            yield what, str(error)
            continue
        figures = f"{np.median(moved):.2f} m (median), {max(moved):.2f} m (worst)"
        yield f"{what}, {after_s:g} s later", f"track moved by {figures}"
    left, _, report = align_with_report(walks[0].left, hole(15.0, 1e6)(walks[0].right, None))
    share = len(left) / len(walks[0].left)
    missing = report.counters["right_missing"] / len(left)
    yield (
        "right foot ends at 15 s",
        f"{share:.1%} of the left foot's samples are used " + (f"({missing:.0%} of them alone)"),
    )


def longest_without(jumps_s: dict[str, float], feet: tuple[str, ...]) -> float:
    """Return the longest time without a pair of ``feet``, s, when clocks are set at 10 s."""
    aligner, values, last, longest = Aligner(), np.ones(6), 0, 0
    for k in range(2000):
        for foot in FEET:
            shift_ns = round(jumps_s.get(foot, 0.0)) * SECOND if k >= 1000 else 0
            pairs = aligner.push(foot, 10**18 + k * STEP_NS + shift_ns, values)
            there = pairs[-1].present if pairs else (False, False)
            if all(there[FEET.index(f)] for f in feet):
                last = k
        longest = max(longest, k - last)
    return longest * STEP_NS * 1e-9


def clock_rows() -> Iterator[tuple[str, str]]:
    """Yield how long clocks that are set cost pairs."""
    for name, jump_s in JUMPS_S.items():
        both = longest_without(dict.fromkeys(FEET, jump_s), FEET)
        one = [longest_without({foot: jump_s}, FEET) for foot in FEET]
        yield f"both clocks set by {name}", f"{both:.2f} s without a pair"
        yield f"one clock set by {name}", f"{max(one):.2f} s without a pair of both feet"


def silence_rows() -> Iterator[tuple[str, str]]:
    """Yield how the living foot goes on while the other is silent."""
    aligner, values, waits, alone = Aligner(), np.ones(6), 0, 0
    for k in range(2000):
        found = aligner.push("left", k * STEP_NS, values)
        if k < 1000 or k >= 1500:
            found += aligner.push("right", k * STEP_NS, values)
        waits = max(waits, k - (found[-1].stamp_ns // STEP_NS) if found else waits + 1)
        alone += sum(pair.present == (True, False) for pair in found)
    late_s = waits * STEP_NS * 1e-9
    figures = f"{alone} pairs of the living foot in 500 samples, {late_s:.2f} s late once"
    yield "one foot silent for 5 s", figures


def main() -> None:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--only", choices=("clocks", "silence", "tracks", "rides"))
    parser.add_argument("--rate", type=float, default=100.0, metavar="HZ", help="of the tracks")
    arguments = parser.parse_args()
    config = WalkConfig(rate=arguments.rate)
    walks = [simulate(config, seed=seed) for seed in range(arguments.seeds)]
    table = Table(title=f"{len(walks)} walks")
    for column in ("fault", "measured"):
        table.add_column(column)
    parts: dict[str, Iterator[tuple[str, str]]] = {
        "clocks": clock_rows(),
        "silence": silence_rows(),
        "tracks": track_rows(walks),
        "rides": ride_rows(arguments.seeds),
    }
    for part, rows in parts.items():
        for row in rows if arguments.only in (None, part) else ():
            table.add_row(*row)
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
