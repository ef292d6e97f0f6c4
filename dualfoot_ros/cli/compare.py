"""``dualfoot compare``: every method on every bag, one table."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import (
    BAG,
    add_align_argument,
    add_calibration_argument,
    add_config_arguments,
    add_jobs_argument,
    add_json_argument,
    add_no_plots_argument,
    add_paper_noise_argument,
    add_report_arguments,
    add_usable_arguments,
    check_counts,
    settings,
)
from .printing import print_failures, print_json, print_paths, progress, table_console

if TYPE_CHECKING:
    from ..evaluation.batch import Case, Entry, Failure, Job, Pool

CLUSTER_PROCESSES = 8  # for which the runs on one bag are divided, on a cluster of any size
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
    parser.add_argument("bag", metavar="BAG", nargs="+", help=BAG)
    parser.add_argument(
        "--methods",
        metavar="LIST",
        default="all",
        help="methods and presets, separated by commas (default: all methods but rigid_pair)",
    )
    add_config_arguments(parser, ", of all methods")
    add_paper_noise_argument(parser)
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
    add_calibration_argument(parser)
    add_align_argument(parser, "how to fix the frame to truth or markers")
    add_jobs_argument(parser)
    _add_output(parser)
    add_usable_arguments(parser)


def _add_output(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("output")
    add_report_arguments(group)
    add_no_plots_argument(group)
    kind = group.add_mutually_exclusive_group()
    add_json_argument(kind)
    kind.add_argument("--csv", action="store_true", help="print CSV, nothing else")


def run(args: argparse.Namespace) -> int:
    """Compare, write, print; return the exit code."""
    from ..evaluation.batch import Pool, by_bag, default_jobs
    from ..evaluation.reports import check_directory, flat

    check_counts(args, repeat=20)
    if args.output is not None:
        check_directory(args.output, overwrite=args.overwrite)
    jobs, processes = _jobs(args, _cases(args)), args.jobs or default_jobs()
    groups = by_bag(jobs, processes if args.scheduler is None else CLUSTER_PROCESSES)
    with Pool(processes, args.scheduler) as pool:
        entries, failures = _run(jobs, groups, pool)
        print_failures("compare", failures)
        if not entries:
            return 2
        rows = [flat(entry) for entry in entries]
        document = _document(entries, failures)
        paths = [] if args.output is None else _write(args, entries, rows, document, pool)
    _print(args, rows, document, paths, _notes(entries))
    return 1 if failures else 0


def _notes(entries: Sequence[Entry]) -> list[str]:
    """Return the sentences on configurations and bags, each with the cases or the bag."""
    from ..evaluation import config_notes

    of_bags = [f"{entry.bag}: warning: {each}" for entry in entries for each in entry.warnings]
    cases: dict[str, list[str]] = {}
    for case in {entry.case.label: entry.case for entry in entries}.values():
        for note in config_notes(case.config):
            cases.setdefault(note, []).append(case.label)
    of_cases = [f"{', '.join(labels)}: {note}" for note, labels in cases.items()]
    return [*of_cases, *dict.fromkeys(of_bags)]


def _cases(args: argparse.Namespace) -> list[Case]:
    from ..evaluation.batch import Sweep, case_names, make_cases

    sweeps = [Sweep.parse(text) for text in args.sweep]
    names = case_names(args.methods)
    return make_cases(names, args.config, settings(args), sweeps, paper_noise=args.paper_noise)


def _jobs(args: argparse.Namespace, cases: Sequence[Case]) -> list[Job]:
    from ..calibration import for_feet
    from ..evaluation import Align, Options
    from ..evaluation.batch import Job

    bags = list(dict.fromkeys(str(Path(bag)) for bag in args.bag))
    options = Options(Align(args.align))
    rest = (
        args.repeat,
        args.left_topic,
        args.right_topic,
        args.allow_nan,
        for_feet(args.calibration),
        "" if args.scheduler is None else str(Path.cwd()),
    )
    return [Job(bag, case, options, *rest) for bag in bags for case in cases]


def _run(
    jobs: Sequence[Job], groups: Sequence[Sequence[tuple[int, Job]]], pool: Pool
) -> tuple[list[Entry], dict[str, Failure]]:
    """Return the entries in the order of their jobs, and the failures by bag and case."""
    from ..evaluation.batch import Failure, compare_one

    entries: dict[int, Entry] = {}
    failures: dict[int, Failure] = {}
    with progress(f"{len(jobs)} runs") as update:
        for count, done in enumerate(pool.run_groups(compare_one, groups), start=1):
            if isinstance(done.result, Failure):
                failures[done.index] = done.result
            else:
                entries[done.index] = done.result
            update(count / len(jobs))
    return [entries[index] for index in sorted(entries)], _name_failures(jobs, failures)


def _name_failures(jobs: Sequence[Job], failures: Mapping[int, Failure]) -> dict[str, Failure]:
    """Return the failures by bag and case; a bag once, where every case failed alike."""
    named: dict[str, Failure] = {}
    for bag in dict.fromkeys(job.bag for job in jobs):
        own = [index for index, job in enumerate(jobs) if job.bag == bag]
        failed = [index for index in own if index in failures]
        alike = len({failures[index].sentence for index in failed}) == 1
        if alike and len(failed) == len(own):
            named[bag] = failures[own[0]]
        else:
            named |= {f"{bag}, {jobs[index].case.label}": failures[index] for index in failed}
    return named


def _document(entries: Sequence[Entry], failures: Mapping[str, Failure]) -> dict[str, Any]:
    return {
        "runs": [entry.to_dict() for entry in entries],
        "failed": {name: failure.sentence for name, failure in failures.items()},
    }


def _write(
    args: argparse.Namespace,
    entries: Sequence[Entry],
    rows: list[dict[str, Any]],
    document: dict[str, Any],
    pool: Pool,
) -> list[Path]:
    from ..evaluation.reports import csv_text, report_folder, write_json
    from ..evaluation.reports.html import write_comparison_page

    with report_folder(args.output) as folder:
        paths = [write_json(folder / "compare.json", document), folder / "compare.csv"]
        paths[1].write_text(csv_text(rows), encoding="utf-8")
        if not args.no_plots:
            paths += _draw(entries, rows, folder, pool)
            paths.append(write_comparison_page(folder, entries, rows, document["failed"]))
    return [args.output / path.name for path in paths]


def _draw(
    entries: Sequence[Entry], rows: list[dict[str, Any]], folder: Path, pool: Pool
) -> list[Path]:
    """Draw a figure a bag, which takes as long as some runs on it, and one a swept parameter."""
    from ..evaluation.reports.plots import draw_compared, draw_sweep

    figures = []
    bags = list(dict.fromkeys(entry.bag for entry in entries))
    for index, bag in enumerate(bags):
        own = [entry for entry in entries if entry.bag == bag and entry.case.swept is None]
        name = Path(bag).name
        taken = any(Path(other).name == name for other in bags[:index])
        path = folder / f"tracks_{name}{f'_{index}' if taken else ''}.png"
        if own:
            figures.append((own, path, name))
    paths = pool.run_all(draw_compared, figures)
    swept = dict.fromkeys(row["swept"] for row in rows if row["swept"] is not None)
    return paths + [
        draw_sweep(rows, name, folder / f"sweep_{name.replace('.', '_')}.png") for name in swept
    ]


def _print(
    args: argparse.Namespace,
    rows: list[dict[str, Any]],
    document: dict[str, Any],
    paths: list[Path],
    notes: Sequence[str],
) -> None:
    from ..evaluation.reports import csv_text, tables

    if args.json:
        print_json({**document, "files": [str(path) for path in paths]})
        return
    if args.csv:
        print(csv_text(rows), end="")
        return
    console = table_console(160)
    for table in tables(rows):
        console.print(table)
    for note in notes:
        console.print(note)
    print_paths(paths)
