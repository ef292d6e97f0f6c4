"""``dualfoot compare``: every method on every bag, one table."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import add_usable_arguments, check_numbers, complain, setting
from .progress import progress

if TYPE_CHECKING:
    from ..evaluation.batch import Case, Entry, Failure, Job

HELP = "run every method on one or many bags and put their figures side by side"
EXAMPLES = """\
examples:
  dualfoot compare walk                                   every method, one table
  dualfoot compare walks/* --methods zupt,idc,liu2023     methods and presets, median over bags
  dualfoot compare walk -o report                         also compare.json, compare.csv, figures
  dualfoot compare walk --methods idc --sweep kappa=0.4:0.7:0.05 --sweep gamma=6000,8000,10000
  dualfoot compare rectangles/* --repeat 4                four rounds each, and the 68th stride
  dualfoot compare walks/* --csv                          one row a bag and method
  dualfoot compare board --methods zupt,rigid_pair        two sensors on one shoe

A sweep runs the chosen methods that have the parameter: kappa, distance, spacing ... or any by its
dotted name; gamma is stance.threshold, of zero velocity and of the moments alike.
Exit code 1: some bags or methods gave no figures, and are named; 2: none did.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("bag", metavar="BAG", nargs="+", help="rosbag2 folder (or its one file)")
    parser.add_argument(
        "--methods",
        metavar="LIST",
        default="all",
        help="methods and presets, separated by commas (default: all methods but rigid_pair)",
    )
    parser.add_argument(
        "--config", metavar="YAML", help="parameters of the methods (file or preset)"
    )
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="one parameter of all by its dotted name; may be repeated, wins over --config",
    )
    parser.add_argument(
        "--sweep",
        metavar="NAME=A:B:STEP",
        action="append",
        default=[],
        help="also run with values of a parameter, or NAME=A,B,C; may be repeated",
    )
    parser.add_argument(
        "--repeat",
        metavar="N",
        type=int,
        default=1,
        help="walk every recording N times in a row, as Ma and Särkkä 2023 (default: 1)",
    )
    parser.add_argument(
        "--align",
        choices=("first_strides", "umeyama4"),
        default="first_strides",
        help="how to fix the frame to truth or markers (default: %(default)s)",
    )
    parser.add_argument(
        "--jobs", metavar="N", type=int, help="processes (default: one for each core)"
    )
    _add_output(parser)
    add_usable_arguments(parser)


def _add_output(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("output")
    group.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder for the files")
    group.add_argument("--no-plots", action="store_true", help="write no figures to DIR")
    kind = group.add_mutually_exclusive_group()
    kind.add_argument("--json", action="store_true", help="print one JSON object, nothing else")
    kind.add_argument("--csv", action="store_true", help="print CSV, nothing else")


def run(args: argparse.Namespace) -> int:
    """Compare, write, print; return the exit code."""
    from ..evaluation.batch import default_jobs
    from ..evaluation.reports import check_directory, flat

    check_numbers(args, repeat=20)
    if args.output is not None:
        check_directory(args.output)
    jobs = _jobs(args, _cases(args))
    found, failed = _run(jobs, args.jobs or default_jobs())
    complain(failed)
    if not found:
        return 2
    rows = [flat(entry) for entry in found]
    paths = [] if args.output is None else _write(args, found, rows, failed)
    _print(args, found, rows, failed, paths)
    return 1 if failed else 0


def _cases(args: argparse.Namespace) -> list[Case]:
    from ..evaluation.batch import Sweep, case_names, make_cases

    overrides = dict(setting(text) for text in args.set)
    sweeps = [Sweep.parse(text) for text in args.sweep]
    return make_cases(case_names(args.methods), args.config, overrides, sweeps)


def _jobs(args: argparse.Namespace, cases: Sequence[Case]) -> list[Job]:
    from ..evaluation import Align, Options
    from ..evaluation.batch import Job

    bags = list(dict.fromkeys(str(Path(bag)) for bag in args.bag))
    options = Options(Align(args.align))
    rest = args.repeat, args.left_topic, args.right_topic, args.allow_nan
    return [Job(bag, case, options, *rest) for bag in bags for case in cases]


def _run(jobs: Sequence[Job], processes: int) -> tuple[list[Entry], dict[str, Failure]]:
    """Return what came of the jobs, in their order, and what failed by bag and case."""
    from ..evaluation.batch import Failure, compare_one, run_each

    found: dict[int, Entry] = {}
    failed: dict[int, Failure] = {}
    with progress(f"{len(jobs)} runs") as update:
        for count, done in enumerate(run_each(compare_one, jobs, processes), start=1):
            if isinstance(done.result, Failure):
                failed[done.index] = done.result
            else:
                found[done.index] = done.result
            update(count / len(jobs))
    named = _named(jobs, failed)
    return [found[index] for index in sorted(found)], named


def _named(jobs: Sequence[Job], failed: dict[int, Failure]) -> dict[str, Failure]:
    """Return the failures by what failed: a bag once, where every method failed alike."""
    named = {}
    for bag in dict.fromkeys(job.bag for job in jobs):
        own = [index for index, job in enumerate(jobs) if job.bag == bag]
        why = {failed[index].sentence for index in own if index in failed}
        if len(why) == 1 and all(index in failed for index in own):
            named[bag] = failed[own[0]]
        else:
            named |= {
                f"{bag}, {jobs[index].case.label}": failed[index]
                for index in own
                if index in failed
            }
    return named


def _document(found: Sequence[Entry], failed: dict[str, Failure]) -> dict[str, Any]:
    return {
        "runs": [entry.to_dict() for entry in found],
        "failed": {name: failure.sentence for name, failure in failed.items()},
    }


def _write(
    args: argparse.Namespace,
    found: Sequence[Entry],
    rows: list[dict[str, Any]],
    failed: dict[str, Failure],
) -> list[Path]:
    from ..evaluation.reports import csv_text, staged

    with staged(args.output) as folder:
        paths = [folder / "compare.json", folder / "compare.csv"]
        text = json.dumps(_document(found, failed), indent=2, allow_nan=False)
        paths[0].write_text(text + "\n", encoding="utf-8")
        paths[1].write_text(csv_text(rows), encoding="utf-8")
        if not args.no_plots:
            paths += _draw(found, rows, folder)
    return [args.output / path.name for path in paths]


def _draw(found: Sequence[Entry], rows: list[dict[str, Any]], folder: Path) -> list[Path]:
    from ..evaluation.reports.plots import draw_compared, draw_sweep

    paths = []
    bags = list(dict.fromkeys(entry.bag for entry in found))
    for index, bag in enumerate(bags):
        own = [entry for entry in found if entry.bag == bag and entry.case.swept is None]
        name = Path(bag).name
        taken = any(Path(other).name == name for other in bags[:index])
        path = folder / f"tracks_{name}{f'_{index}' if taken else ''}.png"
        if own:
            paths.append(draw_compared(own, path, name))
    for name in dict.fromkeys(row["swept"] for row in rows if row["swept"] is not None):
        paths.append(draw_sweep(rows, name, folder / f"sweep_{name.replace('.', '_')}.png"))
    return paths


def _print(
    args: argparse.Namespace,
    found: Sequence[Entry],
    rows: list[dict[str, Any]],
    failed: dict[str, Failure],
    paths: list[Path],
) -> None:
    if args.json:
        files = [str(path) for path in paths]
        print(json.dumps({**_document(found, failed), "files": files}, allow_nan=False))
        return
    if args.csv:
        from ..evaluation.reports import csv_text

        print(csv_text(rows), end="")
        return
    from rich.console import Console

    from ..evaluation.reports import tables

    console = Console(highlight=False)
    if not console.is_terminal:
        console.width = 160
    for table in tables(rows):
        console.print(table)
    for path in paths:
        print(path)
