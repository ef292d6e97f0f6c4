"""Commands as a user runs them: an hour of samples, a cold cache, ``info``."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable
from pathlib import Path

from .figure import Figure
from .usage import ROOT, Usage, usage_of

DUALFOOT = ["-m", "dualfoot_ros"]
DEMO = str(ROOT / "bags" / "demo")
HOUR = ["--route", "track", "--laps", "11", "--rate", "200", "--truth-rate", "1"]
HOUR_EPOCHS = 736_435
EVALUATE_WANTED = "20 CPU s, 600 MB"


def hour_figures(folder: Path, c_us: Callable[[], float]) -> list[Figure]:
    """Return CPU and memory of ``evaluate -o`` and ``info`` on an hour of 2 x 200 Hz.

    The walk goes round a running track with the truth at 1 Hz; it is made if it is not there.
    """
    bag = folder / "hour"
    if not bag.exists():
        usage_of([*DUALFOOT, "simulate", "-o", str(bag), *HOUR])
    figures = []
    with tempfile.TemporaryDirectory(dir=folder) as report:
        evaluate = ["evaluate", str(bag), "-o", f"{report}/report"]
        for name, command, wanted in (
            ("one hour: evaluate -o", evaluate, EVALUATE_WANTED),
            ("one hour: info", ["info", str(bag)], None),
        ):
            used, unit = usage_of([*DUALFOOT, *command]), c_us()
            figures.append(_per_epoch(name, used, unit, wanted))
    return figures


def _per_epoch(name: str, used: Usage, unit_us: float, wanted: str | None) -> Figure:
    ratio = 1e6 * used.cpu_s / HOUR_EPOCHS / unit_us
    measured = f"{used.cpu_s:.1f} CPU s, {used.peak_mb:.0f} MB"
    return Figure(name, ratio, "C an epoch", measured, wanted)


def start_figures(repetitions: int) -> list[Figure]:
    """Return the CPU time of ``info`` on the demo bag, ``--help`` and a cold cache.

    The unit is that of ``import numpy`` in a process of its own, interleaved.
    """
    commands = {
        "start: info bags/demo": ([*DUALFOOT, "info", DEMO], "0.6 CPU s"),
        "start: info --help": ([*DUALFOOT, "info", "--help"], None),
    }
    spent: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
    for command, _ in commands.values():
        usage_of(command)  # the first run compiles the modules
    for _ in range(repetitions):
        for name, (command, _) in commands.items():
            spent[name].append((usage_of(command).cpu_s, _numpy_s()))
    figures = [_in_numpy(name, spent[name], wanted) for name, (_, wanted) in commands.items()]
    with tempfile.TemporaryDirectory() as cache:
        compiler = ["-m", "dualfoot_ros.core.compiler"]
        cold = usage_of(compiler, {"DUALFOOT_CACHE_DIR": cache}).cpu_s, _numpy_s()
        warm = usage_of(compiler, {"DUALFOOT_CACHE_DIR": cache}).cpu_s, _numpy_s()
    return [
        *figures,
        _in_numpy("start: kernel, cold cache", [cold], "a third"),
        _in_numpy("start: kernel, warm cache", [warm], None),
    ]


def _numpy_s() -> float:
    return usage_of(["-c", "import numpy"]).cpu_s


def _in_numpy(name: str, spent: list[tuple[float, float]], wanted: str | None) -> Figure:
    ratio = statistics.median(own / unit for own, unit in spent)
    return Figure(name, ratio, "import numpy", f"{min(own for own, _ in spent):.2f} CPU s", wanted)
