"""Node ``time_sync``: two raw streams in, two streams with equal stamps out."""

from __future__ import annotations

import sys
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import Imu

from ..core import FEET, FloatArray, ImuPair
from ..settings import InputConfig, node_specs
from ..timing import StampConfig
from .inputs.foot_streams import FootStreams
from .ros import qos
from .ros.cdr_imu import FilledImu, ImuBytes
from .ros.declared_parameters import declare, group
from .ros.diagnostics import Rates, Reporter
from .ros.program import Graph, Program, run_nodes
from .ros.status import Status
from .ros.watched_publisher import watched_publisher

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
    """Node that publishes every pair of samples as two messages with one stamp.

    Where a foot is missing there is the message of the other one only.
    """

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`; raise ConfigError for bad parameters."""
        super().__init__("time_sync", **options)
        values = declare(self, node_specs("time_sync"))
        self._messages = {foot: FilledImu(f"{foot}_imu") for foot in FEET}
        profile = qos.sensor(group(InputConfig, values, "input.").depth)
        self._out = {
            foot: watched_publisher(self, Imu, f"{foot}/imu/data_sync", profile) for foot in FEET
        }
        self.streams = FootStreams(
            self,
            "imu/data_raw",
            values,
            self._read_sample,
            self._publish,
            stamping=group(StampConfig, values, "stamping."),
        )
        self._rates = Rates()
        self._reporter = Reporter(self, values, self._collect)
        self.streams.on_change = self._reporter.report

    def _read_sample(self, foot: str, sample: ImuBytes, _stamp_ns: int) -> FloatArray:
        """Return the values (6,) of a message; pass on what interpolation does not change."""
        self._messages[foot].follow(sample)
        return sample.values

    def _publish(self, pair: ImuPair) -> None:
        for k, (foot, there) in enumerate(zip(FEET, pair.present, strict=True)):
            if there:
                values = pair.values[6 * k : 6 * k + 6]
                self._out[foot].publish(self._messages[foot].data(pair.stamp_ns, values))

    def _collect(self, status: Status) -> None:
        counters = self.streams.aligner.counters
        status.values["pair rate (Hz)"] = self._rates.since_last(counters)["pairs"]
        status.values.update(counters)
        self.streams.describe(status)


def main() -> int:
    """Run the node."""
    return run_nodes(PROGRAM, lambda: Graph([TimeSyncNode()]))


if __name__ == "__main__":
    sys.exit(main())
