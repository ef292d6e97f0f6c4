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
    Trajectory,
    quaternion_matrix,
)
from ...evaluation import published_trajectory
from ..results import event_messages
from ..ros import qos
from ..ros.cdr_odometry import OdometryNumbers

DEPTH = 5000
PERSON = "person"


class CollectorNode(Node):
    """Node that keeps the odometry of both feet and the person, and the events, of one fusion.

    ``messages`` are the bytes that came: objects of them all were a quarter of the work of a run.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__("collector", **options)
        self.messages: dict[str, list[bytes]] = {name: [] for name in (*FEET, PERSON)}
        self.events: list[Event] = []
        topics = {foot: f"{foot}/odometry" for foot in FEET} | {PERSON: "odometry"}
        profile = qos.result(DEPTH)
        self._inputs: list[Any] = [
            self.create_subscription(
                Odometry, topic, self.messages[name].append, profile, raw=True
            )
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
        numbers = common_stamps(self.messages)
        left, right = (foot_trajectory(numbers[foot]) for foot in FEET)
        return published_trajectory(
            left,
            right,
            self.events,
            method=method,
            counters=counters,
            relative_covariance=_relative_covariance(left, right, numbers[PERSON]),
        )


def common_stamps(messages: Mapping[str, Sequence[bytes]]) -> dict[str, OdometryNumbers]:
    """Return the numbers of the messages whose stamps all topics have, in the order of time."""
    tables = {
        name: dict(zip(OdometryNumbers(own).stamp_ns.tolist(), own, strict=True))
        for name, own in messages.items()
    }
    stamps = sorted(set.intersection(*map(set, tables.values())))
    return {
        name: OdometryNumbers([table[stamp] for stamp in stamps]) for name, table in tables.items()
    }


def foot_trajectory(numbers: OdometryNumbers) -> FootTrajectory:
    """Return the odometry of a foot, as it was published."""
    to_nav = np.reshape([quaternion_matrix(q) for q in numbers.quaternion], (-1, 3, 3))
    pose, twist = numbers.pose_covariance, numbers.twist_covariance
    return FootTrajectory(
        numbers.stamp_ns,
        numbers.position,
        (to_nav @ numbers.linear[:, :, None])[:, :, 0],
        numbers.quaternion,
        np.zeros(len(numbers.stamp_ns), dtype=bool),
        Covariances.of(pose[:, :3, :3]),
        Covariances.of(to_nav @ twist[:, :3, :3] @ to_nav.transpose(0, 2, 1)),
        Covariances.of(pose[:, 3:, 3:]),
    )


def _relative_covariance(
    left: FootTrajectory, right: FootTrajectory, person: OdometryNumbers
) -> FloatArray:
    """Return the covariance (N, 3, 3) of left minus right position.

    The person is the mean of the feet, so sum and difference of their errors give each other.
    """
    middle = person.pose_covariance[:, :3, :3]
    both = left.position_covariance + right.position_covariance
    relative: FloatArray = 2.0 * both - 4.0 * middle
    relative[:, 2, :] = relative[:, :, 2] = 0.0  # the person's height is that of the floor
    relative[:, 2, 2] = both[:, 2, 2]
    return relative
