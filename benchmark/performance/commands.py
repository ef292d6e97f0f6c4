"""Commands as a user runs them: hours of samples, a cold cache, ``info``."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from .figure import Figure
from .usage import ROOT, Usage, usage_of

DUALFOOT = ["-m", "dualfoot_ros"]
DEMO = str(ROOT / "bags" / "demo")
ROUTE = ["--route", "track", "--rate", "200", "--truth-rate", "1"]
HOUR_LAPS = 11
HOUR_EPOCHS = 736_435
HOUR_SAMPLES_MB = HOUR_EPOCHS * 2 * 7 * 8 / 1e6  # a stamp and six numbers of each foot
EVALUATE_WANTED = "20 CPU s, 600 MB"


def hour_figures(
    folder: Path, c_us: Callable[[], float], hours: Sequence[int] = (1,)
) -> list[Figure]:
    """Return CPU and memory of ``evaluate -o`` and ``info`` on so many ``hours`` of 2 x 200 Hz.

    The walk goes round a running track with the truth at 1 Hz; it is made if it is not there
    (for which the simulator needs half a gigabyte an hour).  Where there are walks of several
    lengths, the memory that an hour more takes is compared with that of its samples.
    """
    figures = []
    peaks: dict[str, list[float]] = {"evaluate -o": [], "info": []}
    for each in hours:
        bag = _walk(folder, each)
        with tempfile.TemporaryDirectory(dir=folder) as report:
            commands = {
                "evaluate -o": ["evaluate", str(bag), "-o", f"{report}/report"],
                "info": ["info", str(bag)],
            }
            for name, command in commands.items():
                used, unit = usage_of([*DUALFOOT, *command]), c_us()
                wanted = EVALUATE_WANTED if (name, each) == ("evaluate -o", 1) else None
                figures.append(_per_epoch(f"{_named(each)}: {name}", used, unit * each, wanted))
                peaks[name].append(used.peak_mb)
    if len(hours) > 1:
        figures += [_growth(name, hours, each) for name, each in peaks.items()]
    return figures


def _walk(folder: Path, hours: int) -> Path:
    """Return the bag of a walk of so many hours; it is made if it is not there."""
    bag = folder / ("hour" if hours == 1 else f"hours_{hours}")
    if not bag.exists():
        laps = ["--laps", str(HOUR_LAPS * hours)]
        usage_of([*DUALFOOT, "simulate", "-o", str(bag), *ROUTE, *laps])
    return bag


def _named(hours: int) -> str:
    return "one hour" if hours == 1 else f"{hours} hours"


def _per_epoch(name: str, used: Usage, unit_us: float, wanted: str | None) -> Figure:
    """Return a figure over that of ``HOUR_EPOCHS`` of ``unit_us`` us."""
    ratio = 1e6 * used.cpu_s / HOUR_EPOCHS / unit_us
    measured = f"{used.cpu_s:.1f} CPU s, {used.peak_mb:.0f} MB"
    return Figure(name, ratio, "C an epoch", measured, wanted)


def _growth(name: str, hours: Sequence[int], peaks_mb: Sequence[float]) -> Figure:
    """Return by how much the peak grows in an hour, over what its samples take."""
    measured_mb = sorted(zip(hours, peaks_mb, strict=True))
    (short, least), (long, most) = measured_mb[0], measured_mb[-1]
    grown = (most - least) / (long - short)
    measured = f"{grown:.0f} MB an hour from {short} to {long} hours"
    return Figure(f"memory of {name}", grown / HOUR_SAMPLES_MB, "samples", measured, 1.0)


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
