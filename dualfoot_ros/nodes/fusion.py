"""Node ``fusion``: two streams of samples in, the trajectories of feet and person out."""

from __future__ import annotations

import sys
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from ..core import (
    FEET,
    ConfigError,
    DualFootTracker,
    EventKind,
    FloatArray,
    ImuPair,
    TrackerConfig,
    all_specs,
    check,
)
from ..settings import (
    LIVE,
    FrameConfig,
    FusionConfig,
    InputConfig,
    PathConfig,
    PersonConfig,
    node_specs,
)
from ..timing import StampConfig
from .inputs.calibrations import load_for_feet
from .inputs.field_topics import FieldInput, FieldInputs
from .inputs.foot_streams import FootStreams
from .inputs.increments_topics import IncrementsInputs
from .inputs.initial_pose import InitialPose
from .inputs.kept_biases import KeptBiases
from .inputs.pressure_topics import PressureInputs
from .inputs.stream_check import StreamCheck
from .inputs.unit_check import UnitCheck
from .results.fusion_report import FusionReport
from .results.outputs import Outputs
from .ros.cdr_imu import ImuBytes
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Reporter
from .ros.program import Graph, Program, run_nodes

NO_PAIRS = "the node that makes the pairs, as time_sync, reports in /diagnostics why it has none"
PROGRAM = Program(
    "fusion",
    "Track both feet: left|right/imu/data_raw (or data_sync) in; left|right/odometry,\n"
    "left|right/path and odometry (the person between the feet) out. With aids.barometer also\n"
    "left|right/pressure in, or pressure of a sensor worn on the body; with\n"
    "aids.magnetic_heading left|right/imu/mag.",
    "  ros2 run dualfoot_ros fusion\n"
    "  ros2 run dualfoot_ros fusion --ros-args --params-file config/liu2023.yaml\n"
    "  ros2 run dualfoot_ros fusion --ros-args -p method:=zupt \\\n"
    "      -r left/imu/data_raw:=/imu_a/data -r right/imu/data_raw:=/imu_b/data",
    (*node_specs("fusion"), *all_specs()),
)


class FusionNode(Node):
    """Node that pairs the samples of both feet, feeds the tracker and publishes its estimates."""

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`.

        Raises
        ------
        ConfigError
            For bad parameters.
        CalibrationError
            When the calibration file cannot be used.
        """
        super().__init__("fusion", **options)
        values = declare(self, [*node_specs("fusion"), *all_specs()], LIVE)
        own, frames = group(FusionConfig, values), group(FrameConfig, values, "frames.").prefixed()
        tracker = {spec.name: values[spec.name] for spec in all_specs()}
        config = TrackerConfig.from_mapping(tracker)
        self.tracker = DualFootTracker(config, engine=own.engine)
        path = group(PathConfig, values, "path.")
        person = group(PersonConfig, values, "person.")
        density = config.noise.gyro
        self.outputs = Outputs(self, frames, path, person, density, tf=own.publish_tf)
        self._calibration = load_for_feet(own.calibration)
        self.memory = KeptBiases(own.bias_memory, self.tracker, self.get_logger())
        warn = self.get_logger().warning
        self._unit_checks = {foot: UnitCheck(warn, foot) for foot in FEET}
        self._listen(own.sync == "external", values)
        self.stream_check = StreamCheck(self.tracker, self.streams.aligner)
        self._obey(frames.odom)
        self.report = FusionReport(
            self.tracker,
            self.streams.aligner,
            [
                self.streams,
                self.increments,
                self.outputs.person.trust,
                *self._unit_checks.values(),
                self.stream_check,
            ],
            self.get_clock(),
            self.get_logger(),
            external=own.sync == "external",
        )
        self._values = values
        self.add_on_set_parameters_callback(self._retune)
        self._reporter = Reporter(self, values, self.report.collect)
        self.streams.on_change = self._reporter.report

    def _listen(self, external: bool, values: dict[str, Any]) -> None:
        """Subscribe to the feet; time_sync has already applied the stamping to external pairs."""
        tracker = self.tracker
        self.increments = IncrementsInputs(
            self, tracker.config.increments, tracker.declare_increments
        )
        stamping = StampConfig() if external else group(StampConfig, values, "stamping.")
        aids = self._listen_for_aids(stamping, group(InputConfig, values, "input.").depth)
        self.streams = FootStreams(
            self,
            "imu/data_sync" if external else "imu/data_raw",
            values,
            self._read_sample,
            self._track,
            stamping=stamping,
            also=aids,
            remedy=NO_PAIRS if external else "",
        )

    def _listen_for_aids(
        self, stamping: StampConfig, depth: int
    ) -> list[PressureInputs | FieldInput]:
        """Subscribe to what the aids need; return the inputs that are to be watched."""
        aids, watched = self.tracker.config.aids, list[PressureInputs | FieldInput]()
        self.pressure: PressureInputs | None = None
        if aids.barometer:
            self.pressure = PressureInputs(self, self.tracker.add_pressure, depth)
            watched.append(self.pressure)
        self.fields: FieldInputs | None = None
        if aids.magnetic_heading:
            take = self.tracker.add_magnetic_field
            self.fields = FieldInputs(self, take, stamping, depth)
            watched.extend(self.fields.feet.values())
        return watched

    def _obey(self, frame_id: str) -> None:
        self._service = self.create_service(Trigger, "~/reset", self._reset)
        self.initial_pose = InitialPose(self, frame_id, self._set_pose)

    def _read_sample(self, foot: str, message: ImuBytes, stamp_ns: int) -> FloatArray:
        """Return specific force and angular rate (6,) of a message, calibrated."""
        if self.fields is not None:
            self.fields.stamped(foot, message.stamp_ns, stamp_ns)
        values = message.values
        if foot in self._calibration:
            values = self._calibration[foot].values(values)
        self._unit_checks[foot].add(values.tolist())
        self.stream_check.add(foot, stamp_ns, values)
        return values

    def _track(self, pair: ImuPair) -> None:
        update = self.tracker.add(pair)
        for each in (*update.earlier, update):
            self.report.add(each)
            self.memory.note(each.announced)
            if any(event.kind is EventKind.ALIGNED for event in each.announced):
                self.increments.log()
        self.outputs.publish(update, pair.present)

    def destroy_node(self) -> None:
        """Keep what the stands have told, and end."""
        self.memory.save()
        super().destroy_node()

    def _reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self.tracker.reset()
        self.streams.reset()
        self.stream_check.reset()
        self.outputs.clear()
        self.get_logger().info("reset: stand still until the alignment is done")
        response.success = True
        response.message = "aligning again: stand still"
        return response

    def _retune(self, parameters: list[Parameter]) -> SetParametersResult:
        """Go on with parameters that have changed; refuse those that are out of range."""
        specs = {spec.name: spec for spec in (*node_specs("fusion"), *all_specs())}
        changed = [p for p in parameters if p.name in specs]
        try:
            values = {p.name: check(specs[p.name], p.value) for p in changed}
            merged = {**self._values, **values}
            tracker = {spec.name: merged[spec.name] for spec in all_specs()}
            config = TrackerConfig.from_mapping(tracker)
            if any(name in tracker for name in values):
                self.tracker.retune(config)
        except ConfigError as error:
            return SetParametersResult(successful=False, reason=str(error))
        self._values = merged
        self.outputs.person.trust.tracker.limit_m = merged["person.trust_limit"]
        if values:
            shown = ", ".join(f"{name}={value}" for name, value in values.items())
            self.get_logger().info(f"changed: {shown}")
        return SetParametersResult(successful=True)

    def _set_pose(self, position: list[float], yaw: float, covariance: FloatArray | None) -> None:
        """Put the person on the floor at ``position`` (m); the tracks are those of the sensors."""
        x, y, floor = position
        sensors = [x, y, floor + self.tracker.config.zupt.lever_arm]
        turned = yaw + self.outputs.person.swing_turn
        self.tracker.set_pose(sensors, turned, covariance)


def main() -> int:
    """Run the node."""
    return run_nodes(PROGRAM, lambda: Graph([FusionNode()]))


if __name__ == "__main__":
    sys.exit(main())
