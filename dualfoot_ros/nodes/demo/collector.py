"""Collects what fusion publishes and turns it into a trajectory, as a user's program would."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.node import Node

from ...core import (
    FEET,
    Event,
    EventKind,
    FloatArray,
    Trajectory,
    quaternion_matrix,
    to_trajectory,
    turn_rows,
)
from ...core.kernel import layout as at
from ..results import event_messages as events
from ..ros import qos
from ..ros.messages import pose_of, to_ns

DEPTH = 5000


class CollectorNode(Node):
    """Keeps the odometry of both feet and the person, and the events, of one fusion node."""

    def __init__(self, **options: Any) -> None:
        super().__init__("collector", **options)
        self.messages: dict[str, list[Odometry]] = {"left": [], "right": [], "person": []}
        self.events: list[tuple[int, Event]] = []
        topics = {foot: f"{foot}/odometry" for foot in FEET} | {"person": "odometry"}
        profile = qos.result(DEPTH)
        self._inputs: list[Any] = [
            self.create_subscription(Odometry, topic, self.messages[name].append, profile)
            for name, topic in topics.items()
        ]
        self._inputs.append(
            self.create_subscription(
                DiagnosticArray, "fusion/events", self._take_events, qos.latched(DEPTH)
            )
        )

    def _take_events(self, message: DiagnosticArray) -> None:
        stamp_ns = to_ns(message.header.stamp)
        self.events.extend((stamp_ns, event) for event in events.from_message(message))

    def trajectory(self, method: str, counters: Mapping[str, int]) -> Trajectory:
        """Return both tracks, turned by the headings that were announced after the fact."""
        tables = {name: by_stamp(list_) for name, list_ in self.messages.items()}
        stamps = np.array(sorted(set.intersection(*(set(t) for t in tables.values()))), np.int64)
        rows = np.zeros((len(stamps), at.OUT))
        for k, stamp in enumerate(stamps.tolist()):
            fill_row(rows[k], {name: table[stamp] for name, table in tables.items()})
        for stamp, event in self.events:
            if event.kind is EventKind.HEADING:
                turn_rows(rows[: np.searchsorted(stamps, stamp)], event)
        found = tuple(event for _, event in self.events)
        return to_trajectory(stamps, rows, found, counters, method)


def by_stamp(messages: list[Odometry]) -> dict[int, Odometry]:
    """Return messages by their stamps."""
    return {to_ns(message.header.stamp): message for message in messages}


def fill_row(row: FloatArray, messages: Mapping[str, Odometry]) -> None:
    """Put what the messages of one epoch say into an output row (OUT,) of the kernel."""
    covariances = []
    for k, foot in enumerate(FEET):
        part, message = row[k * at.O_FOOT : (k + 1) * at.O_FOOT], messages[foot]
        position, quaternion = pose_of(message.pose.pose)
        part[at.O_POS : at.O_POS + 3] = position
        part[at.O_QUAT : at.O_QUAT + 4] = quaternion
        to_nav, linear = quaternion_matrix(quaternion), message.twist.twist.linear
        part[at.O_VEL : at.O_VEL + 3] = to_nav @ np.array([linear.x, linear.y, linear.z])
        pose = message.pose.covariance.reshape(6, 6)
        twist = to_nav @ message.twist.covariance.reshape(6, 6)[:3, :3] @ to_nav.T
        part[at.O_COV_POS : at.O_COV_POS + 9] = pose[:3, :3].ravel()
        part[at.O_COV_ATT : at.O_COV_ATT + 9] = pose[3:, 3:].ravel()
        part[at.O_COV_VEL : at.O_COV_VEL + 9] = twist.ravel()
        covariances.append(pose[:3, :3])
    # The person is the mean of the feet, so sum and difference of their errors tell each other.
    middle = messages["person"].pose.covariance.reshape(6, 6)[:3, :3]
    relative = 2.0 * (covariances[0] + covariances[1]) - 4.0 * middle
    row[at.O_RELATIVE : at.O_RELATIVE + 9] = relative.ravel()
