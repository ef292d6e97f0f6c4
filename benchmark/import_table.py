"""What an import of an hour costs: ``python -m benchmark.import_table``.

Writes two made-up tables (an hour at 200 Hz, a foot each), imports them as the command does, in a
process of its own, and prints its CPU time and the most memory it held.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from dualfoot_ros.core import FEET, STANDARD_GRAVITY

BOUND_S, BOUND_MB = 10.0, 500.0  # of an hour at 200 Hz
STEP_HZ = 0.9  # of the made-up walk
CHILD = """
import json, resource, sys
from dualfoot_ros.cli.main import main
code = main(sys.argv[1:])
used = resource.getrusage(resource.RUSAGE_SELF)
cost = {"code": code, "cpu_s": used.ru_utime + used.ru_stime, "mb": used.ru_maxrss / 1024}
print(json.dumps(cost), file=sys.stderr)
"""


def write_table(path: Path, seconds: float, rate_hz: float, seed: int) -> None:
    """Write a foot that stands for 10 s and then walks: time in s, g, deg/s."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(seconds * rate_hz)) / rate_hz
    swing = np.maximum(0.0, np.sin(2.0 * np.pi * STEP_HZ * time)) * (time > 10.0)
    cells = rng.normal(0.0, 0.002, (len(time), 6))
    cells[:, 2] += 1.0
    cells[:, 0] += 12.0 / STANDARD_GRAVITY * swing
    cells[:, 4] += 400.0 * swing
    names = "Time (s),Acc X (g),Acc Y (g),Acc Z (g),Gyr X (deg/s),Gyr Y (deg/s),Gyr Z (deg/s)"
    table = np.column_stack([time, cells])
    np.savetxt(path, table, fmt="%.6f", delimiter=",", header=names, comments="")


def measure(folder: Path, seconds: float, rate_hz: float) -> dict[str, float]:
    """Return CPU seconds and megabytes of an import."""
    arguments = ["import", "-o", str(folder / "walk")]
    for seed, foot in enumerate(FEET):
        write_table(folder / f"{foot}.csv", seconds, rate_hz, seed)
        arguments += [f"--{foot}", str(folder / f"{foot}.csv")]
    done = subprocess.run(
        [sys.executable, "-c", CHILD, *arguments], capture_output=True, text=True, check=True
    )
    cost: dict[str, float] = json.loads(done.stderr.splitlines()[-1])
    return cost


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.import_table", description=__doc__)
    parser.add_argument("--hours", type=float, default=1.0, help="length (default: 1)")
    parser.add_argument("--rate", type=float, default=200.0, help="Hz (default: 200)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cost = measure(Path(folder), 3600.0 * options.hours, options.rate)
    print(f"import of {options.hours:g} h at {options.rate:g} Hz, both feet:")
    print(f"  CPU    {cost['cpu_s']:6.1f} s   (bound for 1 h at 200 Hz: {BOUND_S:g} s)")
    print(f"  memory {cost['mb']:6.0f} MB  (bound: {BOUND_MB:g} MB)")


if __name__ == "__main__":
    main()
