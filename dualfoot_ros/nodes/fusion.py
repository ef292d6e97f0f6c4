"""Node ``fusion``: two streams of samples in, the trajectories of feet and person out."""

from __future__ import annotations

import sys
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

from ..core import FEET, DualFootTracker, ImuPair, TrackerConfig, all_specs
from ..settings import Frames, FusionOptions, Reports, node_specs
from ..settings import Input as InputOptions
from ..settings import Path as PathOptions
from ..timing import Aligner, ClockModel, Stamping, Sync
from .inputs.calibrations import of_feet
from .inputs.field_topics import FieldInputs
from .inputs.pressure_topics import PressureInputs
from .inputs.stamp_gap import Apart
from .inputs.stamper import Stamper
from .inputs.unit_check import UnitSuspicion
from .results.fusion_report import Health
from .results.outputs import Outputs
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Reporter
from .ros.messages import imu_values, pose_yaw, to_ns
from .ros.program import Graph, Program, run_nodes
from .ros.watched_input import Input, Watch, Watched

NO_PAIRS = "; whoever makes the pairs, as time_sync does, says in /diagnostics why there are none"
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
    """Aligns the streams, feeds the tracker, publishes what it says."""

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
        own = group(FusionOptions, values)
        frames = group(Frames, values, "frames.")
        tracker = {spec.name: values[spec.name] for spec in all_specs()}
        config = TrackerConfig.from_mapping(tracker)
        self.tracker = DualFootTracker(config, engine=own.engine)
        self.aligner = Aligner(group(Sync, values, "aligner."))
        self.apart = Apart(self.aligner)
        self._stamping = _stamping(own.sync, values)
        self.stamper = Stamper(self._stamping, group(ClockModel, values, "clock."))
        path = group(PathOptions, values, "path.")
        self.outputs = Outputs(self, frames, path, config.noise.gyro, own.publish_tf)
        self._calibration = of_feet(own.calibration)
        self._listen(group(InputOptions, values, "input."), own.sync)
        self._obey(frames.odom)
        self.health = Health(self, own.sync)
        period = group(Reports, values, "reports.").period
        self._reporter = Reporter(self, period, self.health.collect)

    def _listen(self, options: InputOptions, sync: str) -> None:
        topic = "imu/data_raw" if sync == "internal" else "imu/data_sync"
        profile = qos.sensor(options.depth)
        hint = NO_PAIRS if sync == "external" else ""
        self.suspicions = {
            foot: UnitSuspicion(f"the {foot} foot", self.get_logger().warning) for foot in FEET
        }
        self.inputs = {
            foot: Input(self, Imu, f"{foot}/{topic}", self._receiver(foot), profile, hint)
            for foot in FEET
        }
        self.pressure: PressureInputs | None = None
        if self.tracker.config.aids.barometer:
            self.pressure = PressureInputs(self, self.tracker.add_pressure, options.depth)
        self.fields: FieldInputs | None = None
        if self.tracker.config.aids.magnetic_heading:
            take = self.tracker.add_magnetic_field
            self.fields = FieldInputs(self, take, self._stamping, options.depth)
        watched: list[Watched] = [*self.inputs.values()]
        watched += [self.pressure] if self.pressure is not None else []
        watched += self.fields.feet.values() if self.fields is not None else []
        self.watch = Watch(self, watched, options)

    def _obey(self, frame_id: str) -> None:
        self._frame_id = frame_id
        self._service = self.create_service(Trigger, "~/reset", self._reset)
        self._initial_pose = self.create_subscription(
            PoseWithCovarianceStamped, "initialpose", self._set_pose, qos.result(1)
        )

    def _receiver(self, foot: str) -> Any:
        calibration = self._calibration.get(foot)

        def receive(message: Imu) -> None:
            arrival_ns, header_ns = self.inputs[foot].arrival_ns, to_ns(message.header.stamp)
            stamp_ns = self.stamper.stamp(foot, header_ns, arrival_ns)
            if stamp_ns is None:
                return
            if self.fields is not None:
                self.fields.stamped(foot, header_ns, stamp_ns)
            values = imu_values(message)
            if calibration is not None:
                values = calibration.values(values)
            self.suspicions[foot].look(values.tolist())
            self.apart.see(foot, stamp_ns)
            for pair in self.aligner.push(foot, stamp_ns, values):
                self._track(pair)

        return receive

    def _track(self, pair: ImuPair) -> None:
        update = self.tracker.add(pair)
        self.health.add(update)
        self.outputs.publish(update)

    def _reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self.tracker.reset()
        self.aligner.reset()
        self.outputs.clear()
        self.get_logger().info("reset: stand still until the alignment is done")
        response.success = True
        response.message = "aligning anew: stand still"
        return response

    def _set_pose(self, message: PoseWithCovarianceStamped) -> None:
        log = self.get_logger()
        if message.header.frame_id not in ("", self._frame_id):
            log.warning(
                f"initialpose is in frame '{message.header.frame_id}' and was ignored; "
                f"allowed is '{self._frame_id}'"
            )
            return
        found = pose_yaw(message.pose.pose)
        if found is None:
            log.warning("initialpose is not finite and was ignored")
            return
        position, yaw = found
        self.tracker.set_pose(position.tolist(), yaw)
        log.info(f"pose set to {position.round(3).tolist()} m, heading {yaw:.3f} rad")


def _stamping(sync: str, values: dict[str, Any]) -> Stamping:
    """Return the policies for raw streams; time_sync has already applied them to others."""
    return group(Stamping, values, "stamping.") if sync == "internal" else Stamping()


def main() -> int:
    """Run the node."""
    return run_nodes(PROGRAM, lambda: Graph([FusionNode()]))


if __name__ == "__main__":
    sys.exit(main())
