"""Topics of the magnetic field of the feet's sensors, as inputs and as outputs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import MagneticField

from ...core import FEET, FloatArray
from ...inspection import Finding
from ...recording import Topics
from ...settings import InputConfig
from ...timing import StampConfig
from ..ros import qos
from ..ros.messages import set_time, to_ns
from ..ros.status import Status
from ..ros.watched_input import WatchedInput
from ..ros.watched_publisher import watched_publisher

TOPICS = {foot: Topics().of(foot).magnetic_field.lstrip("/") for foot in FEET}
Take = Callable[[str, int, list[float]], Any]


class FieldInput(WatchedInput):
    """Subscription to one foot's field; its complaint names the aid that lacks it."""

    def __init__(
        self, node: Node, foot: str, take: Callable[[MagneticField], None], depth: int
    ) -> None:
        """Hand every message to ``take``."""
        super().__init__(node, MagneticField, TOPICS[foot], take, qos.sensor(depth))
        self._foot = foot

    def complaint(self, config: InputConfig) -> Finding | None:
        """Return why nothing came for ``config.silence``, or None when something did."""
        complaint = super().complaint(config)
        if complaint is None:
            return None
        lacking = (
            f"aids.magnetic_heading is on but there is no magnetic field of the {self._foot} foot"
        )
        return complaint._replace(text=f"{lacking}: {complaint.text}")


class FieldInputs:
    """Subscriptions to both feet's fields, stamped as the samples of their feet are.

    A field has no clock of its own: what the stamping adds to the samples it adds to the field.
    """

    def __init__(self, node: Node, take: Take, stamping: StampConfig, depth: int) -> None:
        """``take`` is called with foot, stamp (ns) and field (3,) T."""
        self._take = take
        self._added_ns: dict[str, int | None] = {
            foot: stamping.offset_ns(foot) if stamping.policy(foot) == "header" else None
            for foot in FEET
        }
        self.feet = {foot: FieldInput(node, foot, self._receiver(foot), depth) for foot in FEET}

    @property
    def received(self) -> int:
        """Messages of both feet that have arrived."""
        return sum(watched.received for watched in self.feet.values())

    def stamped(self, foot: str, header_ns: int, stamp_ns: int) -> None:
        """Take the stamp that a sample of ``foot`` was given."""
        self._added_ns[foot] = stamp_ns - header_ns

    def _receiver(self, foot: str) -> Callable[[MagneticField], None]:
        def receive(message: MagneticField) -> None:
            added_ns, b = self._added_ns[foot], message.magnetic_field
            if added_ns is not None:  # the clock of the samples is known
                self._take(foot, to_ns(message.header.stamp) + added_ns, [b.x, b.y, b.z])

        return receive


class FieldOutput:
    """Publisher of one sensor's field; ``sent`` counts the published samples."""

    def __init__(self, node: Node, topic: str, frame_id: str, depth: int) -> None:
        """Publish on ``topic``."""
        self.sent = 0
        self._out = watched_publisher(node, MagneticField, topic, qos.sensor(depth))
        self._message = MagneticField()
        self._message.header.frame_id = frame_id

    def publish(self, stamp_ns: int, tesla: Sequence[float] | FloatArray) -> None:
        """Publish one field (3,) T; its covariance is unknown."""
        message = self._message
        set_time(message.header.stamp, stamp_ns)
        field = message.magnetic_field
        field.x, field.y, field.z = (float(component) for component in tesla)
        self._out.publish(message)
        self.sent += 1

    def describe(self, status: Status) -> None:
        """Add the number of published samples to a status."""
        status.values["magnetic fields"] = self.sent
