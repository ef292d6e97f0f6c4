"""Node ``imu_adapter``: any sensor becomes imu/data_raw in SI units, axes forward-left-up."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import Imu

from ..calibration import SensorCalibration, sensor_calibration
from ..core.series import FloatArray
from ..core.trajectory import FEET
from ..options import AdapterOptions, Covariance, Mounting, Play, Reports, Units, node_specs
from ..options import Input as InputOptions
from . import qos, sources
from .conversion import Conversion
from .diagnostics import WARN, Rates, Reporter, Status
from .messages import imu_values, new_imu, set_imu_values, set_time
from .parameters import declare, group
from .player import Player, Sample, in_order
from .shell import Graph, Program, run_nodes
from .suspicion import UnitSuspicion
from .watch import Input, Watch, watched_publisher

PROGRAM = Program(
    "imu_adapter",
    "Publish one sensor as imu/data_raw, in SI units and with axes forward-left-up.",
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p source:=topic:///imu_a/data\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/right "
    "-p source:=file://walk.csv -p mounting.yaw:=3.14159\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p source:=topic:///imu -p units.specific_force:=g -p units.angular_rate:=deg/s\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p source:=topic:///imu_a/data -p calibration:=both.yaml",
    tuple(node_specs("imu_adapter")),
)


class ImuAdapterNode(Node):
    """Relays a topic or plays a file; ``done`` is completed when the file is over."""

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`.

        Raises
        ------
        ConfigError
            For bad parameters or a source that names nothing.
        CalibrationError
            When the calibration file cannot be used.
        RecordingError
            When the file of the source cannot be read.
        """
        super().__init__("imu_adapter", **options)
        values = declare(self, node_specs("imu_adapter"))
        self._options = group(AdapterOptions, values)
        self._conversion = Conversion(
            group(Mounting, values, "mounting."),
            group(Units, values, "units."),
            group(Covariance, values, "covariance."),
            self._calibration(),
        )
        self.counters = {"relayed": 0, "not_finite": 0}
        self.done: Future = Future()
        self.watch: Watch | None = None
        self.player: Player | None = None
        self._rates = Rates()
        self._suspicion = UnitSuspicion("this sensor", self.get_logger().warning)
        depth = group(InputOptions, values, "input.").depth
        self._out = watched_publisher(self, Imu, "imu/data_raw", qos.sensor(depth))
        self._open(sources.parse(self._options.source), values)
        self._reporter = Reporter(self, group(Reports, values, "reports.").period, self._collect)

    def _open(self, source: sources.Source, values: dict[str, Any]) -> None:
        if source.scheme == "topic":
            options = group(InputOptions, values, "input.")
            listener = Input(self, Imu, source.target, self._relay, qos.sensor(options.depth))
            self.watch = Watch(self, [listener], options.silence)
            return
        foot = self._foot()
        series = {foot: sources.load(source, foot)}
        self._file_message = new_imu(self._options.frame_id or f"{foot}_imu")
        self.player = Player(
            lambda: in_order(series),
            self._play,
            group(Play, values, "play."),
            alive=self.context.ok,
            ready=lambda: self._out.get_subscription_count() > 0,
            finished=self._finish,
        )
        self.player.start()

    def _calibration(self) -> SensorCalibration | None:
        if not self._options.calibration:
            return None
        return sensor_calibration(self._options.calibration, self._foot())

    def _foot(self) -> str:
        if self._options.foot != "auto":
            return self._options.foot
        named = [foot for foot in FEET if foot in self.get_namespace().split("/")]
        return named[0] if named else "left"

    def _relay(self, message: Imu) -> None:
        if self._options.frame_id:
            message.header.frame_id = self._options.frame_id
        if self._options.stamp == "arrival":
            message.header.stamp = self.get_clock().now().to_msg()
        self._send(message, imu_values(message))

    def _play(self, sample: Sample) -> None:
        set_time(self._file_message.header.stamp, sample.stamp_ns)
        if self._options.stamp == "arrival":
            self._file_message.header.stamp = self.get_clock().now().to_msg()
        self._send(self._file_message, sample.values)

    def _send(self, message: Imu, values: FloatArray) -> None:
        converted = self._conversion.values(values)
        if not np.isfinite(converted).all():
            self.counters["not_finite"] += 1
            return
        self._suspicion.look(converted.tolist())
        set_imu_values(message, converted)
        self._conversion.describe(message)
        self._out.publish(message)
        self.counters["relayed"] += 1

    def _finish(self) -> None:
        self.get_logger().info(f"played {self.counters['relayed']} samples, the file is over")
        self.done.set_result(True)

    def _collect(self, status: Status) -> None:
        rates = self._rates.since_last(self.counters)
        status.values["rate (Hz)"] = rates["relayed"]
        status.values.update(self.counters)
        if self.watch is not None:
            self.watch.describe(status)
        if rates["not_finite"] > 0:
            status.note(WARN, "samples that are not finite are refused")
        for sentence in self._suspicion.said:
            status.note(WARN, sentence)

    def destroy_node(self) -> None:
        """Stop playing, then destroy the node."""
        if self.player is not None:
            self.player.stop()
        super().destroy_node()


def _build() -> Graph:
    node = ImuAdapterNode()
    return Graph([node], node.done)


def main() -> int:
    """Run the node; it ends with its file, or never."""
    return run_nodes(PROGRAM, _build)


if __name__ == "__main__":
    sys.exit(main())
