"""How soon a running `fusion` names a fault of its streams, and how soon it says that it is over.

    python benchmark/live_faults.py [--seed 1]

A walk of two feet is handed to the node sample by sample, in data time, with a fault from 20 s to
35 s; the node reports once a second, as it does by default, on a clock that the script owns.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rclpy
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from rich.console import Console
from rich.table import Table
from sensor_msgs.msg import Imu

ROOT = Path(__file__).resolve().parents[1]
for folder in (ROOT, ROOT / "test"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))

from own_time import OwnTime  # noqa: E402  (the clock of the tests)

from dualfoot_ros.core import FEET, FloatArray  # noqa: E402
from dualfoot_ros.core.samples.series import stack_pairs  # noqa: E402
from dualfoot_ros.inspection import FindingKind  # noqa: E402
from dualfoot_ros.nodes.fusion import FusionNode  # noqa: E402
from dualfoot_ros.nodes.ros.messages import new_imu, set_imu_values, set_time  # noqa: E402
from dualfoot_ros.nodes.ros.status import Status  # noqa: E402
from dualfoot_ros.simulation import WalkConfig, simulate  # noqa: E402

RATE = 100
STEP_NS = 10**9 // RATE
BEGIN_S, END_S, LENGTH_S = 20.0, 35.0, 52.0
HOUR_NS = 3600 * 10**9
K = FindingKind
Sent = list[tuple[str, int, FloatArray]]
"""Foot, stamp in the header, and values (6,) of the samples that come at one moment."""
Damage = Callable[[int, int, FloatArray, np.random.Generator], Sent]


def both(stamp_ns: int, row: FloatArray) -> Sent:
    """Return the samples of both feet."""
    return [(foot, stamp_ns, row[6 * f : 6 * f + 6]) for f, foot in enumerate(FEET)]


def right(stamp_ns: int, row: FloatArray, *stamps: int, values: FloatArray | None = None) -> Sent:
    """Return the left foot's sample as it is, and the right one's with other stamps or values."""
    given = row[6:] if values is None else values
    return [("left", stamp_ns, row[:6]), *(("right", each, given) for each in stamps)]


def silent(k: int, t: int, row: FloatArray, _: np.random.Generator) -> Sent:
    """Leave the right foot out."""
    return right(t, row)


def alternating(k: int, t: int, row: FloatArray, _: np.random.Generator) -> Sent:
    """Let each foot have holes of 0.15 s where the other one delivers."""
    return both(t, row)[k // 15 % 2 :][:1]


def jittered(k: int, t: int, row: FloatArray, rng: np.random.Generator) -> Sent:
    """Let the right foot's headers be up to 12 ms late."""
    return right(t, row, t + int(rng.integers(0, 9_900_000)) + 2_000_000 * (k % 2))


def lossy(k: int, t: int, row: FloatArray, rng: np.random.Generator) -> Sent:
    """Lose 5 % of the right foot's samples."""
    return right(t, row, *([t] if rng.random() >= 0.05 else []))


@dataclass(frozen=True)
class Fault:
    """A fault, the kinds of findings that name it, and whether it lasts from the start."""

    name: str
    damage: Damage
    kinds: tuple[FindingKind, ...]
    whole: bool = False


NAN = np.full(6, np.nan)
DEGREES = np.repeat([1.0, 180.0 / np.pi], 3)
FAULTS = (
    Fault("right foot silent", silent, (K.STALE_FOOT,)),
    Fault("zero stamps of the right foot", lambda k, t, r, _: right(t, r, 0), (K.ZERO_STAMPS,)),
    Fault("zero stamps of both feet", lambda k, t, r, _: both(0, r), (K.ZERO_STAMPS,)),
    Fault("each sample twice", lambda k, t, r, _: right(t, r, t, t), (K.EQUAL_STAMPS,)),
    Fault(
        "ten samples with one stamp",
        lambda k, t, r, _: right(t, r, t - k % 10 * STEP_NS),
        (K.EQUAL_STAMPS,),
    ),
    Fault("headers 0 to 12 ms late", jittered, (K.JITTER,)),
    Fault("5 % of the samples lost", lossy, (K.MISSING_SAMPLES,)),
    Fault("holes that cover each other", alternating, (K.NO_PAIRS,)),
    Fault(
        "not finite, right foot", lambda k, t, r, _: right(t, r, t, values=NAN),
        (K.NO_PAIRS, K.REFUSED_SAMPLES, K.STALE_FOOT),
    ),
    Fault(
        "clock of the right foot +1 h", lambda k, t, r, _: right(t, r, t + HOUR_NS), (K.CLOCK_SET,)
    ),
    Fault("both clocks -1 h", lambda k, t, r, _: both(t - HOUR_NS, r), (K.CLOCK_SET,)),
    Fault(
        "clocks an hour apart from the start",
        lambda k, t, r, _: right(t, r, t + HOUR_NS), (K.STAMPS_APART,), True,
    ),
    Fault("half the rate", lambda k, t, r, _: both(t, r) if k % 2 else [], (K.RATE_USED,)),
    Fault(
        "one sensor for both feet", lambda k, t, r, _: right(t, r, t, values=r[:6]),
        (K.SAME_SAMPLES,), True,
    ),
    Fault(
        "right gyro in deg/s", lambda k, t, r, _: right(t, r, t, values=r[6:] * DEGREES),
        (K.RATE_UNIT,), True,
    ),
)  # fmt: skip


class Bench:
    """A fusion node that is fed by hand, and what it has said when."""

    def __init__(self, own: OwnTime) -> None:
        self.node = FusionNode(parameter_overrides=[Parameter("engine", value="compiled")])
        self._own, self._message = own, new_imu("sensor")
        self.said: list[tuple[float, FindingKind]] = []
        self._begun_s = own.monotonic()
        self.node.streams.on_change = self.report

    def send(self, samples: Sent) -> None:
        """Hand over samples as they come from the network."""
        for foot, stamp_ns, values in samples:
            message: Imu = self._message
            set_time(message.header.stamp, stamp_ns)
            set_imu_values(message, np.ascontiguousarray(values))
            now_ns = self._own.time_ns()
            self.node.streams.inputs[foot]._receive(  # noqa: SLF001 - as rclpy calls it
                serialize_message(message), {"received_timestamp": now_ns}
            )

    def report(self) -> None:
        """Let the node report, as every second and when a foot becomes stale or is back."""
        at_s = self._own.monotonic() - self._begun_s
        status = Status()
        self.node.report.collect(status)
        self.node.stream_check.wait()  # for an inspection that this has begun
        self.said += [(at_s, finding.kind) for finding in status.findings]


def run(fault: Fault, rows: FloatArray, seed: int) -> tuple[str, str]:
    """Return after how many seconds a fault is named, and for how long after its end."""
    own, rng = OwnTime(), np.random.default_rng(seed)
    for name, module in list(sys.modules.items()):
        if name.startswith("dualfoot_ros.") and hasattr(module, "time"):
            vars(module)["time"] = own
    bench, start_ns = Bench(own), own.time_ns()
    for k, row in enumerate(rows[: round(LENGTH_S * RATE)]):
        at_s = k / RATE
        here = fault.whole or BEGIN_S <= at_s < END_S
        stamp_ns = start_ns + k * STEP_NS
        bench.send(fault.damage(k, stamp_ns, row, rng) if here else both(stamp_ns, row))
        own.move_on(1.0 / RATE)
        if k % RATE == RATE - 1:
            bench.report()
    bench.node.destroy_node()
    told = [at_s for at_s, kind in bench.said if kind in fault.kinds]
    if not told:
        return "not named", ""
    begin_s = 0.0 if fault.whole else BEGIN_S
    over = "" if fault.whole else f"{max(told[-1] - END_S, 0.0) + 1.0:.0f} s"
    return f"{told[0] - begin_s:.1f} s", over


def main() -> int:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    seed = parser.parse_args().seed
    walk = simulate(WalkConfig(rate=RATE, standing=5.0), seed=seed)
    rows = stack_pairs(walk.left, walk.right)
    rclpy.init(args=["", "--ros-args", "--log-level", "ERROR"])
    table = Table("fault", "named within", "as", "gone within, after its end")
    missed = 0
    for fault in FAULTS:
        named, over = run(fault, rows, seed)
        missed += named == "not named"
        table.add_row(fault.name, named, ", ".join(fault.kinds), over)
    rclpy.try_shutdown()
    Console(width=120).print(table)
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
