"""The filter over many epochs, and over a day: what must hold does, and memory does not grow.

    python -m benchmark.endurance [--epochs 10000000] [--hours 0.5] [--rate 200]

A simulated walk is repeated without end.  Every so often the covariance must be symmetric to the
bit and its least eigenvalue not below rounding, the attitudes orthonormal, all numbers finite.
The soak feeds pairs one by one, as live, in real time divided by whatever the machine can.
"""

from __future__ import annotations

import argparse
import ctypes
import gc
import math
import resource
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.console import Console

from dualfoot_ros.core import DualFootTracker, FloatArray, ImuPair, IntArray, TrackerConfig
from dualfoot_ros.core.alignment import Alignment
from dualfoot_ros.core.compiler import compiled
from dualfoot_ros.core.kernel import Workspace
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.row_store import RowStore
from dualfoot_ros.core.samples.pair_series import PairSeries
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.core.session import Session
from dualfoot_ros.simulation import WalkConfig, simulate

CHECK_EVERY = 20_000  # epochs
MIB = 1024.0**2


@dataclass
class Worst:
    """The worst that was seen of a workspace.

    Attributes
    ----------
    checks : how often it was looked at
    asymmetry : greatest difference of P and its transpose, over its size
    least_eigenvalue : of P as correlations (over its trace, 30)
    skewness : greatest element of R' R - I of both attitudes
    finite : all numbers were
    position_std : greatest standard deviation of a position, m
    heading_std : of a heading, rad
    """

    checks: int = 0
    asymmetry: float = 0.0
    least_eigenvalue: float = float("inf")
    skewness: float = 0.0
    finite: bool = True
    position_std: float = 0.0
    heading_std: float = 0.0

    def look(self, space: Workspace) -> None:
        """Take what a workspace is now."""
        P = space.covariance()
        self.checks += 1
        self.finite = self.finite and bool(np.isfinite(space.w[: lay.STATE]).all())
        own = [space.own_block(foot) for foot in range(2)]
        apart = max(float(np.abs(block - block.T).max()) for block in own)
        self.asymmetry = max(self.asymmetry, apart / float(np.abs(P).max()))
        std = np.sqrt(np.diag(P))
        feet = std.reshape(2, lay.ERRORS)
        self.position_std = max(self.position_std, float(feet[:, lay.E_POS : lay.E_VEL].max()))
        self.heading_std = max(self.heading_std, float(feet[:, lay.E_ATT + 2].max()))
        least = float(np.linalg.eigvalsh(P / np.outer(std, std))[0]) / len(P)
        self.least_eigenvalue = min(self.least_eigenvalue, least)
        for foot in range(2):
            start = foot * lay.FOOT + lay.ROT
            R = space.w[start : start + 9].reshape(3, 3)
            self.skewness = max(self.skewness, float(np.abs(R.T @ R - np.eye(3)).max()))


def endless(rate: float, seed: int = 0) -> tuple[FloatArray, FloatArray]:
    """Return the pairs (N, 12) of a walk's stand, and those (M, 12) to repeat after them."""
    walk = WalkConfig(rate=rate, route="rectangle", standing=4.0, final_standing=2.0)
    made = simulate(walk, seed=seed)
    values = stack_pairs(made.left, made.right)
    stand = round(3.0 * rate)
    return values[:stand], values[stand:]


def run_epochs(count: int, rate: float, method: str = "spacing_vector") -> Worst:
    """Track ``count`` epochs, chunk by chunk, and return the worst that was seen."""
    stand, loop = endless(rate)
    period_ns, worst = round(1e9 / rate), Worst()
    session = standing_session(TrackerConfig(method=method), stand, period_ns)
    stamp = period_ns * len(stand)
    chunk = np.tile(loop, (max(1, CHECK_EVERY // len(loop)), 1))
    last, chunk = len(chunk), np.concatenate([stand[-1:], chunk])
    parts, rows, done = np.hsplit(chunk, 4), RowStore(len(chunk)), 0
    while done < count:
        stamps: IntArray = stamp + period_ns * np.arange(-1, last, dtype=np.int64)
        series = PairSeries(stamps, *map(np.ascontiguousarray, parts))
        for _ in session.steps(series, (1, last + 1), rows):
            pass
        stamp += period_ns * last
        done += last
        worst.look(session.space)
        there = series.present(slice(1, last + 1))
        numbers = rows.written(slice(1, last + 1), there, session.heading_variances())
        worst.finite = worst.finite and numbers
    return worst


def standing_session(config: TrackerConfig, stand: FloatArray, period_ns: int) -> Session:
    """Return a session that has been aligned on a stand (N, 12)."""
    alignment = Alignment(config)
    for k, pair in enumerate(stand):
        start = alignment.add(k * period_ns, pair)
        if start is not None:
            return Session(config, compiled(), start)
    raise SystemExit("the stand is too short to align on it")


def feed(tracker: DualFootTracker, values: FloatArray, stamp: int, period_ns: int) -> int:
    """Feed pairs one by one from ``stamp`` on; return the stamp after them."""
    for pair in values:
        tracker.add(ImuPair(stamp, pair))
        stamp += period_ns
    return stamp


@dataclass(frozen=True)
class Memory:
    """What a process holds.

    Attributes
    ----------
    resident_mib : memory that is resident, as the system maps it; libraries are a third of it
    allocated_mib : what has been allocated by malloc, where that tells (glibc)
    blocks : objects and buffers that Python has allocated
    """

    resident_mib: float
    allocated_mib: float
    blocks: int

    @classmethod
    def now(cls) -> Memory:
        """Return what is held when all garbage has been collected."""
        gc.collect()
        return cls(resident_mib(), allocated_mib(), sys.getallocatedblocks())


def soak(hours: float, rate: float) -> list[Memory]:
    """Feed hours of data one by one; return the memory after each part of ten."""
    stand, loop = endless(rate)
    tracker = DualFootTracker(engine="compiled")
    period_ns = round(1e9 / rate)
    stamp = feed(tracker, loop, feed(tracker, stand, 0, period_ns), period_ns)
    part = round(hours * 3600.0 * rate / 10.0)
    held = [Memory.now()]
    for _ in range(10):
        left = part
        while left > 0:
            stamp = feed(tracker, loop[:left], stamp, period_ns)
            left -= len(loop)
        held.append(Memory.now())
    return held


def resident_mib() -> float:
    """Return the memory that the process holds now, MiB."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
        return pages * resource.getpagesize() / MIB
    except OSError:  # not on Linux: the peak
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


class MallocInfo(ctypes.Structure):
    """The struct of mallinfo2(3)."""

    _fields_ = tuple(
        (name, ctypes.c_size_t)
        for name in (
            *("arena", "ordblks", "smblks", "hblks", "hblkhd"),
            *("usmblks", "fsmblks", "uordblks", "fordblks", "keepcost"),
        )
    )


def allocated_mib() -> float:
    """Return what malloc has given out and not got back, MiB; nan where it does not tell."""
    try:
        ask = ctypes.CDLL(None).mallinfo2
    except (AttributeError, TypeError, OSError):  # another C library
        return math.nan
    ask.restype = MallocInfo
    told = ask()
    return float(told.uordblks + told.hblkhd) / MIB


def main() -> int:
    """Run both, and print what came of them."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--epochs", type=int, default=10_000_000)
    parser.add_argument("--hours", type=float, default=0.5, help="of data, one by one")
    parser.add_argument("--rate", type=float, default=200.0)
    parser.add_argument("--method", default="spacing_vector")
    arguments = parser.parse_args()
    console = Console()
    if arguments.epochs > 0:
        console.print(run_epochs(arguments.epochs, arguments.rate, arguments.method))
    if arguments.hours > 0.0:
        held = soak(arguments.hours, arguments.rate)
        first = held[0]
        parts = " ".join(f"{each.resident_mib - first.resident_mib:+.2f}" for each in held)
        console.print(f"{arguments.hours:g} h of data: {first.resident_mib:.1f} MiB, then {parts}")
        given = " ".join(f"{each.allocated_mib - held[1].allocated_mib:+.3f}" for each in held[1:])
        blocks = " ".join(f"{each.blocks - held[1].blocks:+d}" for each in held[1:])
        console.print(f"since the first part: malloc {given} MiB; Python {blocks} blocks")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
