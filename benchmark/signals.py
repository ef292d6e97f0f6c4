"""Ends every executable by a signal at random moments: start-up, running, shutting down.

    python benchmark/signals.py [--count 50] [--seed 0]

Each moment is drawn from the first seconds of a process; one in four processes gets a second
signal a moment later, while it shuts down.  Wanted: the exit code that the documentation says, no
traceback, nothing left that runs.  What Python does before the first line of the package runs is
out of reach, so moments are also told by whether that line had run.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).resolve().parents[1]
BAG = ROOT / "bags" / "demo"
NODES = ("fusion", "time_sync", "imu_adapter", "bringup", "replay")
LATEST_S = 6.0  # after the start of the process, of which the imports take a part
PATIENCE_S = 60.0
BEGUN = "begun"
SCRIPT = """
import sys
from dualfoot_ros.{module} import {name} as main
print({begun!r}, flush=True)
sys.exit(main())
"""


@dataclass(frozen=True)
class Outcome:
    """How a process ended that got a signal."""

    name: str
    number: signal.Signals
    at_s: float
    twice: bool
    code: int | None
    begun: bool
    traceback: bool
    left: int
    took_s: float

    @property
    def wanted(self) -> int:
        """The documented exit code."""
        if self.name != "dualfoot":
            return 0
        return 130 if self.number is signal.SIGINT else -signal.SIGTERM

    @property
    def good(self) -> bool:
        """Whether it ended as documented."""
        return self.code == self.wanted and not self.traceback and not self.left


def command(name: str) -> list[str]:
    """Return the command line of an executable, as its console script starts it."""
    module, call = ("cli.main", "main") if name == "dualfoot" else ("nodes.entry", name)
    arguments = {
        "replay": ["--ros-args", "-p", f"bag:={BAG}"],
        "bringup": ["--ros-args", "-p", f"bag:={BAG}"],
        "dualfoot": ["compare", str(BAG), "--methods", "all"],
    }.get(name, [])
    script = SCRIPT.format(module=module, name=call, begun=BEGUN)
    return [sys.executable, "-c", script, *arguments]


def strike(name: str, number: signal.Signals, at_s: float, *, twice: bool) -> Outcome:
    """Start an executable, send it a signal after a while, and see how it ends."""
    with tempfile.TemporaryDirectory() as cache, tempfile.TemporaryFile("w+") as said:
        environment = {**os.environ, "DUALFOOT_CACHE_DIR": cache, "PYTHONPATH": str(ROOT)}
        process = subprocess.Popen(
            command(name), stdout=said, stderr=said, env=environment, start_new_session=True
        )
        time.sleep(at_s)
        since_s = time.monotonic()
        _send(process.pid, number)
        if twice:
            time.sleep(0.05)
            _send(process.pid, number)
        try:
            code: int | None = process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            code = None
        took_s = time.monotonic() - since_s
        left = _left(process.pid)
        said.seek(0)
        text = said.read()
    return Outcome(
        name, number, at_s, twice, code, BEGUN in text, "Traceback" in text, left, took_s
    )


def _send(session: int, number: signal.Signals) -> None:
    """Send a signal to all processes of a session, as a terminal does."""
    with suppress(ProcessLookupError):
        os.killpg(session, number)


def _left(session: int) -> int:
    """Return how many processes of a session still run after a second; end them."""
    deadline = time.monotonic() + 1.0
    while (alive := _alive(session)) and time.monotonic() < deadline:
        time.sleep(0.02)
    for pid in alive:
        os.kill(pid, signal.SIGKILL)
    return len(alive)


def _alive(session: int) -> list[int]:
    found = []
    for entry in Path("/proc").iterdir():
        try:
            fields = (entry / "stat").read_bytes().rpartition(b")")[2].split()
        except OSError:
            continue
        if fields and int(fields[3]) == session and fields[0] != b"Z":
            found.append(int(entry.name))
    return found


def main() -> int:
    """Strike, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    # Processes take signals as from a terminal, also where this one was started in the background.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    rng = np.random.default_rng(options.seed)
    names = (*NODES, "dualfoot")
    outcomes = []
    for k in range(options.count):
        number = (signal.SIGINT, signal.SIGTERM)[int(rng.integers(2))]
        at_s, twice = float(rng.uniform(0.0, LATEST_S)), bool(rng.random() < 0.25)
        outcomes.append(strike(names[k % len(names)], number, at_s, twice=twice))
    table = Table("executable", "signals", "as documented", "slowest end (s)")
    for name in names:
        own = [each for each in outcomes if each.name == name]
        good = sum(each.good for each in own)
        slowest = max((each.took_s for each in own), default=0.0)
        table.add_row(name, str(len(own)), str(good), f"{slowest:.2f}")
    console = Console(width=120)
    console.print(table)
    bad = [each for each in outcomes if not each.good]
    for each in bad:
        when = "in Python's own start-up" if not each.begun else "in the package"
        console.print(f"{each.name}: {each.number.name} after {each.at_s:.2f} s, {when}: {each}")
    return int(any(each.begun for each in bad))


if __name__ == "__main__":
    sys.exit(main())
