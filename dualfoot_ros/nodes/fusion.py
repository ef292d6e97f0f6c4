"""Node ``fusion``: two streams of samples in, the trajectories of feet and person out."""

from __future__ import annotations

import sys
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

from ..core import FEET, DualFootTracker, EventKind, FloatArray, ImuPair, TrackerConfig, all_specs
from ..settings import FrameConfig, FusionConfig, InputConfig, PathConfig, node_specs
from ..timing import StampConfig
from .inputs.calibrations import load_for_feet
from .inputs.field_topics import FieldInput, FieldInputs
from .inputs.foot_streams import FootStreams
from .inputs.increments_topics import IncrementsInputs
from .inputs.pressure_topics import PressureInputs
from .inputs.unit_check import UnitCheck
from .results.fusion_report import FusionReport
from .results.outputs import Outputs
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Reporter
from .ros.messages import imu_values, pose_yaw, to_ns
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
        values = declare(self, [*node_specs("fusion"), *all_specs()])
        own, frames = group(FusionConfig, values), group(FrameConfig, values, "frames.")
        tracker = {spec.name: values[spec.name] for spec in all_specs()}
        config = TrackerConfig.from_mapping(tracker)
        self.tracker = DualFootTracker(config, engine=own.engine)
        path = group(PathConfig, values, "path.")
        self.outputs = Outputs(self, frames, path, config.noise.gyro, own.publish_tf)
        self._calibration = load_for_feet(own.calibration)
        warn = self.get_logger().warning
        self._unit_checks = {foot: UnitCheck(warn, foot) for foot in FEET}
        self._listen(own.sync == "external", values)
        self._obey(frames.odom)
        self.report = FusionReport(
            self.tracker,
            self.streams.aligner,
            [self.streams, self.increments, *self._unit_checks.values()],
            self.get_clock(),
            self.get_logger(),
            external=own.sync == "external",
        )
        self._reporter = Reporter(self, values, self.report.collect)

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
        self._frame_id = frame_id
        self._service = self.create_service(Trigger, "~/reset", self._reset)
        self._initial_pose = self.create_subscription(
            PoseWithCovarianceStamped, "initialpose", self._set_pose, qos.result(1)
        )

    def _read_sample(self, foot: str, message: Imu, stamp_ns: int) -> FloatArray:
        """Return specific force and angular rate (6,) of a message, calibrated."""
        if self.fields is not None:
            self.fields.stamped(foot, to_ns(message.header.stamp), stamp_ns)
        values = imu_values(message)
        if foot in self._calibration:
            values = self._calibration[foot].values(values)
        self._unit_checks[foot].add(values.tolist())
        return values

    def _track(self, pair: ImuPair) -> None:
        update = self.tracker.add(pair)
        self.report.add(update)
        if any(event.kind is EventKind.ALIGNED for event in update.announced):
            self.increments.log()
        self.outputs.publish(update)

    def _reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self.tracker.reset()
        self.streams.reset()
        self.outputs.clear()
        self.get_logger().info("reset: stand still until the alignment is done")
        response.success = True
        response.message = "aligning again: stand still"
        return response

    def _set_pose(self, message: PoseWithCovarianceStamped) -> None:
        log = self.get_logger()
        if message.header.frame_id not in ("", self._frame_id):
            log.warning(
                f"initialpose is in frame '{message.header.frame_id}' and was ignored; "
                f"allowed is '{self._frame_id}'"
            )
            return
        pose = pose_yaw(message.pose.pose)
        if pose is None:
            log.warning("initialpose is not finite and was ignored")
            return
        position, yaw = pose
        self.tracker.set_pose(position.tolist(), yaw)
        log.info(f"pose set to {position.round(3).tolist()} m, heading {yaw:.3f} rad")


def main() -> int:
    """Run the node."""
    return run_nodes(PROGRAM, lambda: Graph([FusionNode()]))


if __name__ == "__main__":
    sys.exit(main())
