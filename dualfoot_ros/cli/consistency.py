"""``dualfoot consistency``: NEES and NIS of the filter over many simulated walks."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import (
    add_config_arguments,
    add_jobs_argument,
    add_json_argument,
    add_method_argument,
    add_report_arguments,
    check_counts,
    tracker_config,
)
from .printing import print_failures, print_json, print_paths, progress, table_console

if TYPE_CHECKING:
    from ..core import TrackerConfig
    from ..evaluation.batch import Failure, Score, WalkJob, WalkScores

HELP = "compare the covariance with the errors over many simulated walks (NEES, NIS)"
EXAMPLES = """\
examples:
  dualfoot consistency                                  50 rectangles, the default configuration
  dualfoot consistency --method idc --set idc.distance_std=0.05
  dualfoot consistency --route track --walks 20 -o report
  dualfoot consistency --errors mirrored --json         sensors that err alike, as mirror images

1 is a consistent filter, more an over-confident one.  The band holds the figure in 95 of 100 cases
if the filter is consistent.  The common heading error of a walk is one draw of the sensor errors.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    add_method_argument(parser)
    add_config_arguments(parser)
    group = parser.add_argument_group("walks")
    group.add_argument("--walks", metavar="N", type=int, default=50, help="default: %(default)s")
    group.add_argument("--seed", metavar="N", type=int, default=0, help="seed of the first walk")
    group.add_argument("--route", metavar="R", default="rectangle", help="default: %(default)s")
    group.add_argument("--rate", metavar="HZ", type=float, default=100.0, help="default: 100")
    group.add_argument("--grade", default="consumer", help="sensors (default: %(default)s)")
    group.add_argument(
        "--errors",
        choices=("independent", "mirrored"),
        default="independent",
        help="relation of the errors of the two feet (default: %(default)s)",
    )
    add_jobs_argument(parser)
    add_report_arguments(parser)
    add_json_argument(parser)


def run(args: argparse.Namespace) -> int:
    """Simulate, track, score, print; return the exit code."""
    from ..evaluation.batch import default_jobs, summarise
    from ..evaluation.reports import check_directory

    check_counts(args, walks=10000)
    if args.output is not None:
        check_directory(args.output, overwrite=args.overwrite)
    config = tracker_config(args)
    walks, failures = _run(_jobs(args, config), args.jobs or default_jobs(), args.scheduler)
    print_failures("consistency", failures)
    if not walks:
        return 2
    _report(args, config, summarise(walks, config), failures)
    return 1 if failures else 0


def _jobs(args: argparse.Namespace, config: TrackerConfig) -> list[WalkJob]:
    from ..evaluation import EvaluationError
    from ..evaluation.batch import WalkJob
    from ..simulation import WalkConfig, grade

    if args.seed < 0:
        raise EvaluationError(f"--seed is {args.seed}; allowed is a whole number from 0")
    walk = WalkConfig.from_mapping({"route": args.route, "rate": args.rate})
    sensor = grade(args.grade, args.errors)
    seeds = range(args.seed, args.seed + args.walks)
    return [WalkJob(seed, walk, sensor, config) for seed in seeds]


def _run(
    jobs: Sequence[WalkJob], processes: int, scheduler: str | None
) -> tuple[list[WalkScores], dict[str, Failure]]:
    from ..evaluation.batch import Failure, Pool, score_walk

    scores: dict[int, WalkScores] = {}
    failures: dict[str, Failure] = {}
    with progress(f"{len(jobs)} walks") as update, Pool(processes, scheduler) as pool:
        for count, done in enumerate(pool.run_each(score_walk, jobs), start=1):
            if isinstance(done.result, Failure):
                failures[f"walk of seed {jobs[done.index].seed}"] = done.result
            else:
                scores[done.index] = done.result
            update(count / len(jobs))
    return [scores[index] for index in sorted(scores)], failures


def _report(
    args: argparse.Namespace,
    config: TrackerConfig,
    scores: Sequence[Score],
    failures: Mapping[str, Failure],
) -> None:
    document = {
        "method": config.method,
        "walks": _describe_walks(args, len(failures)),
        "scores": [asdict(score) for score in scores],
        "failed": {name: failure.sentence for name, failure in failures.items()},
        "parameters": config.to_mapping(),
    }
    title = (
        f"{config.method}: {args.walks - len(failures)} walks, route {args.route}, {args.grade} "
        f"sensors, {args.errors} errors"
    )
    paths = [] if args.output is None else _write(args.output, document, scores, title)
    if args.json:
        print_json({**document, "files": [str(path) for path in paths]})
        return
    _print(scores, title)
    print_paths(paths)


def _describe_walks(args: argparse.Namespace, failed: int) -> dict[str, Any]:
    return {
        "route": args.route,
        "walks": args.walks - failed,
        "seeds": [args.seed, args.seed + args.walks - 1],
        "rate_hz": args.rate,
        "grade": args.grade,
        "errors": args.errors,
    }


def _write(
    folder: Path, document: dict[str, Any], scores: Sequence[Score], title: str
) -> list[Path]:
    from ..evaluation import plain
    from ..evaluation.reports import report_folder, write_json
    from ..evaluation.reports.plots import draw_consistency

    with report_folder(folder) as scratch:
        figures = write_json(scratch / "consistency.json", plain(document))
        paths = [figures, draw_consistency(scores, scratch / "consistency.png", title)]
    return [folder / path.name for path in paths]


def _print(scores: Sequence[Score], title: str) -> None:
    from rich.table import Table

    from ..evaluation.reports import number

    table = Table(title=title, title_justify="left")
    table.add_column("quantity")
    names = ("", "dim.", "mean", "95 % band", "inside (%)", "RMS error", "std claimed")
    for name in names:
        table.add_column(name, justify="right")
    for score in scores:
        limits = f"{score.band[0]:.2f} - {score.band[1]:.2f}"
        inside = None if score.inside is None else 100.0 * score.inside
        table.add_row(
            score.name,
            score.kind,
            str(score.dimensions),
            number(score.mean),
            limits,
            number(inside, 0),
            number(score.error, 4),
            number(score.std, 4),
        )
    console = table_console()
    console.print(table)
    console.print("m, m/s, rad, along one axis; mean: of NEES or NIS over its dimensions")
