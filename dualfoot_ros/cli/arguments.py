"""Arguments that several verbs share: declared once, and read once."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core import FEET, ConfigError, RecordingError
from ..inspection import require_usable
from ..recording import METADATA, STORAGES, Recording, Topics, find_topics, read_bag
from .printing import print_note, progress
from .table_options import add_intake_arguments, import_in_memory, refuse_intake_options

if TYPE_CHECKING:
    from ..core import TrackerConfig

    Arguments = argparse._ActionsContainer  # noqa: SLF001  (a parser or a group; it has no other name)

BAG = "rosbag2 folder, or a .mcap, .db3 or (ROS 1) .bag file"
MOST_JOBS = 256


def add_bag_argument(parser: Arguments, about: str = BAG) -> None:
    """Add the positional ``BAG``."""
    parser.add_argument("bag", metavar="BAG", help=about)


def add_topic_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--left-topic`` and ``--right-topic`` for bags whose topics have other names."""
    topics = Topics()
    group = parser.add_argument_group("topics")
    for foot in ("left", "right"):
        group.add_argument(
            f"--{foot}-topic",
            metavar="TOPIC",
            help=f"sensor_msgs/Imu topic of the {foot} foot, or two topics ACCELEROMETER,GYRO "
            f"(default: {topics.of(foot).imu}, else the one whose name says {foot})",
        )


def add_usable_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the topics and ``--allow-nan``, which :func:`load_usable` reads."""
    add_topic_arguments(parser)
    parser.add_argument(
        "--allow-nan",
        action="store_true",
        help="leave out samples with nan or inf and count them, instead of refusing the bag",
    )


def add_method_argument(parser: Arguments) -> None:
    """Add ``--method``, which :func:`tracker_config` reads."""
    parser.add_argument("--method", metavar="M", help="method by name (default: that of --config)")


def add_config_arguments(parser: Arguments, remark: str = "") -> None:
    """Add ``--config`` and ``--set``, which :func:`tracker_config` reads."""
    parser.add_argument(
        "--config",
        metavar="YAML",
        help=f"parameter file, or a preset of the package by name{remark}",
    )
    add_set_argument(
        parser, "one tracker parameter by its dotted name; may be repeated, wins over --config"
    )


def add_paper_noise_argument(parser: Arguments) -> None:
    """Add ``--paper-noise`` of the verbs that run presets."""
    parser.add_argument(
        "--paper-noise",
        action="store_true",
        help="give presets of a paper its noise, bias and c0 too, in place of the defaults",
    )


def add_set_argument(parser: Arguments, about: str) -> None:
    """Add ``--set``, which :func:`settings` reads."""
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help=about)


def add_calibration_argument(parser: Arguments) -> None:
    """Add ``--calibration``, whose files :func:`dualfoot_ros.calibration.for_feet` reads."""
    parser.add_argument(
        "--calibration",
        metavar="FILE",
        action="append",
        default=[],
        help="calibration file of 'dualfoot calibrate', or left=FILE, right=FILE; may be repeated",
    )


def add_align_argument(parser: Arguments, about: str) -> None:
    """Add ``--align``."""
    parser.add_argument(
        "--align",
        choices=("first_strides", "umeyama4"),
        default="first_strides",
        help=f"{about} (default: %(default)s)",
    )


def add_jobs_argument(parser: Arguments) -> None:
    """Add ``--jobs``, and ``--scheduler`` in its place."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--jobs", metavar="N", type=int, help="processes (default: one for each core)"
    )
    group.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="run on a cluster of dask.distributed, such as tcp://host:8786; its workers need the "
        "bags under the same paths",
    )


def add_json_argument(parser: Arguments) -> None:
    """Add ``--json``."""
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else")


def add_report_arguments(parser: Arguments) -> None:
    """Add ``-o DIR`` and ``--overwrite`` of the verbs that write a report."""
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder for the files")
    parser.add_argument(
        "--overwrite", action="store_true", help="replace an earlier report in DIR"
    )


def add_no_plots_argument(parser: Arguments, about: str = "write no figures to DIR") -> None:
    """Add ``--no-plots``."""
    parser.add_argument("--no-plots", action="store_true", help=about)


def add_bag_output_argument(parser: Arguments) -> None:
    """Add ``-o BAG`` of the verbs that write a bag."""
    parser.add_argument("-o", "--output", metavar="BAG", type=Path, help="rosbag2 folder to write")


def add_storage_arguments(parser: Arguments) -> None:
    """Add ``--storage`` and ``--overwrite`` of the verbs that write a bag."""
    parser.add_argument(
        "--storage",
        choices=STORAGES,
        default=STORAGES[0],
        help="storage of the bag (default: %(default)s)",
    )
    parser.add_argument("--overwrite", action="store_true", help="replace an existing bag")


def read_topics(path: str, args: argparse.Namespace) -> Topics:
    """Return the topics that ``args`` names, or that the bag ``path`` has; say which were found.

    Raises
    ------
    RecordingError
        When the bag cannot be read, or several topics could be those of a foot.
    """
    choice = find_topics(path, args.left_topic, args.right_topic)
    for sentence in choice.sentences:
        print_note(sentence)
    return choice.topics


def add_recording_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``BAG``, and the options for files of sensors in its place (:func:`load_bag`)."""
    parser.add_argument(
        "bag", metavar="BAG", nargs="?", help=f"{BAG}, or a file that 'import' reads"
    )
    add_intake_arguments(parser)


def recording_name(args: argparse.Namespace) -> str:
    """Return the name of the recording that ``args`` choose: the bag, or its files."""
    return str(args.bag) if args.bag else " and ".join(map(str, _files(args)))


def _files(args: argparse.Namespace) -> list[Path]:
    """Return the files of the feet of a verb that takes them."""
    return [file for foot in FEET if (file := getattr(args, foot, None)) is not None]


def is_bag(args: argparse.Namespace) -> bool:
    """Return whether the recording is a bag, and no file to import.

    Raises
    ------
    RecordingError
        When there is neither a bag nor a file for each foot.
    """
    if args.bag is None and len(_files(args)) != len(FEET):
        missing = [f"--{foot} FILE" for foot in FEET if getattr(args, foot) is None]
        given = f"{missing[0]} is missing" if len(missing) == 1 else "no recording given"
        raise RecordingError(f"{given}; allowed is BAG, or --left FILE --right FILE")
    return args.bag is not None and not _files(args) and not _is_export(Path(args.bag))


def _is_export(path: Path) -> bool:
    """Return whether a file or folder is to be imported; a folder with metadata never is."""
    if (path / METADATA).exists():
        return False
    from ..recording.importers import is_export  # many modules, which few bags need

    return is_export(path)


def load_bag(path: str, args: argparse.Namespace) -> Recording:
    """Read the bag ``path`` with the topics of ``args``, showing progress.

    Of a verb with :func:`add_recording_argument`, files of sensors are imported in memory.
    """
    if hasattr(args, "left"):
        if not is_bag(args):
            return import_in_memory(args.bag, args)
        refuse_intake_options(path, args)
    topics = read_topics(path, args)
    with progress(f"reading {path}") as update:
        return read_bag(path, topics=topics, progress=update)


def load_usable(path: str, args: argparse.Namespace) -> Recording:
    """Read the bag ``path``; raise RecordingError when its samples cannot be evaluated."""
    recording = load_bag(path, args)
    require_usable(recording, allow_not_finite=args.allow_nan)
    return recording


def save_bag(recording: Recording, args: argparse.Namespace) -> None:
    """Write the bag ``args.output``, showing progress."""
    from ..recording import write_bag

    with progress(f"writing {args.output}") as update:
        write_bag(
            args.output,
            recording,
            storage=args.storage,
            overwrite=args.overwrite,
            progress=update,
        )


def tracker_config(args: argparse.Namespace) -> TrackerConfig:
    """Return the configuration of ``--config``, ``--set`` and (where there is one) ``--method``.

    Raises
    ------
    ConfigError
        When a preset, a file or a parameter is not known or out of its range, or the noise of a
        paper is asked for without a preset of one.
    """
    from ..settings import load_config

    overrides = settings(args)
    if getattr(args, "method", None) is not None:
        overrides["method"] = args.method
    paper_noise = getattr(args, "paper_noise", False)
    return load_config(args.config, overrides, paper_noise=paper_noise)


def settings(args: argparse.Namespace) -> dict[str, Any]:
    """Return the parameters of ``--set`` by dotted name.

    Raises
    ------
    ConfigError
        When one is not of the form KEY=VALUE.
    """
    return dict(_setting(text) for text in args.set)


def _setting(text: str) -> tuple[str, Any]:
    """Return name and value of ``KEY=VALUE``, the value as YAML reads it."""
    import yaml

    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise ConfigError(f"--set {text!r} is not understood; allowed is KEY=VALUE")
    try:
        loaded = yaml.safe_load(value)
        return key, float(loaded) if isinstance(loaded, str) else loaded  # YAML 1.1: 1e-3 is text
    except (ValueError, yaml.YAMLError):
        return key, value


def check_counts(args: argparse.Namespace, **most: int) -> None:
    """Refuse counts (``jobs`` and those named) below 1 or above what is allowed."""
    from ..evaluation import EvaluationError

    for name, limit in {"jobs": MOST_JOBS, **most}.items():
        value = getattr(args, name)
        if value is not None and not 1 <= value <= limit:
            raise EvaluationError(f"--{name} is {value}; allowed is 1 to {limit}")
