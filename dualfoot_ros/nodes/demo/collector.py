"""Collector of what fusion publishes; it makes a trajectory of it as a user's program would."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.node import Node

from ...core import (
    FEET,
    Covariances,
    Event,
    FloatArray,
    FootTrajectory,
    IntArray,
    Trajectory,
    quaternion_matrix,
)
from ...evaluation import published_trajectory
from ..results import event_messages
from ..ros import qos
from ..ros.messages import pose_of, to_ns

DEPTH = 5000
PERSON = "person"


class CollectorNode(Node):
    """Node that keeps the odometry of both feet and the person, and the events, of one fusion."""

    def __init__(self, **options: Any) -> None:
        super().__init__("collector", **options)
        self.messages: dict[str, list[Odometry]] = {name: [] for name in (*FEET, PERSON)}
        self.events: list[Event] = []
        topics = {foot: f"{foot}/odometry" for foot in FEET} | {PERSON: "odometry"}
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
        self.events.extend(event_messages.from_message(message))

    def trajectory(self, method: str, counters: Mapping[str, int]) -> Trajectory:
        """Return both tracks, turned by the headings that were announced later.

        Raises
        ------
        EvaluationError
            When there is no stamp at which both feet and the person were published.
        """
        tables = {name: by_stamp(messages) for name, messages in self.messages.items()}
        stamps = np.array(sorted(set.intersection(*map(set, tables.values()))), np.int64)
        rows = {
            name: [table[stamp] for stamp in stamps.tolist()] for name, table in tables.items()
        }
        left, right = (foot_trajectory(stamps, rows[foot]) for foot in FEET)
        return published_trajectory(
            left,
            right,
            self.events,
            method=method,
            counters=counters,
            relative_covariance=_relative_covariance(left, right, rows[PERSON]),
        )


def by_stamp(messages: Sequence[Odometry]) -> dict[int, Odometry]:
    """Return messages by their stamps."""
    return {to_ns(message.header.stamp): message for message in messages}


def foot_trajectory(stamps: IntArray, messages: Sequence[Odometry]) -> FootTrajectory:
    """Return the odometry of a foot, one message a stamp, as it was published."""
    poses = [pose_of(message.pose.pose) for message in messages]
    quaternion = np.reshape([quaternion for _, quaternion in poses], (-1, 4))
    to_nav = np.reshape([quaternion_matrix(q) for q in quaternion], (-1, 3, 3))
    pose = _covariances([message.pose.covariance for message in messages])
    twist = _covariances([message.twist.covariance for message in messages])
    velocity = np.reshape([_linear(message) for message in messages], (-1, 3, 1))
    return FootTrajectory(
        stamps,
        np.reshape([position for position, _ in poses], (-1, 3)),
        (to_nav @ velocity)[:, :, 0],
        quaternion,
        np.zeros(len(stamps), dtype=bool),
        Covariances.of(pose[:, :3, :3]),
        Covariances.of(to_nav @ twist[:, :3, :3] @ to_nav.transpose(0, 2, 1)),
        Covariances.of(pose[:, 3:, 3:]),
    )


def _covariances(cells: Sequence[FloatArray]) -> FloatArray:
    return np.reshape(cells, (-1, 6, 6)).astype(np.float64)


def _linear(message: Odometry) -> tuple[float, float, float]:
    linear = message.twist.twist.linear
    return linear.x, linear.y, linear.z


def _relative_covariance(
    left: FootTrajectory, right: FootTrajectory, person: Sequence[Odometry]
) -> FloatArray:
    """Return the covariance (N, 3, 3) of left minus right position.

    The person is the mean of the feet, so sum and difference of their errors give each other.
    """
    middle = _covariances([message.pose.covariance for message in person])[:, :3, :3]
    both = left.position_covariance + right.position_covariance
    relative: FloatArray = 2.0 * both - 4.0 * middle
    relative[:, 2, :] = relative[:, :, 2] = 0.0  # the person's height is that of the floor
    relative[:, 2, 2] = both[:, 2, 2]
    return relative
