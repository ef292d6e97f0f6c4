"""Arguments that several verbs share, and what is done with them."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ..core import ConfigError
from ..inspection import require_usable
from ..recording import Recording, Topics, read_bag
from .progress import progress

if TYPE_CHECKING:
    from ..evaluation.batch import Failure


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


def setting(text: str) -> tuple[str, Any]:
    """Return name and value of ``KEY=VALUE``, the value as YAML reads it.

    Raises
    ------
    ConfigError
        When it is not of that form.
    """
    import yaml

    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise ConfigError(f"--set {text!r} is not understood; allowed is KEY=VALUE")
    try:
        loaded = yaml.safe_load(value)
        return key, float(loaded) if isinstance(loaded, str) else loaded  # YAML 1.1: 1e-3 is text
    except (ValueError, yaml.YAMLError):
        return key, value


def check_numbers(args: argparse.Namespace, **most: int) -> None:
    """Refuse numbers (``jobs`` and those named) below 1 or above what is allowed."""
    from ..evaluation import EvaluationError

    for name, limit in {"jobs": 256, **most}.items():
        value = getattr(args, name)
        if value is not None and not 1 <= value <= limit:
            raise EvaluationError(f"--{name} is {value}; allowed is 1 to {limit}")


def complain(failed: dict[str, Failure], verb: str = "compare") -> None:
    """Name on standard error what failed, and why."""
    for name, failure in failed.items():
        print(f"dualfoot {verb}: error: {name}: {failure.sentence}", file=sys.stderr)
