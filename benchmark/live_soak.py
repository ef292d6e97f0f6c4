"""A fusion node that runs for long: its memory and latency from the first minutes to the last.

    python benchmark/live_soak.py [--minutes 20] [--rate 200] [--engine compiled]

A simulated walk of many laps is published in real time to a `fusion` in a process of its own.
Its resident memory is read every second, and the latency of its odometry is measured from the
moment a pair of samples is sent.  An inspection of the last minute takes some memory for a moment,
so the growth is the slope of the lows of the second half, given with its standard error and for a
day; a shorter run only widens that error.
"""

from __future__ import annotations

import argparse
import math
import os
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import rclpy
from nav_msgs.msg import Odometry
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Imu

from dualfoot_ros.core import FEET, FloatArray
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import new_imu, set_imu_values, set_time, to_ns
from dualfoot_ros.simulation import WalkConfig, simulate

ROOT = Path(__file__).resolve().parents[1]
MIB = 1024.0**2
SCRIPT = "import sys; from dualfoot_ros.nodes.entry import fusion; sys.exit(fusion())"
WARM_S = 20.0
LAP_S = 30.0  # of the walk, at least


@dataclass
class Record:
    """What was measured: (s, MiB) of the memory, (s, ms) of the latency."""

    memory: list[tuple[float, float]] = field(default_factory=list)
    latency: list[tuple[float, float]] = field(default_factory=list)
    sent: int = 0


class Feeder(Node):
    """Publishes a walk as two sensors would, and receives the odometry that comes of it."""

    def __init__(self, minutes: float, rate: float, record: Record) -> None:
        super().__init__("feeder")
        laps = math.ceil(60.0 * minutes / LAP_S)
        walk = simulate(WalkConfig(rate=rate, laps=laps, standing=5.0), seed=1)
        self._values = stack_pairs(walk.left, walk.right)
        self._step_ns, self.record = round(1e9 / rate), record
        self._sent_ns: dict[int, int] = {}
        self._messages = [new_imu(foot) for foot in FEET]
        profile = qos.sensor(round(2 * rate))
        self._out = [self.create_publisher(Imu, f"{f}/imu/data_raw", profile) for f in FEET]
        self.create_subscription(Odometry, "right/odometry", self._receive, qos.result(500))
        self._begun_ns = time.time_ns()

    @property
    def listeners(self) -> int:
        """How many subscribe to both feet."""
        return min(publisher.get_subscription_count() for publisher in self._out)

    def begin(self) -> None:
        """Take this moment as that of the first sample."""
        self._begun_ns = time.time_ns()

    def send_due(self) -> float:
        """Send what is due; return the time to the next sample, s."""
        number = self.record.sent
        stamp_ns = self._begun_ns + number * self._step_ns
        now_ns = time.time_ns()
        if stamp_ns > now_ns:
            return (stamp_ns - now_ns) * 1e-9
        row: FloatArray = self._values[number]
        self._sent_ns[stamp_ns] = now_ns
        for k, message in enumerate(self._messages):
            set_time(message.header.stamp, stamp_ns)
            set_imu_values(message, row[6 * k : 6 * k + 6])
            self._out[k].publish(message)
        self.record.sent += 1
        return 0.0

    def _receive(self, message: Odometry) -> None:
        stamp_ns, now_ns = to_ns(message.header.stamp), time.time_ns()
        sent_ns = self._sent_ns.pop(stamp_ns, None)
        if sent_ns is not None:
            at_s = (now_ns - self._begun_ns) * 1e-9
            self.record.latency.append((at_s, (now_ns - sent_ns) * 1e-6))
        if len(self._sent_ns) > 10_000:  # while it aligns, nothing comes back
            self._sent_ns.clear()


def resident_mib(pid: int) -> float:
    """Return the resident memory of a process."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / MIB


def soak(minutes: float, rate: float, engine: str) -> Record:
    """Feed a fusion node for some minutes."""
    record = Record()
    rclpy.init(args=[])
    executor, feeder = SingleThreadedExecutor(), Feeder(minutes, rate, record)
    executor.add_node(feeder)
    command = [sys.executable, "-c", SCRIPT, "--ros-args", "-p", f"engine:={engine}"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    fusion = subprocess.Popen(command, env=environment)
    try:
        while not feeder.listeners:
            executor.spin_once(timeout_sec=0.1)
        feeder.begin()
        begun_s = looked_s = time.monotonic()
        while (now_s := time.monotonic()) - begun_s < 60.0 * minutes:
            wait_s = feeder.send_due()
            executor.spin_once(timeout_sec=min(wait_s, 0.01))
            if now_s - looked_s > 1.0:
                looked_s = now_s
                record.memory.append((now_s - begun_s, resident_mib(fusion.pid)))
    finally:
        fusion.terminate()
        fusion.wait()
        feeder.destroy_node()
        executor.shutdown()
        rclpy.try_shutdown()
    return record


def growth(memory: list[tuple[float, float]]) -> tuple[float, float]:
    """Return the slope of the lows of (s, MiB) in the second half, MiB an hour, and its error.

    Neighbouring readings are not independent: the error is that of the lows of ten stretches.
    """
    half = np.array(memory)[len(memory) // 2 :]
    lows = np.array([part[part[:, 1].argmin()] for part in np.array_split(half, 10)])
    hours, mib = lows[:, 0] / 3600.0, lows[:, 1]
    lever = hours - hours.mean()
    slope = float(lever @ mib / (lever @ lever))
    rest = mib - mib.mean() - slope * lever
    return slope, float(np.sqrt(rest @ rest / (len(lows) - 2) / (lever @ lever)))


def main() -> None:
    """Measure, and print what was found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=20.0)
    parser.add_argument("--rate", type=float, default=200.0)
    parser.add_argument("--engine", default="compiled")
    options = parser.parse_args()
    record = soak(options.minutes, options.rate, options.engine)
    slope, error = growth(record.memory)
    mib = np.array([value for _, value in record.memory])
    parts = np.array_split(mib, 4)
    print(f"{record.sent} pairs sent in {options.minutes:g} min, 2 x {options.rate:g} Hz")
    lows = ", ".join(f"{part.min():.1f}" for part in parts)
    print(f"memory: lows of the quarters {lows} MiB; most at any moment {mib.max():.1f} MiB")
    print(
        f"growth: {slope:+.2f} +- {error:.2f} MiB an hour, "
        f"{24 * slope:+.0f} +- {24 * error:.0f} MiB a day at this rate"
    )
    late = np.array([each for each in record.latency if each[0] > WARM_S])
    for name, part in zip(("first", "middle", "last"), np.array_split(late, 3), strict=True):
        p50, p99 = np.percentile(part[:, 1], [50, 99])
        print(f"latency, {name} third: median {p50:.2f} ms, 99 % {p99:.1f} ms, {len(part)} pairs")


if __name__ == "__main__":
    main()
