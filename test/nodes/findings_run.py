"""Every finding that nodes can have, each brought about once: ``python findings_run.py [reword]``.

Prints as JSON what code acts on (kinds, levels, what is logged and how often) and the texts.  It
runs without ROS: time, topics and links are those of the test.
"""

import json
import math
import sys
import time
from types import SimpleNamespace

if sys.argv[1:] == ["reword"]:
    from nodes import rewording

    rewording.install(
        "dualfoot_ros.nodes",
        "dualfoot_ros.drivers",
        "dualfoot_ros.core.refusals",
        "dualfoot_ros.inspection.findings",
    )

import numpy as np
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu

from dualfoot_ros.core import DualFootTracker, ImuPair, Refusal, Update
from dualfoot_ros.core.results.context import Context
from dualfoot_ros.drivers import CheckConfig, Sample, SensorCheck, State
from dualfoot_ros.nodes.adapter.adapter_report import AdapterReport
from dualfoot_ros.nodes.adapter.device import Device
from dualfoot_ros.nodes.inputs.field_topics import FieldInput
from dualfoot_ros.nodes.inputs.foot_states import FootStates
from dualfoot_ros.nodes.inputs.pressure_topics import PressureInputs
from dualfoot_ros.nodes.inputs.stamp_checks import StampChecks
from dualfoot_ros.nodes.inputs.stamp_gap import StampGap
from dualfoot_ros.nodes.inputs.stamper import Stamper
from dualfoot_ros.nodes.inputs.unit_check import WINDOW, UnitCheck
from dualfoot_ros.nodes.results.fusion_report import FusionReport
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.diagnostics import FindingMemory
from dualfoot_ros.nodes.ros.status import Status
from dualfoot_ros.nodes.ros.watched_input import InputMonitor, WatchedInput
from dualfoot_ros.settings import InputConfig
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing import Aligner, DeviceClockConfig, StampConfig

STEP_NS = 10_000_000
HOUR_NS = 3600 * 10**9
STANDING = np.array([0.0, 0.0, 9.80665, 0.0, 0.0, 0.0])
RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)


class Log:
    """The log and the clock of a node without ROS."""

    def __init__(self):
        self.lines = []
        self.nanoseconds = 0
        self.ros_time_is_active = False

    def warning(self, text):
        self.lines.append(text)

    info = warning

    def now(self):
        return self


class Graph:
    """A node without ROS: its topics have the publishers that the scene gives them."""

    def __init__(self):
        self.log, self.publishers = Log(), []
        self.context = SimpleNamespace(ok=lambda: True)

    def get_logger(self):
        return self.log

    def get_clock(self):
        return self.log

    def create_timer(self, *_, **__):
        return None

    def create_subscription(self, _kind, topic, *_, **__):
        return SimpleNamespace(topic_name=f"/{topic}")

    def get_publishers_info_by_topic(self, _topic):
        return self.publishers

    def count_publishers(self, _topic):
        return len(self.publishers)

    def publish(self, kind, profile):
        self.publishers = [SimpleNamespace(topic_type=kind, qos_profile=profile)]


class Stage:
    """Runs the scenes by a clock of its own and notes what they bring about."""

    def __init__(self):
        self.now_s, self.outcome, self.texts = 0.0, [], []
        self._memory = FindingMemory()
        time.monotonic = lambda: self.now_s

    def report(self, *describers, graph=None):
        """Report twice, as a node does; note findings, levels and how many lines are logged."""
        for _ in range(2):
            status = Status()
            for describe in describers:
                describe(status)
            begun = self._memory.update(status.findings, self.now_s).begun
            findings = [(f.kind, f.about, f.severity) for f in status.findings]
            lines = graph.log.lines if graph else []
            self.outcome.append(
                [findings, status.level.hex(), [f.kind for f in begun], len(lines)]
            )
            self.texts += [f.sentence for f in status.findings]
        self.texts += lines


def silent_inputs(stage):
    graph, config = Graph(), InputConfig()
    watched = WatchedInput(graph, Imu, "imu", lambda _: None, qos.sensor(10))
    strict = WatchedInput(graph, Imu, "strict", lambda _: None, RELIABLE)
    others = [PressureInputs(graph, lambda *_: None, 10), FieldInput(graph, "left", print, 10)]
    monitor = InputMonitor(graph, [watched, strict, *others], config)

    def look():
        for _ in range(3):
            monitor.look()
        stage.report(monitor.describe, graph=graph)

    stage.now_s += 3.0
    look()
    for kind in ("std_msgs/msg/String", "sensor_msgs/msg/Imu"):
        graph.publish(kind, qos.sensor(10))
        look()
    stage.now_s += 30.0
    look()
    watched._receive(Imu(), {})
    watched.lost += 3
    look()
    stage.now_s += 3.0
    look()


def wrong_units(stage):
    graph = Graph()
    for scale, rate in ((1.0 / 9.80665, 0.0), (1e-3, 0.0), (1.0, 200.0)):
        check = UnitCheck(graph.log.warning, "left")
        for _ in range(3 * WINDOW):
            check.add([*(scale * STANDING[:3]), rate, 0.0, 0.0])
        stage.report(check.describe, graph=graph)


def stamps_apart(stage):
    for behind_ns, silent in ((40 * 10**9, 0), (0, 120)):
        aligner = Aligner()
        gap = StampGap(aligner)
        for k in range(500):
            stage.now_s += 1e-9 * STEP_NS
            for foot, off_ns in (("left", 0), ("right", -behind_ns)):
                if foot == "left" or not 300 <= k < 300 + silent:
                    stamp_ns = 10**12 + k * STEP_NS + off_ns
                    gap.observe(foot, stamp_ns)
                    aligner.push(foot, stamp_ns, STANDING)
            if k % 100 == 99:
                stage.report(gap.describe)


def one_foot(stage):
    aligner = Aligner()
    states, gap = FootStates(aligner, ("left", "right")), StampGap(aligner)
    for k in range(700):
        stage.now_s += 1e-9 * STEP_NS
        for foot in ("left", "right") if not 100 <= k < 200 else ("left",):
            stamp_ns = 10**12 + k * STEP_NS
            gap.observe(foot, stamp_ns)
            broken = foot == "right" and k >= 300
            aligner.push(foot, stamp_ns, STANDING * (math.nan if broken else 1.0))
            states.observe()
        if k % 100 == 99:
            stage.report(states.describe, gap.describe)


def bad_stamps(stage):
    late = np.random.default_rng(1).exponential(6e6, 1000).astype(np.int64)
    arrived = np.maximum.accumulate(np.arange(1000) * STEP_NS + late) + np.arange(1000)
    back = np.where(np.arange(1000) > 500, -HOUR_NS, 0)
    even = np.arange(1000) * STEP_NS
    for left, right in (
        (even, np.full(1000, -(10**12))),
        (even, even // (10 * STEP_NS) * 10 * STEP_NS),
        (even, arrived),
        (even, even + back),
        (even + back, even + back),
    ):
        aligner = Aligner()
        checks = StampChecks(aligner, lambda _: "header")
        for k in range(1000):
            for foot, stamp_ns in (("left", int(left[k])), ("right", int(right[k]))):
                checks.observe(foot, 10**12 + stamp_ns, 10**12 + stamp_ns)
                aligner.push(foot, 10**12 + stamp_ns, STANDING)
        stage.report(checks.describe)


def too_slow(stage):
    graph = Graph()
    watched = WatchedInput(graph, Imu, "imu", lambda _: None, qos.sensor(10), latency_s=2.0)
    monitor = InputMonitor(graph, [watched], InputConfig())
    watched._receive(Imu(), {"received_timestamp": time.time_ns() - 10**10})
    stage.report(monitor.describe, graph=graph)


def device_clocks(stage):
    for rate, count in ((1.0, 100), (1e-3, 3000), (1.015, 2000)):
        stamper = Stamper(StampConfig(left="device"), DeviceClockConfig())
        for k in range(count):
            stamper.stamp("left", round(k * STEP_NS * rate), HOUR_NS + k * STEP_NS)
        stage.report(stamper.describe)
    stamper, sampled = (
        Stamper(StampConfig(left="device"), DeviceClockConfig()),
        np.arange(3000) * STEP_NS,
    )
    arrived = HOUR_NS + arrivals(BleLinkConfig(interval=0.025), sampled, np.random.default_rng(1))
    for sampled_ns, arrived_ns in zip(sampled.tolist(), arrived.tolist(), strict=True):
        stamper.stamp("left", sampled_ns, arrived_ns)
    stamper.stamp("right", -1, 0)
    stage.report(stamper.describe)


def moving(k, **changes):
    """Return sample ``k`` of a sensor at 200 Hz that moves."""
    force, rate = (0.1 * k, 0.0, 9.8 + 0.01 * k), (0.01 * k, 0.02 * k, 0.03 * k)
    return Sample(k, force, rate, 5000 * k, 1000, 32)._replace(**changes)


def sensor_faults(stage):
    config = CheckConfig(rate=100.0, force_range=156.9, rate_range=30.0, stuck_axis_after=200)
    clipped = {"specific_force": (156.9, 0.0, 0.0), "angular_rate": (30.0, 0.0, 0.0)}
    scenes = (
        [moving(k) for k in range(300)],
        [moving(k, **(clipped if k % 2 else {})) for k in range(60)],
        [
            moving(k, specific_force=(9.8, 0.0, 0.0), angular_rate=(0.0, 0.0, 0.0))
            for k in range(60)
        ],
    )
    for samples in scenes:
        check, counters = SensorCheck(config), {"relayed": 0, Refusal.NOT_FINITE: 0}
        report = AdapterReport(counters, check, [], lambda: {"samples": 90, "lost": 10})
        for sample in samples:
            check.accept(sample)
        counters[Refusal.NOT_FINITE] += 1
        stage.now_s += 20.0
        stage.report(report.collect)


def devices(stage):
    graph = Graph()
    device = Device(
        graph,
        "udp://127.0.0.1:0?format=ximu3&peers=127.0.0.1",
        CheckConfig(),
        InputConfig(),
        lambda *_: None,
        lambda _: None,
    )
    source, transport = device.source, device.source.transport

    def enter(state):
        source.reader.state = state
        device._change(state, "the reason")
        stage.report(device.describe, graph=graph)

    def feed(data, seconds):
        source._take(data, 0)
        stage.now_s += seconds
        stage.report(device.describe, graph=graph)

    for state in (State.WAITING, State.CONNECTING, State.CONNECTED):
        enter(state)
    stage.now_s += 3.0
    stage.report(device.describe, graph=graph)
    feed(b"\x00\x01 no frame of that format \x02" * 40, 0.0)
    feed(b"", 30.0)
    good, bad = b"I,%d,0,0,0,0,0,1\r\n", b"I,5,0,0,nan,0,0,1\r\n"
    for k in range(6):
        transport.sender = f"127.0.0.1:{k % 2}"
        feed(good % (1000 * k), 0.0)
    for _ in range(3):
        transport.sender = "127.0.0.1:0"
        source._take(good % 9000, 0)
        transport.sender = "127.0.0.1:1"
        source._take(good % 9001, 0)
    stage.report(device.describe, graph=graph)
    feed(bad, 3.0)
    transport._count_stranger("10.0.0.1")
    feed(b"", 3.0)
    device.without_time += 1
    stage.report(device.describe, graph=graph)


def the_walk(stage):
    graph, aligner = Graph(), Aligner()
    tracker = DualFootTracker(engine="interpreted")
    report = FusionReport(tracker, aligner, [], graph.log, graph.log, external=True)
    for k in range(300):
        values = np.concatenate([STANDING, STANDING]) + math.sin(k)
        report.add(tracker.add(ImuPair(10**12 + k * STEP_NS, values)))
    stage.report(report.collect, graph=graph)
    for bad in (math.nan, math.nan, 1e6):
        report.add(tracker.add(ImuPair(10**12 + 10**10, np.full(12, bad))))
    report.add(tracker.add(ImuPair(10**12, values)))
    for k in range(100):
        for foot, off_ns in (("left", 0), ("right", STEP_NS // 2)):
            aligner.push(foot, k * STEP_NS + off_ns, STANDING)
    aligner.push("left", 100 * STEP_NS, math.nan * STANDING)
    tracker.counters[Refusal.STANCES_WITHOUT_PRESSURE] += 1
    tracker.counters[Refusal.STANCES_WITHOUT_FIELD] += 1
    for stamp_ns in (2 * 10**12, 2 * 10**12 + 6 * 10**9):
        report.add(Update(stamp_ns, Context("walking")))
    stage.now_s += 1.0
    stage.report(report.collect, graph=graph)


def main():
    stage = Stage()
    for scene in (
        silent_inputs,
        wrong_units,
        stamps_apart,
        one_foot,
        bad_stamps,
        too_slow,
        device_clocks,
        sensor_faults,
        devices,
        the_walk,
    ):
        scene(stage)
    print(json.dumps({"outcome": stage.outcome, "texts": stage.texts}))


if __name__ == "__main__":
    main()
