"""Transforms between frames from /tf and /tf_static; needs tf2_msgs, which may be absent."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node

from ...core import FloatArray, quaternion_matrix
from ..ros import qos

DEEPEST = 32  # frames between two; more are a circle


@dataclass(frozen=True)
class Transform:
    """Turns coordinates of one frame into those of another: rotation (3, 3) and shift (3,) m."""

    rotation: FloatArray
    shift: FloatArray

    def position(self, point: FloatArray) -> FloatArray:
        """Return a point (3,) m in the other frame."""
        moved: FloatArray = self.rotation @ point + self.shift
        return moved

    @property
    def yaw(self) -> float:
        """Turn about the vertical, rad."""
        return float(np.arctan2(self.rotation[1, 0], self.rotation[0, 0]))

    def after(self, first: Transform) -> Transform:
        """Return the transform that does ``first`` and then this one."""
        return Transform(self.rotation @ first.rotation, self.position(first.shift))

    def inverse(self) -> Transform:
        """Return the way back."""
        return Transform(self.rotation.T, -self.rotation.T @ self.shift)


class FrameTransforms:
    """The newest transform of every frame to its parent."""

    def __init__(self, node: Node) -> None:
        """Listen on /tf and /tf_static where tf2_msgs is installed."""
        self._parents: dict[str, tuple[str, Transform]] = {}
        try:
            from tf2_msgs.msg import TFMessage
        except ImportError:
            self.state = "tf2_msgs is not installed, so there are no transforms"
            return
        self.state = "none has come on /tf or /tf_static"

        def take(message: TFMessage) -> None:
            self.take(message.transforms)

        self._subscriptions = [
            node.create_subscription(TFMessage, "/tf", take, qos.result(100)),
            node.create_subscription(TFMessage, "/tf_static", take, qos.latched(100)),
        ]

    def take(self, transforms: Iterable[TransformStamped]) -> None:
        """Take note of transforms; one that is not finite is passed over."""
        for each in transforms:
            move, q = each.transform.translation, each.transform.rotation
            shift, quaternion = np.array([move.x, move.y, move.z]), np.array([q.x, q.y, q.z, q.w])
            norm = float(np.linalg.norm(quaternion))
            if np.isfinite(shift).all() and np.isfinite(norm) and norm > 0.0:
                rotation = quaternion_matrix(quaternion / norm)
                child = each.child_frame_id.lstrip("/")
                parent = each.header.frame_id.lstrip("/")
                self._parents[child] = (parent, Transform(rotation, shift))

    def find(self, target: str, source: str) -> Transform | None:
        """Return what turns coordinates of ``source`` into those of ``target``, if it is known."""
        to_roots = self._to_ancestors(source)
        for frame, from_target in self._to_ancestors(target).items():
            if frame in to_roots:
                return from_target.inverse().after(to_roots[frame])
        return None

    def _to_ancestors(self, frame: str) -> dict[str, Transform]:
        """Return the transforms from ``frame`` to itself and to each frame above it."""
        found = {frame: Transform(np.eye(3), np.zeros(3))}
        while frame in self._parents and len(found) < DEEPEST:
            parent, up = self._parents[frame]
            if parent in found:
                break
            found[parent] = up.after(found[frame])
            frame = parent
        return found
