"""``dualfoot sync``: bring the two feet of a bag on one clock."""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from .arguments import (
    add_bag_output_argument,
    add_json_argument,
    add_recording_argument,
    add_storage_arguments,
    add_topic_arguments,
    is_bag,
    load_bag,
    recording_name,
    save_bag,
)
from .printing import print_json, table_console

if TYPE_CHECKING:
    from ..recording import Recording
    from ..timing import Synchronised

HELP = "find the offset between the clocks of the two feet, and write a bag without it"
EXAMPLES = """\
examples:
  dualfoot sync walk                        offset, skew and confidence; nothing is written
  dualfoot sync walk -o aligned             also the bag with the stamps of both feet on one clock
  dualfoot sync walk --method motion        by the gait, whatever the arrival times are
  dualfoot sync walk --method shake         by a shake of both devices held together
  dualfoot sync walk --json                 one JSON object on standard output

methods:
  arrival  log times against stamps, each foot: its clock on the host's (live recordings)
  shake    a time at which both devices were held together and turned to and fro
  motion   the gait: one foot swings while the other one stands (good to about 10 ms)
  auto     arrival where the log times are of use, else shake, else motion

By shake and motion the right foot goes on the left foot's clock, by arrival both go on the
host's.  Ground truth in the bag keeps its stamps.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    add_recording_argument(parser)
    add_bag_output_argument(parser)
    parser.add_argument(
        "--method",
        choices=("auto", "motion", "shake", "arrival"),
        default="auto",
        help="source of the offset (default: %(default)s)",
    )
    add_storage_arguments(parser)
    add_json_argument(parser)
    add_topic_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Find the offset, write the bag, print the result; return the exit code."""
    from ..recording import METADATA, check_target

    if args.output is not None:
        check_target(args.output, overwrite=args.overwrite, marker=METADATA)
    recording = load_bag(args.bag, args)
    result = _synchronise(recording, args)
    if args.output is not None:
        _write(recording, result, args)
    _print(result, args)
    return 0


def _synchronise(recording: Recording, args: argparse.Namespace) -> Synchronised:
    from ..recording import read_arrivals
    from ..timing import TimingError, synchronise

    left, right = recording.left, recording.right
    if left is None or right is None:
        foot = "left" if left is None else "right"
        topic = recording.topics.of(foot).samples
        raise TimingError(
            f"the bag has no samples of the {foot} foot (topic '{topic}'), and both are needed; "
            f"'dualfoot info' lists its topics, --{foot}-topic names another one"
        )
    arrivals = {}
    if args.method in ("auto", "arrival") and is_bag(args):
        arrivals = read_arrivals(args.bag, recording.topics)
    return synchronise(left, right, arrivals, args.method)


def _write(recording: Recording, result: Synchronised, args: argparse.Namespace) -> None:
    notes = {
        **recording.notes,
        "sync": f"{result.method}: right {result.offset_s:+.6f} s, {result.skew_ppm:+.2f} ppm, "
        f"confidence {result.confidence:.2f}",
    }
    save_bag(replace(recording, left=result.left, right=result.right, notes=notes), args)


def _print(result: Synchronised, args: argparse.Namespace) -> None:
    if args.json:
        print_json(_document(result, args))
        return
    skew = f"{result.skew_ppm:+.1f} ppm" if result.skew_known else "unknown (recording too short)"
    console = table_console()
    lines = [
        f"method      {result.method}",
        f"offset      {result.offset_s:+.6f} s, to add to the right foot's stamps",
        f"uncertainty {1e3 * result.std_s:.1f} ms (one sigma)",
        f"skew        {skew}, the right foot's clock against the left foot's",
        f"confidence  {result.confidence:.2f}",
        *(f"note: {note}" for note in result.notes),
        *([] if args.output is None else [str(args.output)]),
    ]
    for line in lines:
        console.print(line, soft_wrap=True)


def _document(result: Synchronised, args: argparse.Namespace) -> dict[str, Any]:
    return {
        "bag": recording_name(args),
        "method": result.method,
        "offset_s": result.offset_s,
        "std_s": result.std_s,
        "skew_ppm": result.skew_ppm if result.skew_known else None,
        "confidence": result.confidence,
        "applied": {
            foot: {
                "offset_ns": offset.offset_ns,
                "at_ns": offset.center_ns,
                "skew_ppm": offset.skew_ppm,
                "detail": dict(offset.detail),
            }
            for foot, offset in result.applied.items()
        },
        "notes": list(result.notes),
        "output": None if args.output is None else str(args.output),
    }
