"""``bringup``: every node from one parameter file, in one process and on one executor."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future
from sensor_msgs.msg import FluidPressure, Imu

from ..core.trajectory import FEET
from ..options import BringupOptions, node_specs
from . import qos
from .fusion import FusionNode
from .imu_adapter import ImuAdapterNode
from .parameters import declare, group
from .pressure import TOPICS
from .replay import ReplayNode
from .shell import Graph, Program, destroy, run_nodes
from .time_sync import TimeSyncNode

QUIET_S = 0.5  # without a result after the end of a bag: that was the last
PROGRAM = Program(
    "bringup",
    "Start imu_adapter for both feet (or replay), time_sync and fusion in one process.",
    "  ros2 run dualfoot_ros bringup --ros-args --params-file config/bringup.yaml\n"
    "  ros2 run dualfoot_ros bringup --ros-args -p bag:=bags/demo -p record:=result",
    tuple(node_specs("bringup")),
)


class BringupNode(Node):
    """Holds the parameters that say which nodes there are."""

    def __init__(self, **options: Any) -> None:
        super().__init__("bringup", **options)
        self.settings = group(BringupOptions, declare(self, node_specs("bringup")))


def build(**options: Any) -> Graph:
    """Make the nodes; a graph with a bag is done a moment after the bag is over.

    Raises
    ------
    DualFootError
        From any of the nodes; those made before it are destroyed.
    """
    nodes: list[Node] = []
    try:
        first = BringupNode(**options)
        nodes.append(first)
        done = _add_nodes(nodes, first.settings, options)
    except BaseException:
        destroy(nodes)
        raise
    return Graph(nodes, done)


def _add_nodes(
    nodes: list[Node], settings: BringupOptions, options: dict[str, Any]
) -> Future | None:
    external = Parameter("sync", Parameter.Type.STRING, "external")
    fusion = FusionNode(**_with(options, external))
    nodes.append(fusion)
    nodes.append(TimeSyncNode(**options))
    if settings.record:
        nodes.append(_recorder(Path(settings.record).expanduser(), fusion, options))
    if settings.bag:
        replay = ReplayNode(**_with(options, Parameter("bag", value=settings.bag)))
        nodes.append(replay)
        return _when_quiet(replay, fusion)
    if settings.adapters:
        space = nodes[0].get_namespace().rstrip("/")
        nodes.extend(_adapter(f"{space}/{foot}", options) for foot in FEET)
    return None


def _adapter(namespace: str, options: dict[str, Any]) -> Node:
    """Make an adapter in its namespace, even where __ns:= is given for the whole process."""
    arguments = [*(options.get("cli_args") or ["--ros-args"]), "-r", f"__ns:={namespace}"]
    return ImuAdapterNode(**{**options, "namespace": namespace, "cli_args": arguments})


def _with(options: dict[str, Any], *parameters: Parameter) -> dict[str, Any]:
    given = options.get("parameter_overrides", [])
    return {**options, "parameter_overrides": [*given, *parameters]}


def _recorder(path: Path, fusion: FusionNode, options: dict[str, Any]) -> Node:
    from .recorder import RecorderNode

    topics: dict[str, Any] = {}
    for foot in FEET:
        topics[f"{foot}/imu/data_raw"] = (Imu, qos.sensor(2000))
        topics[f"{foot}/odometry"] = (Odometry, qos.result(2000))
    if fusion.pressure is not None:
        topics |= {topic: (FluidPressure, qos.sensor(2000)) for topic in TOPICS.values()}
    topics["odometry"] = (Odometry, qos.result(2000))
    topics["fusion/events"] = (DiagnosticArray, qos.latched(200))
    return RecorderNode(path, topics, **options)


def _when_quiet(replay: ReplayNode, fusion: FusionNode) -> Future:
    """Return a future that is done when the bag is over and its last results have come."""
    done: Future = Future()
    steady = Clock(clock_type=ClockType.STEADY_TIME)
    before = -1

    def look() -> None:
        nonlocal before
        if fusion.outputs.published == before and not done.done():
            done.set_result(True)
        before = fusion.outputs.published

    replay.done.add_done_callback(lambda _: replay.create_timer(QUIET_S, look, clock=steady))
    return done


def main() -> int:
    """Run the nodes."""
    return run_nodes(PROGRAM, build)


if __name__ == "__main__":
    sys.exit(main())
