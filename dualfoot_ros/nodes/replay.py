"""Node ``replay``: a recorded bag in; its topics and /clock out."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rclpy.task import Future
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu

from ..core import FEET, ImuSeries
from ..recording import Recording, RecordingError, find_topics, read_bag
from ..settings import PlayConfig, ReplayConfig, node_specs
from .inputs.field_topics import TOPICS as MAGNETIC
from .inputs.field_topics import FieldOutput
from .inputs.increments_topics import TOPICS as KINDS
from .inputs.increments_topics import IncrementsOutput
from .inputs.pressure_topics import TOPICS, PressureOutputs
from .playback.player import Player, Sample, Series, in_order
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Reporter
from .ros.messages import new_imu, set_imu_values, set_time
from .ros.program import Graph, Program, run_nodes
from .ros.status import Status
from .ros.watched_publisher import watched_publisher

DEPTH = 2000
CLOCK_STEP_NS = 5_000_000
PROGRAM = Program(
    "replay",
    "Publish the samples of a bag as left|right/imu/data_raw, what they are as\n"
    "left|right/imu/increments, its magnetic fields as left|right/imu/mag, its air pressure as\n"
    "left|right/pressure or pressure, and /clock; ends with the bag.",
    "  ros2 run dualfoot_ros replay --ros-args -p bag:=bags/demo\n"
    "  ros2 run dualfoot_ros replay --ros-args -p bag:=walk.mcap -p play.rate:=4.0 "
    "-p play.loop:=true",
    tuple(node_specs("replay")),
)


class ReplayNode(Node):
    """Node that publishes a recording; ``done`` is completed at its end.

    With a ``gate`` samples go out one by one as it opens, so that within one process nothing is
    lost at any speed; the owner of the gate starts ``player`` when it is ready.
    """

    def __init__(self, *, gate: Callable[[], bool] | None = None, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`.

        Raises
        ------
        ConfigError
            For bad parameters.
        RecordingError
            When the bag cannot be read or has no samples.
        """
        super().__init__("replay", **options)
        values = declare(self, node_specs("replay"))
        own = group(ReplayConfig, values)
        recording = _read(own.bag, self.get_logger().info)
        self.series = _select_series(recording, own.bag)
        pressure = dict(recording.pressure)
        fields = {foot: series.field for foot, series in self.series.items()}
        samples: dict[str, Series] = {**self.series}
        samples |= {MAGNETIC[foot]: field for foot, field in fields.items() if field is not None}
        samples |= {TOPICS[worn]: series for worn, series in pressure.items()}
        self.pressure = PressureOutputs(self, pressure, DEPTH)
        self.increments = {foot: IncrementsOutput(self, KINDS[foot]) for foot in self.series}
        for foot, imu in self.series.items():
            self.increments[foot].declare(imu.increments)
        self.fields = {
            topic: FieldOutput(self, topic, recording.frame(foot), DEPTH)
            for foot, topic in MAGNETIC.items()
            if topic in samples
        }
        self.done: Future = Future()
        self._messages = {foot: new_imu(recording.frame(foot)) for foot in self.series}
        self._out = {
            foot: watched_publisher(self, Imu, f"{foot}/imu/{own.topic}", qos.sensor(DEPTH))
            for foot in self.series
        }
        self._clock_publisher = (
            self.create_publisher(Clock, "/clock", qos.clock()) if own.clock else None
        )
        self._clock_ns = 0
        self.total = sum(map(len, samples.values()))
        self.player = Player(
            lambda: in_order(samples),
            self._publish,
            group(PlayConfig, values, "play."),
            alive=self.context.ok,
            ready=self._has_listeners,
            gate=gate,
            finished=self._finish,
        )
        self._reporter = Reporter(self, values, self._collect)
        if gate is None:
            self.player.start()

    def _has_listeners(self) -> bool:
        return all(publisher.get_subscription_count() for publisher in self._out.values())

    def _publish(self, sample: Sample) -> None:
        if (
            self._clock_publisher is not None
            and abs(sample.due_ns - self._clock_ns) >= CLOCK_STEP_NS
        ):
            self._publish_clock(sample.due_ns)
        if sample.foot in self.fields:
            self.fields[sample.foot].publish(sample.stamp_ns, sample.values)
            return
        if sample.foot not in self._messages:
            self.pressure.publish(sample.foot, sample.stamp_ns, float(sample.values[0]))
            return
        message = self._messages[sample.foot]
        set_time(message.header.stamp, sample.stamp_ns)
        set_imu_values(message, sample.values)
        self._out[sample.foot].publish(message)

    def _publish_clock(self, now_ns: int) -> None:
        assert self._clock_publisher is not None
        message = Clock()
        set_time(message.clock, now_ns)
        self._clock_publisher.publish(message)
        self._clock_ns = now_ns

    def _finish(self) -> None:
        self.get_logger().info(f"played {self.player.played} samples, the bag is over")
        self.done.set_result(True)

    def _collect(self, status: Status) -> None:
        status.values["played"] = self.player.played
        status.values["samples"] = self.total

    def destroy_node(self) -> None:
        """Stop playing, then destroy the node."""
        self.player.stop()
        super().destroy_node()


def _read(bag: str, say: Callable[[str], object]) -> Recording:
    if not bag:
        raise RecordingError("parameter 'bag' is empty; allowed is the path of a bag to play")
    path = Path(bag).expanduser()
    choice = find_topics(path)
    for sentence in choice.sentences:
        say(sentence)
    return read_bag(path, topics=choice.topics)


def _select_series(recording: Recording, bag: str) -> dict[str, ImuSeries]:
    feet = {foot: recording.imu(foot) for foot in FEET}
    series = {foot: imu for foot, imu in feet.items() if imu is not None and len(imu)}
    if not series:
        raise RecordingError(
            f"bag '{bag}' has no samples on /left/imu/data_raw or /right/imu/data_raw"
        )
    return series


def _build() -> Graph:
    node = ReplayNode()
    return Graph([node], node.done)


def main() -> int:
    """Run the node until the bag is over."""
    return run_nodes(PROGRAM, _build)


if __name__ == "__main__":
    sys.exit(main())
