"""Write the recordings in ``bags/`` again, bit for bit the same samples (see bags/README.md)."""

from __future__ import annotations

import sys
from pathlib import Path

from dualfoot_ros.cli.main import main

BAGS = {
    "demo": "--route figure_eight --laps 2 --stops 3 --rate 100 --seed 3 --grade consumer "
    "--errors independent --truth-rate 25 --set right_clock.phase=0.4 --set gait.coning=0",
}


def make(folder: Path) -> int:
    """Write every bag into ``folder``; return the exit code of the first that fails, or 0."""
    for name, options in BAGS.items():
        code = main(["simulate", "-o", str(folder / name), "--overwrite", *options.split()])
        if code != 0:
            return code
    return 0


if __name__ == "__main__":
    sys.exit(make(Path(__file__).resolve().parents[1] / "bags"))
