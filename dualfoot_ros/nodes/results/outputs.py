"""Outputs of fusion for one update: odometry of feet and person, paths, events, frames."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from nav_msgs.msg import Path as PathMessage
from rclpy.node import Node

from ...core import FEET, ConfigError, EventKind, Update
from ...settings import FrameConfig, PathConfig, PersonConfig
from ..ros import qos
from ..ros.cdr_odometry import OdometryBytes
from ..ros.messages import fill_foot, set_time
from . import event_messages
from .foot_path import FootPath
from .person_outputs import PersonOutputs

EVENTS_KEPT = 200


class Outputs:
    """Publishers of the node ``fusion``, and the messages that are filled for every update.

    ``published`` counts the updates with an estimate, ``messages`` those of odometry that they
    gave.
    """

    def __init__(
        self,
        node: Node,
        frames: FrameConfig,
        path: PathConfig,
        person: PersonConfig,
        gyro_density: float,
        *,
        tf: bool,
    ) -> None:
        """``gyro_density`` (rad/s/sqrt(Hz)) gives the noise of the published angular rate."""
        children = {"left": frames.left, "right": frames.right}
        self._gyro_density = gyro_density
        self._feet = {f: OdometryBytes(frames.odom, children[f]) for f in FEET}
        self.person = PersonOutputs(node, frames, person, path)
        self._odometry = {
            f: node.create_publisher(Odometry, f"{f}/odometry", qos.result()) for f in FEET
        }
        self._paths = {f: FootPath(f, frames.odom, path.length, path.period) for f in FEET}
        self._path_publishers = {
            f: node.create_publisher(PathMessage, f"{f}/path", qos.latched()) for f in FEET
        }
        self._events = node.create_publisher(DiagnosticArray, "~/events", qos.latched(EVENTS_KEPT))
        self._tf = FrameBroadcaster(node) if tf else None
        self._last_ns: int | None = None
        self.published = self.messages = 0

    def publish(self, update: Update, present: tuple[bool, bool] = (True, True)) -> None:
        """Publish the estimates and events of ``update``, of the feet that are ``present``.

        What was estimated late, where a track starts without a stand, has its part in the events,
        the steps and the paths; odometry that is seconds old is of no use.
        """
        for before in update.earlier:
            self._catch_up(before)
        self._announce(update)
        if update.row is None:
            return
        variance = self._rate_variance(update.stamp_ns)
        feet = [foot for foot, there in zip(FEET, present, strict=True) if there]
        for foot in feet:
            self._publish_foot(foot, update, variance)
        self.person.publish(update)
        if self._tf is not None:
            self._tf.publish([self.person.message, *(self._feet[foot] for foot in feet)])
        self.published += 1
        self.messages += 1 + len(feet)

    def _announce(self, update: Update) -> None:
        """Publish the events of an update, if it has some."""
        if update.announced:
            self._events.publish(event_messages.to_message(update.announced, update.stamp_ns))
            if any(event.kind is EventKind.RESET for event in update.announced):
                self.clear()

    def _catch_up(self, update: Update) -> None:
        """Take an update whose time is past."""
        self._announce(update)
        for foot, there in zip(FEET, update.present, strict=True):
            estimate = update.left if foot == "left" else update.right
            if there and estimate is not None:
                self._paths[foot].add(update.stamp_ns, estimate, update.announced)
        self.person.catch_up(update)

    def _publish_foot(self, foot: str, update: Update, rate_variance: float) -> None:
        estimate = update.left if foot == "left" else update.right
        assert estimate is not None
        message, path, stamp_ns = self._feet[foot], self._paths[foot], update.stamp_ns
        fill_foot(message, stamp_ns, estimate, rate_variance)
        self._odometry[foot].publish(message.data())
        path.add(stamp_ns, estimate, update.announced)
        if path.due(stamp_ns):
            self._path_publishers[foot].publish(path.message())

    def clear(self) -> None:
        """Forget the track: the paths and the person."""
        self.person.clear()
        for path in self._paths.values():
            path.clear()

    def _rate_variance(self, stamp_ns: int) -> float:
        """Return the variance of one angular rate at the present sampling interval."""
        before, self._last_ns = self._last_ns, stamp_ns
        interval_s = 5e-3 if before is None else max(1e-4, (stamp_ns - before) * 1e-9)
        return self._gyro_density**2 / interval_s


class FrameBroadcaster:
    """Publisher of frames on /tf; needs tf2_msgs, which not every installation has.

    Raises
    ------
    ConfigError
        When it cannot be imported.
    """

    def __init__(self, node: Node) -> None:
        try:
            from tf2_msgs.msg import TFMessage
        except ImportError:
            raise ConfigError(
                "parameter 'publish_tf' is true, but tf2_msgs cannot be imported; install "
                "ros-jazzy-tf2-msgs, or leave publish_tf false and use the odometry topics"
            ) from None
        self._new: Any = TFMessage
        self._publisher = node.create_publisher(TFMessage, "/tf", qos.result(100))

    def publish(self, odometry: Sequence[OdometryBytes]) -> None:
        """Send the pose of each message as a frame."""
        self._publisher.publish(
            self._new(transforms=[_to_transform(message) for message in odometry])
        )


def _to_transform(odometry: OdometryBytes) -> TransformStamped:
    message = TransformStamped(child_frame_id=odometry.child_frame_id)
    message.header.frame_id = odometry.frame_id
    set_time(message.header.stamp, odometry.stamp_ns)
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = odometry.position.tolist()
    rotation.x, rotation.y, rotation.z, rotation.w = odometry.quaternion.tolist()
    return message
