"""Node ``imu_adapter``: any sensor becomes imu/data_raw in SI units, axes forward-left-up."""

from __future__ import annotations

import sys
from functools import partial
from typing import Any

from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import Imu

from ..core import (
    FEET,
    FieldSeries,
    FloatArray,
    ImuSeries,
    Increments,
    MountingConfig,
    SourceError,
    Vector,
)
from ..drivers import CheckConfig, SensorCheck
from ..settings import (
    AdapterConfig,
    CovarianceConfig,
    InputConfig,
    KindConfig,
    PlayConfig,
    UnitConfig,
    node_specs,
)
from ..timing import DeviceClockConfig
from .adapter import source_uri as sources
from .adapter.adapter_report import AdapterReport
from .adapter.conversion import Conversion
from .adapter.device import Device
from .adapter.first_seconds import FirstSeconds
from .adapter.losses import in_words, select_counts
from .adapter.sample_output import SampleOutput
from .inputs.calibrations import FOOT_UNKNOWN, find_foot, load_for_sensor
from .inputs.field_topics import FieldOutput
from .inputs.increments_topics import IncrementsOutput
from .inputs.stamper import Stamper
from .inputs.topic_search import TopicSearch
from .playback.player import Player, Sample, in_order, wait_to_begin
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Reporter
from .ros.messages import imu_values, new_imu, to_ns
from .ros.program import Graph, Program, run_nodes
from .ros.watched_input import InputMonitor, WatchedInput

MAG, INCREMENTS = "imu/mag", "imu/increments"
CHOOSE = "the parameter source of this imu_adapter, as in topic:///TOPIC"
PROGRAM = Program(
    "imu_adapter",
    "Publish one sensor as imu/data_raw, in SI units and with axes forward-left-up; a device or\n"
    "file that has the magnetic field, that too as imu/mag.",
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p source:=topic:///imu_a/data\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p 'source:=serial:///dev/ttyUSB0?baud=921600&format=mcu' -p mounting.axes:=y,-x,z\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/right "
    "-p 'source:=udp://0.0.0.0:8000?format=ximu3&peers=192.168.1.5' -p checks.rate:=200.0\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/right "
    "-p source:=file://walk.csv -p mounting.yaw:=3.14159\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p source:=topic:///imu -p units.specific_force:=g -p units.angular_rate:=deg/s\n"
    "  ros2 run dualfoot_ros imu_adapter --ros-args -r __ns:=/left "
    "-p source:=topic:///imu_a/data -p calibration:=both.yaml",
    tuple(node_specs("imu_adapter")),
)


class ImuAdapterNode(Node):
    """Node that relays a topic, plays a file or reads a device.

    ``done`` is completed with its file, and fails with a source that has failed for good.
    """

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`.

        Raises
        ------
        ConfigError
            For bad parameters, impossible axes or a source that names nothing.
        SourceError
            For a device with an unknown format or option.
        CalibrationError
            When the calibration file cannot be used.
        RecordingError
            When the file of the source cannot be read.
        """
        super().__init__("imu_adapter", **options)
        values = declare(self, node_specs("imu_adapter"))
        self._config = group(AdapterConfig, values)
        named = find_foot(self._config.foot, self.get_namespace())
        self._named, self._foot = named, named or FEET[0]
        self.search: TopicSearch | None = None
        self._conversion = Conversion(
            group(MountingConfig, values, "mounting."),
            group(UnitConfig, values, "units."),
            group(CovarianceConfig, values, "covariance."),
            load_for_sensor(self._config.calibration, named),
        )
        if named is None:
            self.get_logger().warning(f"taken for the {self._foot} foot, as {FOOT_UNKNOWN}")
        self.done: Future = Future()
        self.monitor: InputMonitor | None = None
        self.player: Player | None = None
        self.device: Device | None = None
        self.check = SensorCheck(group(CheckConfig, values, "checks."))
        self._depth = group(InputConfig, values, "input.").depth
        self._added_ns: int | None = None  # by the stamping, to the newest sample of a file
        self._create_outputs(values)
        source = sources.parse(self._config.source)
        stamping = sources.choose_stamping(source, self._config, self._foot)
        self.stamper = Stamper(stamping, group(DeviceClockConfig, values, "clock."))
        self.first_seconds = FirstSeconds(self, source, self.stamper, lambda: self._input.topic)
        self._output.begin(self.stamper, self.first_seconds)
        self._open(source, values)
        self._reporter = Reporter(self, values, self._make_report().collect)

    def _create_outputs(self, values: dict[str, Any]) -> None:
        self._output = SampleOutput(
            self, self._config, self._foot, self._depth, self._conversion, self.check
        )
        self.counters = self._output.counters
        self._frame_id = self._config.frame_id or f"{self._foot}_imu"
        self._own_message = new_imu(self._frame_id)
        self.field: FieldOutput | None = None
        self.increments = IncrementsOutput(self, INCREMENTS)
        self._given = group(KindConfig, values, "increments.").given
        self._declare(self._given)

    def _declare(self, kind: Increments | None) -> None:
        """Publish what the samples are; the parameter wins over the source."""
        self.increments.declare(self._given or kind)

    def _open(self, source: sources.Source, values: dict[str, Any]) -> None:
        config = group(InputConfig, values, "input.")
        if source.kind == "topic":
            profile = qos.sensor(config.depth)
            self._input = WatchedInput(
                self, Imu, source.target, self._relay, profile, latency_s=config.latency
            )
            self._search_topic()
            self.monitor = InputMonitor(self, [self._input], config)
        elif source.kind == sources.DEVICE:
            self._read_device(source, config, group(PlayConfig, values, "play."))
        else:
            self._play_file(source, group(PlayConfig, values, "play."))

    def _search_topic(self) -> None:
        """Look for a topic whose name says the foot, where no source was chosen."""
        usual = AdapterConfig().source
        if self._named is not None and self._config.source == usual:
            topic = usual.removeprefix("topic://")
            space = self.get_namespace().rpartition("/")[0]
            feet = {self._named: self._input}
            self.search = TopicSearch(self, feet, {self._named: topic}, CHOOSE, space)

    def _read_device(self, source: sources.Source, config: InputConfig, play: PlayConfig) -> None:
        self._publish_field()
        begin = partial(wait_to_begin, play, self._output.has_listener)
        self.device = Device(
            self,
            source.target,
            self.check.config,
            config,
            self._take,
            self._finish,
            begin=None if sources.is_live(source) else begin,
            declare=self._declare,
        )
        self.check = self.device.source.check
        self.device.start()

    def _play_file(self, source: sources.Source, play: PlayConfig) -> None:
        samples = sources.load(source, self._foot)
        self._declare(samples.increments)
        series: dict[str, ImuSeries | FieldSeries] = {self._foot: samples}
        if (field := samples.field) is not None:
            self._publish_field()
            series[MAG] = field
        self.player = Player(
            lambda: in_order(series),
            self._play,
            play,
            alive=self.context.ok,
            ready=self._output.has_listener,
            finished=self._finish,
        )
        self.player.start()

    def _publish_field(self) -> None:
        self.field = FieldOutput(self, MAG, self._frame_id, self._depth)

    def _relay(self, message: Imu) -> None:
        if self._config.frame_id:
            message.header.frame_id = self._config.frame_id
        header_ns = to_ns(message.header.stamp)
        sensed = self._output.check(header_ns, imu_values(message))
        if sensed is not None:
            self._output.send(message, header_ns, self._input.arrival_ns, sensed)

    def _play(self, sample: Sample) -> None:
        if sample.foot == MAG:
            self._play_field(sample)
            return
        sensed = self._output.check(sample.stamp_ns, sample.values)
        if sensed is not None:
            now_ns = int(self.get_clock().now().nanoseconds)
            stamp_ns = self._output.send(self._own_message, sample.stamp_ns, now_ns, sensed)
            self._added_ns = None if stamp_ns is None else stamp_ns - sample.stamp_ns

    def _play_field(self, sample: Sample) -> None:
        """Publish a field of a file, with the stamp of the sample before it."""
        if self.field is not None and self._added_ns is not None:
            field = self._conversion.field(sample.values.tolist())
            self.field.publish(sample.stamp_ns + self._added_ns, field)

    def _take(
        self, device_ns: int | None, arrival_ns: int, values: FloatArray, field: Vector | None
    ) -> None:
        """Send a sample of a device, which its source has checked."""
        sensed = self._conversion.scale(values)
        stamp_ns = self._output.send(self._own_message, device_ns, arrival_ns, sensed)
        if self.field is not None and field is not None and stamp_ns is not None:
            self.field.publish(stamp_ns, self._conversion.field(field))

    def _finish(self, error: SourceError | None = None) -> None:
        if error is not None:
            self.done.set_exception(error)
            return
        self.first_seconds.report()  # of a file that was shorter than these
        log, text = self.get_logger(), f"played {self.counters['relayed']} samples"
        if losses := in_words(select_counts(self._outcomes())):
            log.warning(f"{text}, the file is over; lost or refused: {losses}")
        else:
            log.info(f"{text}, the file is over")
        self.done.set_result(True)

    def _make_report(self) -> AdapterReport:
        links = self.monitor, self.device, self.stamper
        parts = self.field, self.increments, *links, self._output.unit_check
        described = [part for part in parts if part is not None]
        return AdapterReport(self.counters, self.check, described, self._outcomes)

    def _outcomes(self) -> dict[str, int]:
        """Return the counters of accepted and refused samples, as those of a device."""
        if self.device is not None:
            return self.device.source.counters
        checked = {**self.counters, **self.check.counters}
        return {**checked, "samples": self.check.counters["seen"]}

    def destroy_node(self) -> None:
        """Stop playing or reading, then destroy the node."""
        if self.device is not None:
            self.device.stop()
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
