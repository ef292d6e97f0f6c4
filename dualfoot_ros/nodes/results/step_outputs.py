"""Steps as messages, and the path of the person: one pose a step and the newest."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Sequence

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from nav_msgs.msg import Path
from rclpy.node import Node

from ...core import Event, EventKind, FloatArray, PersonEstimate, Step, yaw_quaternion
from ...settings import PathConfig
from ..ros import qos
from ..ros.cdr_path import PathBytes, PathPose
from ..ros.messages import set_time
from ..ros.status import OK


def step_message(step: Step) -> DiagnosticArray:
    """Return a step as a message; its values are JSON."""
    values = {
        "detected_ns": step.detected_ns,
        "place": step.place.tolist(),
        "length": step.length,
        "width": step.width,
        "height": step.height,
        "stride": step.stride,
        "duration": step.duration_s,
        "turn": step.turn,
        "length_std": step.length_std,
        "confidence": step.confidence,
    }
    text = f"{step.side} step of {step.length:.2f} m"
    message = DiagnosticArray()
    set_time(message.header.stamp, step.stamp_ns)
    message.status = [
        DiagnosticStatus(
            level=OK,
            name="step",
            hardware_id=step.side,
            message=text,
            values=[KeyValue(key=key, value=json.dumps(value)) for key, value in values.items()],
        )
    ]
    return message


class PersonPath:
    """Poses of the person at the steps, and the newest one."""

    def __init__(self, node: Node, frame_id: str, config: PathConfig) -> None:
        """Publish on ``path`` of ``node``, at most once in ``config.period``."""
        self._period_ns = round(config.period * 1e9)
        self._publisher = node.create_publisher(Path, "path", qos.latched())
        self._bytes = PathBytes(frame_id, config.length - 1)
        self._poses: deque[tuple[int, FloatArray, float]] = deque(maxlen=config.length - 1)
        self.clear()

    def clear(self) -> None:
        """Forget every pose."""
        self._poses.clear()
        self._bytes.replace(())
        self._due_ns = 0

    def add(self, person: PersonEstimate, steps: Sequence[Step], events: Sequence[Event]) -> None:
        """Take the person with the steps and events of an epoch; publish when it is time."""
        for event in events:
            if event.kind is EventKind.HEADING:
                self._turn(event)
        if steps:
            self._poses.append((person.stamp_ns, person.position, person.heading))
            self._bytes.append(_pose(*self._poses[-1]))
        if person.stamp_ns >= self._due_ns:
            self._due_ns = person.stamp_ns + self._period_ns
            self._publisher.publish(self.message(person))

    def _turn(self, event: Event) -> None:
        """Turn the poses with both feet; those before the heading was known are dropped."""
        poses = list(self._poses)
        if not event.turn.joint:
            self._poses.clear()
        elif event.foot == "left" and poses:
            moved = event.turn.positions(np.array([position for _, position, _ in poses]))
            self._poses.clear()
            self._poses.extend(
                (stamp_ns, place, heading + event.turn.yaw)
                for (stamp_ns, _, heading), place in zip(poses, moved, strict=True)
            )
        self._bytes.replace(_pose(*pose) for pose in self._poses)

    def message(self, person: PersonEstimate) -> bytes:
        """Return the path that ends with ``person``, as a message."""
        return self._bytes.data(_pose(person.stamp_ns, person.position, person.heading))


def _pose(stamp_ns: int, position: FloatArray, heading: float) -> PathPose:
    return PathPose(stamp_ns, position, yaw_quaternion(heading))
