"""Markers for RViz: feet, footprints, the 95 % ellipse of the person, the last constraint."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

import numpy as np
from geometry_msgs.msg import Point, Vector3
from rclpy.node import Node
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from ...core import (
    FEET,
    EventKind,
    FloatArray,
    PersonEstimate,
    Step,
    Update,
    yaw_quaternion,
)
from ..ros import qos
from ..ros.messages import set_pose, set_time

PERIOD_NS = 100_000_000
FOOTPRINTS = 400  # kept; the oldest are dropped
ELLIPSE = 2.4477  # standard deviations of the ellipse that holds 95 %
THINNEST_M = 0.01
COLOURS = {"left": (0.835, 0.369, 0.0), "right": (0.0, 0.447, 0.698)}
"""Of the feet: #D55E00 and #0072B2, as in every other picture."""

YELLOW, GREEN = (0.9, 0.7, 0.1), (0.1, 0.7, 0.3)
SHOE = Vector3(x=0.26, y=0.09, z=0.06)
PRINT = Vector3(x=0.16, y=0.08, z=0.01)


class Markers:
    """Publisher on ``markers``, ten times a second while anybody listens."""

    def __init__(self, node: Node, frame_id: str) -> None:
        """Draw in ``frame_id``."""
        self._frame_id = frame_id
        self._publisher = node.create_publisher(MarkerArray, "markers", qos.result(10))
        self._prints: dict[str, deque[FloatArray]] = {
            foot: deque(maxlen=FOOTPRINTS) for foot in FEET
        }
        self.clear()

    def clear(self) -> None:
        """Forget every footprint."""
        for places in self._prints.values():
            places.clear()
        self._constraint: tuple[FloatArray, FloatArray] | None = None
        self._due_ns = 0

    def add(self, update: Update, person: PersonEstimate, steps: Sequence[Step]) -> None:
        """Take an epoch; publish when it is time and anybody listens."""
        self._note(update, steps)
        if update.stamp_ns >= self._due_ns and self._publisher.get_subscription_count():
            self._due_ns = update.stamp_ns + PERIOD_NS
            self._publisher.publish(self.message(update, person))

    def _note(self, update: Update, steps: Sequence[Step]) -> None:
        for event in update.announced:
            if event.kind is EventKind.HEADING:
                self._prints[event.foot] = deque(
                    (event.turn.positions(place[None])[0] for place in self._prints[event.foot]),
                    maxlen=FOOTPRINTS,
                )
                self._constraint = None
            elif event.kind is EventKind.CONSTRAINT and event.accepted:
                assert update.left is not None and update.right is not None
                self._constraint = update.left.position, update.right.position
        for step in steps:
            self._prints[step.side].append(step.place)

    def message(self, update: Update, person: PersonEstimate) -> MarkerArray:
        """Return the markers of an epoch."""
        assert update.left is not None and update.right is not None
        markers, now_ns = [], update.stamp_ns
        for foot, estimate in (("left", update.left), ("right", update.right)):
            shoe = self._marker("feet", Marker.CUBE, COLOURS[foot], 0.9, now_ns)
            shoe.id, shoe.scale = FEET.index(foot), SHOE
            set_pose(shoe.pose, estimate.position, estimate.quaternion)
            prints = self._marker(
                "footprints", Marker.CUBE_LIST, COLOURS[foot], 0.6, update.stamp_ns
            )
            prints.id, prints.scale = FEET.index(foot), PRINT
            prints.points = [_point(place) for place in self._prints[foot]]
            markers += [shoe, prints] if prints.points else [shoe]
        markers.append(self._ellipse(person))
        if self._constraint is not None:
            line = self._marker(
                "constraint", Marker.LINE_LIST, (0.1, 0.7, 0.3), 1.0, update.stamp_ns
            )
            line.scale.x = 0.02
            line.points = [_point(place) for place in self._constraint]
            markers.append(line)
        return MarkerArray(markers=markers)

    def _ellipse(self, person: PersonEstimate) -> Marker:
        """Return the ellipse of the person's position, flat on the floor."""
        ellipse = self._marker(
            "covariance", Marker.CYLINDER, (0.9, 0.7, 0.1), 0.3, person.stamp_ns
        )
        variance, axes = np.linalg.eigh(person.pose_covariance[:2, :2])
        smaller, greater = (2.0 * ELLIPSE * np.sqrt(np.maximum(variance, 0.0))).tolist()
        x, y = max(greater, THINNEST_M), max(smaller, THINNEST_M)
        ellipse.scale = Vector3(x=x, y=y, z=THINNEST_M)
        angle = math.atan2(float(axes[1, 1]), float(axes[0, 1]))
        set_pose(ellipse.pose, person.position, yaw_quaternion(angle))
        return ellipse

    def _marker(
        self,
        namespace: str,
        kind: int,
        colour: tuple[float, float, float],
        opacity: float,
        stamp_ns: int,
    ) -> Marker:
        red, green, blue = colour
        marker = Marker(ns=namespace, type=kind, action=Marker.ADD)
        marker.header.frame_id = self._frame_id
        set_time(marker.header.stamp, stamp_ns)
        marker.pose.orientation.w = 1.0
        marker.color = ColorRGBA(r=red, g=green, b=blue, a=opacity)
        return marker


def _point(place: FloatArray) -> Point:
    x, y, z = place.tolist()
    return Point(x=x, y=y, z=z)
