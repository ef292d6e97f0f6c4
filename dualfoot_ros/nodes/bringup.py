"""``bringup``: every node from one parameter file, in one process and on one executor."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future
from sensor_msgs.msg import FluidPressure, Imu, MagneticField
from std_msgs.msg import String

from ..core import FEET, DualFootError
from ..settings import BringupConfig, node_specs
from .fusion import FusionNode
from .imu_adapter import ImuAdapterNode
from .inputs.field_topics import TOPICS as MAGNETIC
from .inputs.increments_topics import TOPICS as KINDS
from .inputs.pressure_topics import TOPICS
from .replay import ReplayNode
from .ros import qos
from .ros.declared_parameters import declare, group
from .ros.program import Graph, Program, destroy, run_nodes
from .time_sync import TimeSyncNode

if TYPE_CHECKING:
    from .playback.recorder import RecorderNode

QUIET_S = 0.5  # without progress after the end of the playback: the last result has come
Sensors = ReplayNode | ImuAdapterNode
PROGRAM = Program(
    "bringup",
    "Start imu_adapter for both feet (or replay), time_sync and fusion in one process.",
    "  ros2 run dualfoot_ros bringup --ros-args --params-file config/nodes/bringup.yaml\n"
    "  ros2 run dualfoot_ros bringup --ros-args -p bag:=bags/demo -p record:=result",
    tuple(node_specs("bringup")),
)


class BringupNode(Node):
    """Node that holds the parameters of bringup."""

    def __init__(self, **options: Any) -> None:
        super().__init__("bringup", **options)
        self.settings = group(BringupConfig, declare(self, node_specs("bringup")))


def build(**options: Any) -> Graph:
    """Make the nodes; the graph ends shortly after its bag or the files of both feet.

    It fails when a source has failed for good, which a device that is not there yet has not.

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
    nodes: list[Node], settings: BringupConfig, options: dict[str, Any]
) -> Future | None:
    external = Parameter("sync", Parameter.Type.STRING, "external")
    fusion = FusionNode(**_add_parameters(options, external))
    nodes.append(fusion)
    pairing = TimeSyncNode(**options)
    nodes.append(pairing)
    recorder: RecorderNode | None = None
    if settings.record:
        recorder = _make_recorder(Path(settings.record).expanduser(), fusion, options)
        nodes.append(recorder)
    sensors: list[Sensors] = []
    for sensor in _make_sensors(settings, nodes[0].get_namespace().rstrip("/"), options):
        sensors.append(sensor)
        nodes.append(sensor)
    if not sensors:
        return None

    def progress() -> tuple[int, ...]:
        given = fusion.outputs.published, 0 if recorder is None else recorder.recorded
        return pairing.streams.received, fusion.streams.received, *given

    def report() -> None:
        """Say what was lost since the last report, too."""
        pairing.streams.on_change()
        fusion.streams.on_change()

    return _when_over(sensors, fusion, progress, report)


def _make_sensors(
    settings: BringupConfig, space: str, options: dict[str, Any]
) -> Iterator[Sensors]:
    """Yield the sources of samples, one at a time: those before a bad one must be destroyed."""
    if settings.bag:
        yield ReplayNode(**_add_parameters(options, Parameter("bag", value=settings.bag)))
    elif settings.adapters:
        for foot in FEET:
            yield _make_adapter(f"{space}/{foot}", options)


def _make_adapter(namespace: str, options: dict[str, Any]) -> ImuAdapterNode:
    """Make an adapter in its namespace, even where __ns:= is given for the whole process.

    Raises
    ------
    DualFootError
        From the adapter; names the node.
    """
    arguments = [*(options.get("cli_args") or ["--ros-args"]), "-r", f"__ns:={namespace}"]
    try:
        return ImuAdapterNode(**{**options, "namespace": namespace, "cli_args": arguments})
    except (DualFootError, OSError) as error:
        raise DualFootError(f"{namespace}/imu_adapter: {error}") from None


def _add_parameters(options: dict[str, Any], *parameters: Parameter) -> dict[str, Any]:
    given = options.get("parameter_overrides", [])
    return {**options, "parameter_overrides": [*given, *parameters]}


def _make_recorder(path: Path, fusion: FusionNode, options: dict[str, Any]) -> RecorderNode:
    from .playback.recorder import RecorderNode

    topics: dict[str, Any] = {}
    for foot in FEET:
        topics[f"{foot}/imu/data_raw"] = (Imu, qos.sensor(2000))
        topics[KINDS[foot]] = (String, qos.latched())
        topics[f"{foot}/odometry"] = (Odometry, qos.result(2000))
    if fusion.pressure is not None:
        topics |= {topic: (FluidPressure, qos.sensor(2000)) for topic in TOPICS.values()}
    if fusion.fields is not None:
        topics |= {topic: (MagneticField, qos.sensor(2000)) for topic in MAGNETIC.values()}
    topics["odometry"] = (Odometry, qos.result(2000))
    topics["fusion/events"] = (DiagnosticArray, qos.latched(200))
    return RecorderNode(path, topics, **options)


def _when_over(
    sensors: Sequence[Sensors],
    node: Node,
    progress: Callable[[], tuple[int, ...]],
    report: Callable[[], None],
) -> Future:
    """Return a future that is done when all is played and the last results have come.

    Before that ``report`` is called once more.

    So it is when ``progress``, counts of what nodes have taken and given, has not changed for
    ``QUIET_S``: before the alignment nothing is given, and a recorder may be behind.

    It fails with the first sensor that does.
    """
    done: Future = Future()
    before: tuple[int, ...] = ()

    def look() -> None:
        nonlocal before
        over, failed = _check_ends(sensors)
        now = progress() if over else ()
        if failed is not None:
            done.set_exception(failed)
        elif over and now == before:
            report()
            done.set_result(True)
        before = now

    node.create_timer(QUIET_S, look, clock=Clock(clock_type=ClockType.STEADY_TIME))
    return done


def _check_ends(sensors: Sequence[Sensors]) -> tuple[bool, DualFootError | None]:
    """Return whether all sensors are over, and the error of one that has failed."""
    ended = [sensor for sensor in sensors if sensor.done.done()]
    for sensor in ended:
        if (reason := sensor.done.exception()) is not None:
            name = sensor.get_fully_qualified_name()
            return False, DualFootError(f"{name}: {reason}")
    return len(ended) == len(sensors), None


def main() -> int:
    """Run the nodes."""
    return run_nodes(PROGRAM, build)


if __name__ == "__main__":
    sys.exit(main())
