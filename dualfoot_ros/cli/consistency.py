"""``dualfoot consistency``: whether the covariance can be believed, over many simulated walks."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import check_numbers, complain, setting
from .progress import progress

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

1 is honest, above promises too much.  In brackets: where the figure lies in 95 of 100 cases if the
filter is consistent.  The headings' common error is drawn by each walk's sensors once and for all.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("--method", metavar="M", help="method by name (default: that of --config)")
    parser.add_argument("--config", metavar="YAML", help="parameter file or preset")
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="one parameter by its dotted name; may be repeated, wins over --config",
    )
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
        help="how the errors of the two feet go together (default: %(default)s)",
    )
    parser.add_argument("--jobs", metavar="N", type=int, help="processes (default: one a core)")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder for the files")
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else")


def run(args: argparse.Namespace) -> int:
    """Simulate, track, score, print; return the exit code."""
    from ..evaluation.batch import default_jobs, summarise
    from ..evaluation.reports import check_directory
    from ..settings import load_config

    check_numbers(args, walks=10000)
    if args.output is not None:
        check_directory(args.output)
    overrides = dict(setting(text) for text in args.set)
    if args.method is not None:
        overrides["method"] = args.method
    config = load_config(args.config, overrides)
    walks, failed = _run(_jobs(args, config), args.jobs or default_jobs())
    complain(failed, "consistency")
    if not walks:
        return 2
    scores = summarise(walks, config)
    _report(args, config, scores, failed)
    return 1 if failed else 0


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


def _run(jobs: Sequence[WalkJob], processes: int) -> tuple[list[WalkScores], dict[str, Failure]]:
    from ..evaluation.batch import Failure, run_each, score_walk

    found: dict[int, WalkScores] = {}
    failed: dict[str, Failure] = {}
    with progress(f"{len(jobs)} walks") as update:
        for count, done in enumerate(run_each(score_walk, jobs, processes), start=1):
            if isinstance(done.result, Failure):
                failed[f"walk of seed {jobs[done.index].seed}"] = done.result
            else:
                found[done.index] = done.result
            update(count / len(jobs))
    return [found[index] for index in sorted(found)], failed


def _report(
    args: argparse.Namespace,
    config: TrackerConfig,
    scores: Sequence[Score],
    failed: dict[str, Failure],
) -> None:
    from ..evaluation import plain

    walks = {
        "route": args.route,
        "walks": args.walks - len(failed),
        "seeds": [args.seed, args.seed + args.walks - 1],
        "rate_hz": args.rate,
        "grade": args.grade,
        "errors": args.errors,
    }
    document = plain(
        {
            "method": config.method,
            "walks": walks,
            "scores": [asdict(score) for score in scores],
            "failed": {name: failure.sentence for name, failure in failed.items()},
            "parameters": config.to_mapping(),
        }
    )
    title = (
        f"{config.method}: {walks['walks']} walks, route {args.route}, {args.grade} sensors, "
        f"{args.errors} errors"
    )
    paths = [] if args.output is None else _write(args.output, document, scores, title)
    if args.json:
        print(json.dumps({**document, "files": [str(p) for p in paths]}, allow_nan=False))
        return
    _print(scores, title)
    for path in paths:
        print(path)


def _write(
    folder: Path, document: dict[str, Any], scores: Sequence[Score], title: str
) -> list[Path]:
    from ..evaluation.reports import staged
    from ..evaluation.reports.plots import draw_consistency

    with staged(folder) as scratch:
        figures = scratch / "consistency.json"
        figures.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
        paths = [figures, draw_consistency(scores, scratch / "consistency.png", title)]
    return [folder / path.name for path in paths]


def _print(scores: Sequence[Score], title: str) -> None:
    from rich.console import Console
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
    console = Console(highlight=False)
    if not console.is_terminal:
        console.width = 120
    console.print(table)
    console.print("m, m/s, rad, along one axis; mean: of NEES or NIS over its dimensions")
