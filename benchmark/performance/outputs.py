"""The node ``fusion`` beside an empty node with the same topics, fed by the same samples.

Both run at once, so that a slow minute of the machine hits both.  CPU time and memory are those
that /proc tells; latency is from the publishing of a pair to the odometry of the person.
"""

from __future__ import annotations

import gc
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from ..cases import make_walk
from .figure import Figure
from .usage import ROOT

RATE_HZ = 200.0
LAP_S = 40.0  # of the walk, at least
WARM_S = 16.0  # alignment, the compiled kernel, the first strides
TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")
SIDES = ("fusion", "pass_through")
MODULES = {"fusion": "dualfoot_ros.nodes.fusion", "pass_through": f"{__package__}.pass_through"}


class Side:
    """One of the two nodes in a process of its own, and what it costs."""

    def __init__(self, name: str, environment: dict[str, str]) -> None:
        remapped = [f"{foot}/imu/data_raw:=/{foot}/imu/data_raw" for foot in ("left", "right")]
        command = [sys.executable, "-m", MODULES[name], "--ros-args", "-r", f"__ns:=/{name}"]
        command += [argument for each in remapped for argument in ("-r", each)]
        self.process = subprocess.Popen(command, env=environment, cwd=ROOT)
        self.latency_s: list[float] = []

    def cpu_s(self) -> float:
        """Return the CPU time so far."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) * TICK_S

    def memory_mb(self) -> float:
        """Return the resident memory."""
        lines = Path(f"/proc/{self.process.pid}/status").read_text().splitlines()
        (line,) = (line for line in lines if line.startswith("VmRSS"))
        return int(line.split()[1]) * 1024 / 1e6

    def end(self) -> None:
        """End the node."""
        self.process.send_signal(signal.SIGINT)
        self.process.wait()


def output_figures(walked_min: float = 0.0, seconds: float = 30.0) -> list[Figure]:
    """Return CPU time, latency and memory of ``fusion`` beside those of the pass-through.

    They are measured for some ``seconds``, when ``walked_min`` minutes have been walked.
    """
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": str(random.randint(100, 200)),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONPATH": os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]),
    }
    os.environ.update(environment)
    sides = {name: Side(name, environment) for name in SIDES}
    try:
        used = _feed(sides, WARM_S + 60.0 * walked_min, seconds)
    finally:
        for side in sides.values():
            side.end()
    return _figures(sides, used)


def _figures(sides: dict[str, Side], used: dict[str, tuple[float, float]]) -> list[Figure]:
    if not all(sides[name].latency_s for name in SIDES):
        raise RuntimeError("a node gave no odometry: this machine is too busy for real time")
    (cpu, memory), (unit, least) = (used[name] for name in SIDES)
    late, early = (float(np.quantile(sides[name].latency_s, 0.99)) for name in SIDES)
    to = "pass-through"
    return [
        Figure("outputs: CPU of fusion", cpu / unit, to, f"{cpu:.2f} and {unit:.2f} s", 1.15),
        Figure(
            "outputs: p99 latency", late / early, to,
            f"{1e3 * late:.2f} and {1e3 * early:.2f} ms", 1.15,
        ),
        Figure(
            "outputs: memory of fusion", memory / least, to,
            f"{memory - least:.0f} MB more than {least:.0f}", "60 MB more",
        ),
    ]  # fmt: skip


def _feed(sides: dict[str, Side], warm_s: float, seconds: float) -> dict[str, tuple[float, float]]:
    """Publish a walk in real time; return CPU time and memory of each side after the warm-up."""
    import rclpy
    from nav_msgs.msg import Odometry
    from rclpy.executors import SingleThreadedExecutor
    from sensor_msgs.msg import Imu

    from dualfoot_ros.nodes.ros import qos

    rclpy.init()
    node = rclpy.create_node("feeder")
    try:
        publishers = [
            node.create_publisher(Imu, f"/{foot}/imu/data_raw", qos.sensor(400))
            for foot in ("left", "right")
        ]
        sent: dict[int, float] = {}
        for name, side in sides.items():
            node.create_subscription(
                Odometry, f"/{name}/odometry", _listener(side, sent), qos.result(400)
            )
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        while min(node.count_publishers(f"/{name}/odometry") for name in sides) < 1:
            executor.spin_once(timeout_sec=0.1)
        return _walk(sides, (warm_s, seconds), publishers, executor, sent)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _listener(side: Side, sent: dict[int, float]) -> Any:
    def take(message: Any) -> None:
        stamp = message.header.stamp
        stamp_ns = stamp.sec * 1_000_000_000 + stamp.nanosec
        side.latency_s.append(time.monotonic() - sent[stamp_ns])

    return take


def _walk(
    sides: dict[str, Side],
    parts_s: tuple[float, float],
    publishers: list[Any],
    executor: Any,
    sent: dict[int, float],
) -> dict[str, tuple[float, float]]:
    """Publish pairs in real time; ``sent`` gets the moment (s) of each by its stamp (ns).

    ``parts_s`` are the lengths of the warm-up and of what is measured.
    """
    from dualfoot_ros.nodes.ros.messages import new_imu, set_imu_values, set_time

    walk = make_walk(RATE_HZ, laps=round(sum(parts_s) / LAP_S) + 1)
    messages = [new_imu("imu"), new_imu("imu")]
    total, warm = round(sum(parts_s) * RATE_HZ), round(parts_s[0] * RATE_HZ)
    start, start_ns, before = time.monotonic(), time.time_ns(), dict[str, float]()
    gc.disable()
    for k, pair in enumerate(walk.pairs[:total]):
        while (left := start + k / RATE_HZ - time.monotonic()) > 0:
            executor.spin_once(timeout_sec=left)
        if k == warm:
            before = {name: side.cpu_s() for name, side in sides.items()}
            for side in sides.values():
                side.latency_s.clear()
        stamp_ns = start_ns + round(k * 1e9 / RATE_HZ)
        sent[stamp_ns] = time.monotonic()
        for foot, (message, publisher) in enumerate(zip(messages, publishers, strict=True)):
            set_time(message.header.stamp, stamp_ns)
            set_imu_values(message, pair.values[6 * foot : 6 * foot + 6])
            publisher.publish(message)
    return {n: (s.cpu_s() - before[n], s.memory_mb()) for n, s in sides.items()}
