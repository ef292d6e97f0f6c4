"""Print what the package costs as ratios of one interleaved run.

One C is the CPU time of an epoch of both feet by the same filter in plain C; ``--yardstick`` names
the folder with its source (epoch.c, yardstick.py), which is compiled here.  Commands are beside
``import numpy``, nodes beside an empty node with the same topics, two jobs beside one.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.table import Table

from .c_epoch import CEpoch
from .commands import hour_figures, start_figures
from .epochs import epoch_figures
from .figure import Figure
from .growth import growth_figures
from .many_walks import compare_figures
from .outputs import output_figures

PARTS = ("epochs", "outputs", "hour", "start", "compare", "growth")
MOST_HOURS = 9  # that can be simulated: 100 laps
EXAMPLES = """examples:
  python -m benchmark.performance --yardstick ../yardstick
  python -m benchmark.performance --yardstick ../yardstick --only epochs start
  python -m benchmark.performance --only hour --keep /tmp/hour      the bag is made once
  python -m benchmark.performance --only hour --keep /tmp/hour --hours 1 6
  python -m benchmark.performance --only outputs --walked 30
"""


def parse(arguments: list[str] | None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmark.performance",
        description=__doc__,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--yardstick", type=Path, metavar="DIR", help="folder of epoch.c")
    parser.add_argument("--only", nargs="+", choices=PARTS, default=PARTS, help="parts to run")
    parser.add_argument(
        "--keep", type=Path, metavar="DIR", help="keep the bags of the part hour here"
    )
    parser.add_argument(
        "--hours",
        nargs="+",
        type=int,
        choices=range(1, MOST_HOURS + 1),
        default=[1],
        metavar="N",
        help=f"lengths of the walks of the part hour, up to {MOST_HOURS}: several show how memory "
        "grows (default: 1)",
    )
    parser.add_argument("--repetitions", type=int, default=5, metavar="N", help="default: 5")
    parser.add_argument("--epochs", type=int, default=60_000, metavar="N", help="of the C walk")
    parser.add_argument(
        "--walked",
        type=float,
        default=0.0,
        metavar="MIN",
        help="in real time before the outputs are measured",
    )
    parser.add_argument("--json", action="store_true", help="one JSON object, nothing else")
    return parser.parse_args(arguments)


def figures(options: argparse.Namespace, console: Console) -> list[Figure]:
    """Measure the parts that are asked for; those in C only where the yardstick is there."""
    c: CEpoch | None = None
    if options.yardstick is not None:
        try:
            c = CEpoch(options.yardstick, options.epochs)
        except FileNotFoundError as error:
            console.print(f"no C: {error}; what is measured in C is left out")
    found: list[Figure] = []
    for part, measure in _parts(options, c).items():
        if part in options.only:
            console.print(f"measuring {part}")
            found += measure()
    return found


def _parts(options: argparse.Namespace, c: CEpoch | None) -> dict[str, Callable[[], list[Figure]]]:
    parts: dict[str, Callable[[], list[Figure]]] = {
        "outputs": lambda: output_figures(options.walked),
        "hour": lambda: _hour(options.keep, c, options.hours),
        "start": lambda: start_figures(options.repetitions),
        "compare": compare_figures,
        "growth": growth_figures,
    }
    if c is not None:
        parts = {"epochs": lambda: epoch_figures(c, options.repetitions), **parts}
    return parts


def _hour(keep: Path | None, c: CEpoch | None, hours: list[int]) -> list[Figure]:
    unit = c.us if c is not None else lambda: float("nan")
    if keep is not None:
        keep.mkdir(parents=True, exist_ok=True)
        return hour_figures(keep, unit, hours)
    with tempfile.TemporaryDirectory() as folder:
        return hour_figures(Path(folder), unit, hours)


def table(found: list[Figure]) -> Table:
    """Return the table of the figures."""
    made = Table(title="cost as a ratio")
    for head in ("what", "ratio", "to", "measured", "wanted"):
        made.add_column(head, justify="right" if head == "ratio" else "left")
    for figure in found:
        wanted = "" if figure.wanted is None else str(figure.wanted)
        made.add_row(figure.name, f"{figure.ratio:.2f}", figure.unit, figure.measured, wanted)
    return made


def main(arguments: list[str] | None = None) -> int:
    """Measure and print, with the load of the machine before and after."""
    options = parse(arguments)
    before = os.getloadavg()[0]
    try:
        found = figures(options, Console(stderr=True))
    except KeyboardInterrupt:
        return 130
    after = os.getloadavg()[0]
    if options.json:
        lines = [figure.to_dict() for figure in found]
        print(json.dumps({"load": [before, after], "figures": lines}))
        return 0
    console = Console()
    console.print(table(found))
    console.print(f"load of the machine {before:.1f} before, {after:.1f} after")
    return 0


if __name__ == "__main__":
    sys.exit(main())
