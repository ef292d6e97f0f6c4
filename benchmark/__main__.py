"""Print what the tracker costs: an epoch in all its forms, start-up, memory.

Run it on an otherwise idle machine; where there is none, go by the ratios and the least times.
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from dualfoot_ros.core.constraints import METHODS

from .cases import YARDSTICK, Case, Walk, batch, live, make_walk, yardstick
from .measure import Timing, measure
from .memory import memory
from .startup import start_ups

EXAMPLES = """examples:
  python -m benchmark
  python -m benchmark --quick
  python -m benchmark --methods zupt idc spacing_vector --repetitions 15
  python -m benchmark --json > figures.json
"""


def parse(arguments: list[str] | None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmark",
        description=__doc__,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--methods", nargs="+", default=["zupt", "idc"], choices=tuple(METHODS), metavar="METHOD",
        help=f"methods to time (default: zupt idc; known: {', '.join(METHODS)})",
    )  # fmt: skip
    parser.add_argument(
        "--repetitions", type=positive, default=9, metavar="N", help="of each case (default: 9)"
    )
    parser.add_argument(
        "--rate", type=float, default=200.0, metavar="HZ", help="of the walk (default: 200)"
    )
    parser.add_argument("--quick", action="store_true", help="3 repetitions, no cold start")
    parser.add_argument("--json", action="store_true", help="one JSON object on standard output")
    options = parser.parse_args(arguments)
    if not 60.0 <= options.rate <= 400.0:
        parser.error(f"--rate is {options.rate:g}; allowed is a number in [60, 400] Hz")
    return options


def positive(text: str) -> int:
    """Return a whole number above zero."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{number} is not a whole number above zero")
    return number


def cases(walk: Walk, methods: list[str]) -> list[Case]:
    """Return the yardstick and every form of every method."""
    compiled = [make(walk, method) for method in methods for make in (batch, live)]
    return [yardstick(walk), *compiled, live(walk, methods[0], "interpreted")]


def figures(options: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Measure everything."""
    repetitions = 3 if options.quick else options.repetitions
    walk = make_walk(options.rate, laps=3)
    timed = cases(walk, options.methods)
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task("timing", total=repetitions * len(timed))
        timings = measure(timed, repetitions, options.rate, lambda: progress.advance(task))
        progress.add_task("start-up and memory", total=None)
        started = start_ups(min(3, repetitions), cold=not options.quick)
        held = {method: memory(walk, method) for method in options.methods}
    return {
        "rate_hz": options.rate,
        "epochs": len(walk.pairs),
        "repetitions": repetitions,
        "timings": timings,
        "start_up": started,
        "memory": held,
    }


def timing_table(timings: list[Timing], rate_hz: float) -> Table:
    """Return the table of costs."""
    table = Table(title=f"both feet, 30 states, {rate_hz:g} Hz")
    table.add_column("case")
    for head in ("median us", "least us", "x yardstick", "x real time"):
        table.add_column(head, justify="right")
    for timing in timings:
        name = "dense numpy (the yardstick)" if timing.name == YARDSTICK else timing.name
        table.add_row(
            name,
            f"{timing.median_us:.2f}",
            f"{timing.least_us:.2f}",
            f"{timing.faster_than_yardstick:.1f}",
            f"{timing.times_real_time:.0f}",
        )
    return table


def other_table(found: dict[str, Any]) -> Table:
    """Return the table of start-up and memory."""
    table = Table(title="start-up and memory")
    table.add_column("what")
    table.add_column("", justify="right")
    words = {
        "cold_s": "compiled, cold cache, s",
        "warm_s": "compiled, warm cache, s",
        "live_s": "live, first pair taken, s",
        "cold_over_warm": "cold / warm",
        "live_mib": "live tracker, MiB",
        "batch_peak_mib_per_hour": "batch, peak MiB per hour of samples",
        "result_mib_per_hour": "its result, MiB per hour of samples",
    }
    for name, value in found["start_up"].items():
        table.add_row(words[name], f"{value:.2f}")
    for method, values in found["memory"].items():
        for name, value in values.items():
            table.add_row(f"{method}: {words[name]}", f"{value:.1f}")
    return table


def main(arguments: list[str] | None = None) -> int:
    """Measure and print."""
    options = parse(arguments)
    try:
        found = figures(options, Console(stderr=True))
    except KeyboardInterrupt:
        return 130
    if options.json:
        timings = {t.name: t.to_dict() for t in found["timings"]}
        json.dump({**found, "timings": timings}, sys.stdout)
        sys.stdout.write("\n")
        return 0
    console = Console()
    console.print(timing_table(found["timings"], options.rate))
    console.print(other_table(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
