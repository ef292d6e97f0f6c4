"""CPU time and peak of memory of a command, by the resource usage of its process.

``python -m benchmark.performance.usage COMMAND ...`` runs a command and prints both as JSON.  It
is a small process of its own, since the peak of a child begins with that of its parent.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
CACHE = "dualfoot_benchmark_bytecode"


class Usage(NamedTuple):
    """CPU time (s, user and system) and the largest resident set (MB) of a command."""

    cpu_s: float
    peak_mb: float


def usage_of(command: Sequence[str], environment: Mapping[str, str] | None = None) -> Usage:
    """Run a command of this Python (its arguments) and return what it took.

    Modules are compiled to bytecode as where the package is installed: by the first run of each.

    Raises
    ------
    RuntimeError
        When it fails; says what it wrote.
    """
    compiled = {"PYTHONPYCACHEPREFIX": str(Path(tempfile.gettempdir()) / CACHE)}
    own = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    done = subprocess.run(
        [sys.executable, str(Path(__file__).resolve()), sys.executable, *command],
        env={**own, **compiled, "PYTHONPATH": str(ROOT), **(environment or {})},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}: {done.stderr}")
    return Usage(*json.loads(done.stdout))


def main() -> int:
    """Run the command of the arguments and print its usage."""
    done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=False)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(json.dumps([used.ru_utime + used.ru_stime, used.ru_maxrss * 1024 / 1e6]))
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
