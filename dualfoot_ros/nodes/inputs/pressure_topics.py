"""Topics of air pressure: barometers on the feet or on the body, as inputs and as outputs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import FluidPressure

from ...core import PressureSeries
from ...inspection import Finding
from ...recording import PRESSURE_TOPICS
from ...settings import InputConfig
from ..ros import qos
from ..ros.messages import set_time, to_ns
from ..ros.watched_input import WatchedInput
from ..ros.watched_publisher import watched_publisher

TOPICS = {worn: topic.lstrip("/") for worn, topic in PRESSURE_TOPICS.items()}
Take = Callable[[str, int, float], Any]


class PressureInputs:
    """Subscriptions to all pressure topics, of which one that delivers is enough.

    To a :class:`dualfoot_ros.nodes.ros.watched_input.InputMonitor` it is one input.
    """

    def __init__(self, node: Node, take: Take, depth: int) -> None:
        """``take`` is called with where the sensor is worn, stamp (ns) and pressure (Pa)."""
        profile = qos.sensor(depth)
        self._inputs = [
            WatchedInput(node, FluidPressure, topic, _receiver(worn, take), profile)
            for worn, topic in TOPICS.items()
        ]

    @property
    def topic(self) -> str:
        """Names of the topics."""
        return " or ".join(watched.topic for watched in self._inputs)

    @property
    def received(self) -> int:
        """Samples that have arrived."""
        return sum(watched.received for watched in self._inputs)

    @property
    def lost(self) -> int:
        """Samples that were published but have not arrived."""
        return sum(watched.lost for watched in self._inputs)

    def complaint(self, config: InputConfig) -> Finding | None:
        """Return why no sensor delivers, or None when one does; as bad as the best of them."""
        complaints = [watched.complaint(config) for watched in self._inputs]
        reasons = [complaint for complaint in complaints if complaint is not None]
        if len(reasons) < len(complaints):
            return None
        best = min(reasons, key=lambda reason: reason.severity.rank)
        texts = "; ".join(reason.sentence for reason in reasons)
        text = f"aids.barometer is on but there is no air pressure: {texts}"
        return Finding(best.kind, best.severity, text, about="pressure")


def _receiver(worn: str, take: Take) -> Callable[[FluidPressure], None]:
    def receive(message: FluidPressure) -> None:
        take(worn, to_ns(message.header.stamp), message.fluid_pressure)

    return receive


class PressureOutputs:
    """Publishers of recorded pressure; ``sent`` counts the published samples."""

    def __init__(self, node: Node, pressure: dict[str, PressureSeries], depth: int) -> None:
        """Publish for the sensors that ``pressure`` has, by where they are worn."""
        self.sent = 0
        self._out = {
            TOPICS[worn]: watched_publisher(node, FluidPressure, TOPICS[worn], qos.sensor(depth))
            for worn in pressure
        }

    def publish(self, topic: str, stamp_ns: int, pascal: float) -> None:
        """Publish one sample."""
        message = FluidPressure(fluid_pressure=pascal)
        set_time(message.header.stamp, stamp_ns)
        self._out[topic].publish(message)
        self.sent += 1
