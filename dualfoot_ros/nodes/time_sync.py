"""Node ``time_sync``: two raw streams in, two streams with equal stamps out."""

from __future__ import annotations

import sys
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import Imu

from ..core import FEET, ImuPair
from ..settings import Input as InputOptions
from ..settings import Reports, node_specs
from ..timing import Aligner, ClockModel, Stamping, Sync
from .inputs.stamp_gap import Apart
from .inputs.stamper import Stamper
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Rates, Reporter, Status
from .ros.messages import imu_values, new_imu, set_imu_values, set_time, to_ns
from .ros.program import Graph, Program, run_nodes
from .ros.watched_input import Input, Watch, watched_publisher

PROGRAM = Program(
    "time_sync",
    "Bring left/imu/data_raw and right/imu/data_raw on one time grid: left|right/imu/data_sync.",
    "  ros2 run dualfoot_ros time_sync\n"
    "  ros2 run dualfoot_ros time_sync --ros-args -p aligner.rate:=200.0\n"
    "  ros2 run dualfoot_ros time_sync --ros-args -p stamping.left:=device "
    "-p stamping.right:=device",
    tuple(node_specs("time_sync")),
)


class TimeSyncNode(Node):
    """Publishes every pair the aligner completes, as two messages with one stamp."""

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`; raise ConfigError for bad parameters."""
        super().__init__("time_sync", **options)
        values = declare(self, node_specs("time_sync"))
        inputs = group(InputOptions, values, "input.")
        self.aligner = Aligner(group(Sync, values, "aligner."))
        self.apart = Apart(self.aligner)
        self.stamper = Stamper(
            group(Stamping, values, "stamping."), group(ClockModel, values, "clock.")
        )
        self._messages = {foot: new_imu(f"{foot}_imu") for foot in FEET}
        profile = qos.sensor(inputs.depth)
        self._out = {
            foot: watched_publisher(self, Imu, f"{foot}/imu/data_sync", profile) for foot in FEET
        }
        self.inputs = {
            foot: Input(self, Imu, f"{foot}/imu/data_raw", self._receiver(foot), profile)
            for foot in FEET
        }
        self.watch = Watch(self, list(self.inputs.values()), inputs)
        self._rates = Rates()
        self._reporter = Reporter(self, group(Reports, values, "reports.").period, self._collect)

    def _receiver(self, foot: str) -> Any:
        def receive(message: Imu) -> None:
            self._describe(foot, message)
            arrival_ns = self.inputs[foot].arrival_ns
            stamp_ns = self.stamper.stamp(foot, to_ns(message.header.stamp), arrival_ns)
            if stamp_ns is None:
                return
            self.apart.see(foot, stamp_ns)
            for pair in self.aligner.push(foot, stamp_ns, imu_values(message)):
                self._publish(pair)

        return receive

    def _describe(self, foot: str, received: Imu) -> None:
        """Pass on what interpolation does not change."""
        message = self._messages[foot]
        message.header.frame_id = received.header.frame_id
        message.angular_velocity_covariance = received.angular_velocity_covariance
        message.linear_acceleration_covariance = received.linear_acceleration_covariance

    def _publish(self, pair: ImuPair) -> None:
        for k, foot in enumerate(FEET):
            message = self._messages[foot]
            set_time(message.header.stamp, pair.stamp_ns)
            set_imu_values(message, pair.values[6 * k : 6 * k + 6])
            self._out[foot].publish(message)

    def _collect(self, status: Status) -> None:
        counters = self.aligner.counters
        rates = self._rates.since_last(counters)
        self.watch.describe(status)
        status.values["pair rate (Hz)"] = rates["pairs"]
        status.values.update(counters)
        self.stamper.describe(status)
        self.apart.describe(status)


def main() -> int:
    """Run the node."""
    return run_nodes(PROGRAM, lambda: Graph([TimeSyncNode()]))


if __name__ == "__main__":
    sys.exit(main())
