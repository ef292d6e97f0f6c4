"""Input ``initialpose``: where the person is, in the frame of the trajectories or another one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node

from ...core import ConfigError, FloatArray, about_z
from ..ros import qos
from ..ros.messages import pose_covariance, pose_yaw
from .frame_transforms import FrameTransforms

SetPose = Callable[[list[float], float, FloatArray | None], None]


class InitialPose:
    """Subscription to ``initialpose``; poses that cannot be used are refused with a warning."""

    def __init__(self, node: Node, frame_id: str, set_pose: SetPose) -> None:
        """Call ``set_pose`` with position (m), yaw (rad) and covariance (4, 4) in ``frame_id``.

        The covariance is None where the message has none.
        """
        self._log, self._frame_id, self._set_pose = node.get_logger(), frame_id, set_pose
        self.transforms = FrameTransforms(node)
        self._subscription = node.create_subscription(
            PoseWithCovarianceStamped, "initialpose", self.receive, qos.result(1)
        )

    def receive(self, message: PoseWithCovarianceStamped) -> None:
        """Take a message."""
        pose = pose_yaw(message.pose.pose)
        if pose is None:
            self._log.warning("initialpose is not finite and was ignored")
            return
        frame = message.header.frame_id or self._frame_id
        moved = self.transforms.find(self._frame_id, frame)
        if moved is None:
            self._log.warning(
                f"initialpose is in frame '{frame}' and was ignored; allowed is "
                f"'{self._frame_id}', or a frame with a transform to it ({self.transforms.state})"
            )
            return
        position, yaw = moved.position(pose[0]), pose[1] + moved.yaw
        covariance = pose_covariance(message.pose.covariance)
        if covariance is not None:
            turn = np.eye(4)
            turn[:3, :3] = about_z(moved.yaw)
            covariance = turn @ covariance @ turn.T
        try:
            self._set_pose(position.tolist(), yaw, covariance)
        except ConfigError as error:
            self._log.warning(f"initialpose was ignored: {error}")
            return
        self._log.info(f"pose set to {position.round(3).tolist()} m, heading {yaw:.3f} rad")
