"""Demonstration: a recorded walk through the real nodes, compared with its truth."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

    from ...core import TrackerConfig, Trajectory
    from ...recording import Recording
    from .live_graph import LiveRun

EXAMPLES = """\
examples:
  python -m dualfoot_ros.nodes.demo bags/demo
  python -m dualfoot_ros.nodes.demo bags/demo -o demo_output --methods zupt idc
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the demonstration; return the exit code."""
    with _abrupt_ctrl_c():
        args = _parse_arguments(argv)
        from rich import console, progress  # noqa: F401

        from ... import evaluation, recording  # noqa: F401
        from ...core import DualFootError
        from ...settings import load_config  # noqa: F401
    try:
        return run(args.bag, args.output, args.methods or _choose_methods(), args.config)
    except KeyboardInterrupt:
        return 130
    except (DualFootError, OSError) as error:
        sys.stderr.write(f"demo: error: {error}\n")
        return 2


def run(bag: Path, output: Path, methods: Sequence[str], config: str | None = None) -> int:
    """Replay ``bag`` for each method; print one table and the paths of the plots.

    Raises
    ------
    DualFootError
        When the bag, a method or the configuration cannot be used.
    """
    from rich.console import Console

    from ...evaluation import demo_report, truth_of
    from ...recording import read_bag
    from ...settings import load_config

    console = Console(stderr=True)
    configs = {name: load_config(config, {"method": name}) for name in methods}
    recording = read_bag(bag)
    _check(recording, truth_of(recording) is not None, bag)
    runs = _run_live(bag, configs, console)
    for name, live in runs.items():
        _compare(name, live, recording, configs[name], console)
    tracks: dict[str, Trajectory] = {name: live.trajectory for name, live in runs.items()}
    report = demo_report(tracks, recording, output, title=f"{bag}, live through the nodes")
    Console(width=None if sys.stdout.isatty() else 110).print(report.table())
    for path in report.paths:
        sys.stdout.write(f"{path}\n")
    return 0


def _parse_arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="demo",
        description="Replay a bag through replay, time_sync and fusion; compare with its truth.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("bag", type=Path, help="bag with samples and truth of both feet")
    parser.add_argument(
        "-o", "--output", type=Path, default=Path("demo_output"), help="folder for the plots"
    )
    parser.add_argument("--methods", nargs="+", metavar="M", help="default: zupt and the default")
    parser.add_argument("--config", metavar="YAML", help="preset or parameter file")
    return parser.parse_args(argv)


def _choose_methods() -> list[str]:
    from ...core import TrackerConfig

    return list(dict.fromkeys(["zupt", TrackerConfig().method]))


def _check(recording: Recording, has_truth: bool, bag: Path) -> None:
    from ...core import DualFootError
    from ..entry import ADVICE

    if find_spec("rclpy") is None:
        raise DualFootError(f"rclpy is not installed; {ADVICE}")
    missing = [foot for foot in ("left", "right") if not recording.imu(foot)]
    if missing:
        raise DualFootError(f"bag '{bag}' has no samples of the {' and the '.join(missing)} foot")
    if not has_truth:
        raise DualFootError(f"bag '{bag}' has no truth of both feet to compare with")


def _run_live(
    bag: Path, configs: dict[str, TrackerConfig], console: Console
) -> dict[str, LiveRun]:
    """Run the graph in a context of its own that stays on this machine."""
    from rich.progress import Progress

    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with _abrupt_ctrl_c():
        import rclpy

        from .live_graph import run_live

        context = rclpy.Context()
        rclpy.init(args=["--ros-args", "--log-level", "warn"], context=context)
    try:
        with Progress(console=console, transient=True) as bar, _patient_ctrl_c() as asked:
            console.print(f"replaying {bag} through the nodes: {', '.join(configs)}")
            task = bar.add_task("replay -> time_sync -> fusion", total=1.0)

            def progress(share: float) -> None:
                bar.update(task, completed=share)
                if asked.is_set():
                    raise KeyboardInterrupt

            return run_live(bag, configs, context, progress)
    finally:
        rclpy.try_shutdown(context=context)


@contextmanager
def _abrupt_ctrl_c() -> Iterator[None]:
    """Let Ctrl-C end the process at once, with code 130, while nothing has begun.

    An exception in the middle of an import may come out of it as another one, with a traceback.
    """
    before = signal.signal(signal.SIGINT, lambda *_: os._exit(130))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _patient_ctrl_c() -> Iterator[threading.Event]:
    """Yield an event that Ctrl-C sets: an exception could strike inside rclpy's own code."""
    asked = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: asked.set())
    try:
        yield asked
    finally:
        signal.signal(signal.SIGINT, before)


def _compare(
    name: str, live: LiveRun, recording: Recording, config: TrackerConfig, console: Console
) -> None:
    """Print whether the offline run of the same samples gives the same numbers."""
    from ...core import DualFootError
    from ...evaluation import as_live, track
    from .live_graph import same_bits

    batch = track(recording, as_live(config))
    epochs = len(live.trajectory.left)
    if same_bits(live.trajectory, batch):
        text = f"{epochs} epochs, equal to the offline run to the bit"
    elif live.lost:
        text = f"{epochs} epochs, {live.lost} messages were lost, so it differs from offline"
    else:
        raise DualFootError(f"{name}: live and offline differ although nothing was lost")
    console.print(f"{name}: {text}")


if __name__ == "__main__":
    sys.exit(main())
