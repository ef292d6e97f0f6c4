"""Node ``imu_adapter``: any sensor becomes imu/data_raw in SI units, axes forward-left-up."""

from __future__ import annotations

import sys
from functools import partial
from typing import Any

import numpy as np
from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import Imu

from ..core import FEET, FieldSeries, FloatArray, ImuSeries, Mounting, SourceError, Vector
from ..drivers import Checks, SensorCheck
from ..drivers import Sample as Sensed
from ..settings import AdapterOptions, Covariance, Play, Reports, Units, node_specs
from ..settings import Input as InputOptions
from ..timing import ClockModel, Stamping
from .adapter import source_uri as sources
from .adapter.conversion import Conversion
from .adapter.device import Device
from .adapter.losses import Refusals, counts, in_words
from .inputs.calibrations import FOOT_UNKNOWN, of_sensor
from .inputs.field_topics import FieldOutput
from .inputs.stamper import Stamper
from .inputs.unit_check import UnitSuspicion
from .playback.player import Player, Sample, in_order, wait_to_begin
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.diagnostics import WARN, Rates, Reporter, Status
from .ros.messages import imu_values, new_imu, set_imu_values, set_time, to_ns
from .ros.program import Graph, Program, run_nodes
from .ros.watched_input import Input, Watch, watched_publisher

MAG = "imu/mag"
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
    """Relays a topic, plays a file or reads a device.

    ``done`` is completed with its file, and fails with a source that has failed for good.
    """

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`.

        Raises
        ------
        ConfigError
            For bad parameters, axes that are none or a source that names nothing.
        SourceError
            For a device with an unknown format or option.
        CalibrationError
            When the calibration file cannot be used.
        RecordingError
            When the file of the source cannot be read.
        """
        super().__init__("imu_adapter", **options)
        values = declare(self, node_specs("imu_adapter"))
        self._options = group(AdapterOptions, values)
        named = self._named_foot()
        self._foot = named or FEET[0]
        self._conversion = Conversion(
            group(Mounting, values, "mounting."),
            group(Units, values, "units."),
            group(Covariance, values, "covariance."),
            of_sensor(self._options.calibration, named),
        )
        if named is None:
            self.get_logger().warning(f"taken for the {self._foot} foot, as {FOOT_UNKNOWN}")
        self.counters = {"relayed": 0, "not_finite": 0}
        self.done: Future = Future()
        self.watch: Watch | None = None
        self.player: Player | None = None
        self.device: Device | None = None
        self.check = SensorCheck(group(Checks, values, "checks."))
        self._rates, self._refusals = Rates(), Refusals()
        self._suspicion = UnitSuspicion("this sensor", self.get_logger().warning)
        self._depth = group(InputOptions, values, "input.").depth
        self._out = watched_publisher(self, Imu, "imu/data_raw", qos.sensor(self._depth))
        self._frame_id = self._options.frame_id or f"{self._foot}_imu"
        self._own_message = new_imu(self._frame_id)
        self.field: FieldOutput | None = None
        self._added_ns: int | None = None  # by the stamping, to the newest sample of a file
        source = sources.parse(self._options.source)
        self.stamper = Stamper(self._stamping(source), group(ClockModel, values, "clock."))
        self._open(source, values)
        self._reporter = Reporter(self, group(Reports, values, "reports.").period, self._collect)

    def _open(self, source: sources.Source, values: dict[str, Any]) -> None:
        options = group(InputOptions, values, "input.")
        if source.kind == "topic":
            self._input = Input(self, Imu, source.target, self._relay, qos.sensor(options.depth))
            self.watch = Watch(self, [self._input], options)
        elif source.kind == sources.DEVICE:
            self._read_device(source, options, group(Play, values, "play."))
        else:
            self._play_file(source, group(Play, values, "play."))

    def _read_device(self, source: sources.Source, options: InputOptions, play: Play) -> None:
        self._publish_field()
        begin = partial(wait_to_begin, play, self._has_listener)
        self.device = Device(
            self,
            source.target,
            self.check.options,
            options,
            self._take,
            self._finish,
            None if sources.is_live(source) else begin,
        )
        self.check = self.device.source.check
        self.device.start()

    def _play_file(self, source: sources.Source, play: Play) -> None:
        samples = sources.load(source, self._foot)
        series: dict[str, ImuSeries | FieldSeries] = {self._foot: samples}
        if (field := samples.field) is not None:
            self._publish_field()
            series[MAG] = field
        self.player = Player(
            lambda: in_order(series),
            self._play,
            play,
            alive=self.context.ok,
            ready=self._has_listener,
            finished=self._finish,
        )
        self.player.start()

    def _publish_field(self) -> None:
        self.field = FieldOutput(self, MAG, self._frame_id, self._depth)

    def _has_listener(self) -> bool:
        return bool(self._out.get_subscription_count() > 0)

    def _stamping(self, source: sources.Source) -> Stamping:
        policy = self._options.stamp
        if policy == "auto":
            policy = "device" if sources.is_live(source) else "header"
        return Stamping.from_mapping(
            {self._foot: policy, f"{self._foot}_offset": self._options.stamp_offset}
        )

    def _named_foot(self) -> str | None:
        """Return the foot that parameter or namespace name, None when neither does."""
        if self._options.foot != "auto":
            return self._options.foot
        named = [foot for foot in FEET if foot in self.get_namespace().split("/")]
        return named[0] if named else None

    def _relay(self, message: Imu) -> None:
        if self._options.frame_id:
            message.header.frame_id = self._options.frame_id
        header_ns = to_ns(message.header.stamp)
        sensed = self._sensed(header_ns, imu_values(message))
        if sensed is not None:
            self._send(message, header_ns, self._input.arrival_ns, sensed)

    def _play(self, sample: Sample) -> None:
        if sample.foot == MAG:
            self._play_field(sample)
            return
        sensed = self._sensed(sample.stamp_ns, sample.values)
        if sensed is not None:
            now_ns = int(self.get_clock().now().nanoseconds)
            stamp_ns = self._send(self._own_message, sample.stamp_ns, now_ns, sensed)
            self._added_ns = None if stamp_ns is None else stamp_ns - sample.stamp_ns

    def _play_field(self, sample: Sample) -> None:
        """Publish a field of a file, stamped as the sample before it was."""
        if self.field is not None and self._added_ns is not None:
            field = self._conversion.field(sample.values.tolist())
            self.field.publish(sample.stamp_ns + self._added_ns, field)

    def _take(
        self, device_ns: int | None, arrival_ns: int, values: FloatArray, field: Vector | None
    ) -> None:
        """Send a sample of a device, which has been checked by its source."""
        sensed = self._conversion.sensed(values)
        stamp_ns = self._send(self._own_message, device_ns, arrival_ns, sensed)
        if self.field is not None and field is not None and stamp_ns is not None:
            self.field.publish(stamp_ns, self._conversion.field(field))

    def _sensed(self, header_ns: int, values: FloatArray) -> FloatArray | None:
        """Return a sample (6,) in SI units and the axes of the sensor; None: it is refused."""
        sensed = self._conversion.sensed(values)
        if not np.isfinite(sensed).all():
            self.counters["not_finite"] += 1
            self.check.interrupt()
            return None
        force, rate = tuple(sensed[:3].tolist()), tuple(sensed[3:].tolist())
        return sensed if self.check.accept(Sensed(header_ns, force, rate)) else None

    def _send(
        self, message: Imu, header_ns: int | None, arrival_ns: int, sensed: FloatArray
    ) -> int | None:
        """Publish a sample; return its stamp, None when it has none."""
        stamp_ns = self._stamp(header_ns, arrival_ns)
        if stamp_ns is None:
            return None
        values = self._conversion.turned(sensed)
        self._suspicion.look(values.tolist())
        set_time(message.header.stamp, stamp_ns)
        set_imu_values(message, values)
        self._conversion.describe(message)
        self._out.publish(message)
        self.counters["relayed"] += 1
        return stamp_ns

    def _stamp(self, header_ns: int | None, arrival_ns: int) -> int | None:
        if header_ns is None:  # a device without a clock
            return arrival_ns + round(1e9 * self._options.stamp_offset)
        return self.stamper.stamp(self._foot, header_ns, arrival_ns)

    def _finish(self, error: SourceError | None = None) -> None:
        if error is not None:
            self.done.set_exception(error)
            return
        log, said = self.get_logger(), f"played {self.counters['relayed']} samples"
        if refused := in_words(counts(self._outcomes())):
            log.warning(f"{said}, the file is over; what was not: {refused}")
        else:
            log.info(f"{said}, the file is over")
        self.done.set_result(True)

    def _outcomes(self) -> dict[str, int]:
        """Return what became of the samples, in the counters of a device."""
        if self.device is not None:
            return self.device.source.counters
        seen = {**self.counters, **self.check.counters}
        return {**seen, "samples": self.check.counters["seen"]}

    def _collect(self, status: Status) -> None:
        rates = self._rates.since_last(self.counters)
        status.values["rate (Hz)"] = rates["relayed"]
        status.values.update(self.counters)
        if self.field is not None:
            status.values["magnetic fields"] = self.field.sent
        if self.watch is not None:
            self.watch.describe(status)
        if self.device is not None:
            self.device.describe(status)
        else:
            status.values |= {name: n for name, n in self.check.counters.items() if n}
        status.values["sampling rate (Hz)"] = self.check.rate_hz
        self.stamper.describe(status)
        if rates["not_finite"] > 0:
            said = f"samples that are not finite are refused: {self.counters['not_finite']} so far"
            status.note(WARN, said)
        for sentence in self._suspicion.said:
            status.note(WARN, sentence)
        for sentence in self.check.findings:
            status.note(WARN, sentence, " ".join(sentence.split()[:2]))
        self._refusals.describe(self._outcomes(), status)

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
