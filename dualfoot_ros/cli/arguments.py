"""The arguments by which every verb takes a bag, and the reading of it."""

from __future__ import annotations

import argparse
from dataclasses import replace

from ..inspection.findings import require_usable
from ..recording import Recording, Topics, read_bag
from .progress import progress


def add_topic_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--left-topic`` and ``--right-topic`` for bags whose topics have other names."""
    topics = Topics()
    group = parser.add_argument_group("topics")
    for foot in ("left", "right"):
        group.add_argument(
            f"--{foot}-topic",
            metavar="TOPIC",
            default=topics.of(foot).imu,
            help=f"sensor_msgs/Imu topic of the {foot} foot (default: %(default)s)",
        )


def add_usable_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what :func:`load_usable` needs."""
    add_topic_arguments(parser)
    parser.add_argument(
        "--allow-nan",
        action="store_true",
        help="leave out samples with nan or inf and count them, instead of refusing the bag",
    )


def load_usable(path: str, args: argparse.Namespace) -> Recording:
    """Read the bag ``path``; raise RecordingError when its samples cannot be evaluated."""
    recording = load_bag(path, args)
    require_usable(recording, allow_not_finite=args.allow_nan)
    return recording


def load_bag(path: str, args: argparse.Namespace) -> Recording:
    """Read the bag ``path`` with the topics of ``args``, showing progress."""
    default = Topics()
    topics = Topics(
        left=replace(default.left, imu=args.left_topic),
        right=replace(default.right, imu=args.right_topic),
    )
    with progress(f"reading {path}") as update:
        return read_bag(path, topics=topics, progress=update)
