"""``dualfoot sync``: bring the two feet of a bag on one clock."""

from __future__ import annotations

import argparse
import json
import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import add_topic_arguments, load_bag
from .progress import progress

if TYPE_CHECKING:
    from ..recording import Recording
    from ..timing import Synchronised

HELP = "find the offset between the clocks of the two feet, and write a bag without it"
EXAMPLES = """\
examples:
  dualfoot sync walk                        offset, skew and confidence; nothing is written
  dualfoot sync walk -o aligned             also the bag with the stamps of both feet on one clock
  dualfoot sync walk --method motion        by the gait, whatever the arrival times say
  dualfoot sync walk --method shake         by a shake of both devices held together
  dualfoot sync walk --json                 one JSON object on standard output

methods:
  arrival  log times against stamps, each foot: its clock on the host's (live recordings)
  shake    a time at which both devices were held together and turned to and fro
  motion   the gait: one foot swings while the other one stands (good to about 10 ms)
  auto     arrival where the log times tell something, else shake, else motion

By shake and motion the right foot goes on the left foot's clock, by arrival both go on the
host's.  Ground truth in the bag keeps its stamps.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("bag", metavar="BAG", help="rosbag2 folder (or its one file)")
    parser.add_argument("-o", "--output", metavar="OUT", type=Path, help="rosbag2 folder to write")
    parser.add_argument(
        "--method",
        choices=("auto", "motion", "shake", "arrival"),
        default="auto",
        help="what to go by (default: %(default)s)",
    )
    parser.add_argument(
        "--storage",
        choices=("mcap", "sqlite3"),
        default="mcap",
        help="storage of the bag (default: %(default)s)",
    )
    parser.add_argument("--overwrite", action="store_true", help="replace an existing bag")
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else")
    add_topic_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Find the offset, write the bag, say what was found; return the exit code."""
    from ..recording import METADATA, check_target

    if args.output is not None:
        check_target(args.output, overwrite=args.overwrite, marker=METADATA)
    recording = load_bag(args.bag, args)
    found = _synchronise(recording, args)
    if args.output is not None:
        _write(recording, found, args)
    _print(found, args)
    return 0


def _synchronise(recording: Recording, args: argparse.Namespace) -> Synchronised:
    from ..recording import read_arrivals
    from ..timing import TimingError, synchronise

    left, right = recording.left, recording.right
    if left is None or right is None:
        foot = "left" if left is None else "right"
        topic = getattr(args, f"{foot}_topic")
        raise TimingError(
            f"the bag has no samples of the {foot} foot (topic '{topic}'), and both are needed; "
            f"'dualfoot info' lists its topics, --{foot}-topic names another one"
        )
    arrivals = {}
    if args.method in ("auto", "arrival"):
        arrivals = read_arrivals(args.bag, recording.topics)
    return synchronise(left, right, arrivals, args.method)


def _write(recording: Recording, found: Synchronised, args: argparse.Namespace) -> None:
    from ..recording import write_bag

    notes = {
        **recording.notes,
        "sync": f"{found.method}: right {found.offset_s:+.6f} s, {found.skew_ppm:+.2f} ppm, "
        f"confidence {found.confidence:.2f}",
    }
    aligned = replace(recording, left=found.left, right=found.right, notes=notes)
    with progress(f"writing {args.output}") as update:
        write_bag(
            args.output,
            aligned,
            storage=args.storage,
            overwrite=args.overwrite,
            progress=update,
        )


def _print(found: Synchronised, args: argparse.Namespace) -> None:
    if args.json:
        print(json.dumps(_values(found, args), allow_nan=False))
        return
    from rich.console import Console

    console = Console(highlight=False, soft_wrap=True)
    skew = f"{found.skew_ppm:+.1f} ppm" if found.skew_known else "not told (recording too short)"
    console.print(f"method      {found.method}")
    console.print(f"offset      {found.offset_s:+.6f} s, to add to the right foot's stamps")
    console.print(f"uncertainty {1e3 * found.std_s:.1f} ms (one sigma)")
    console.print(f"skew        {skew}, the right foot's clock against the left foot's")
    console.print(f"confidence  {found.confidence:.2f}")
    for note in found.notes:
        console.print(f"note: {note}")
    if args.output is not None:
        console.print(str(args.output))


def _values(found: Synchronised, args: argparse.Namespace) -> dict[str, Any]:
    return {
        "bag": args.bag,
        "method": found.method,
        "offset_s": found.offset_s,
        "std_s": found.std_s,
        "skew_ppm": found.skew_ppm if found.skew_known else None,
        "confidence": found.confidence,
        "applied": {
            foot: {
                "offset_ns": offset.offset_ns,
                "at_ns": offset.center_ns,
                "skew_ppm": offset.skew_ppm,
                "detail": {k: _finite(v) for k, v in offset.detail.items()},
            }
            for foot, offset in found.applied.items()
        },
        "notes": list(found.notes),
        "output": None if args.output is None else str(args.output),
    }


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
