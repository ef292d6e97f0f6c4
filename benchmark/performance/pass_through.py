"""Empty node with the topics of ``fusion``: samples in, stamped messages without content out."""

from __future__ import annotations

import sys

import rclpy
from nav_msgs.msg import Odometry, Path
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import Imu

from dualfoot_ros.core import FEET
from dualfoot_ros.nodes.ros import qos

PATH_EVERY, SMOOTHED_EVERY = 200, 4  # samples


class PassThrough(Node):
    """Answers each pair of samples with what ``fusion`` publishes of it, empty but for stamps."""

    def __init__(self) -> None:
        super().__init__("pass_through")
        self._feet = [self.create_publisher(Odometry, f"{f}/odometry", qos.result()) for f in FEET]
        self._person = self.create_publisher(Odometry, "odometry", qos.result())
        self._smoothed = self.create_publisher(Odometry, "odometry/smoothed", qos.result())
        topics = ("left/path", "right/path", "path")
        self._paths = [self.create_publisher(Path, topic, qos.latched()) for topic in topics]
        self._odometry, self._path, self._count = Odometry(), Path(), 0
        self._inputs = [
            self.create_subscription(Imu, f"{foot}/imu/data_raw", take, qos.sensor(400))
            for foot, take in zip(FEET, (self._left, self._right), strict=True)
        ]

    def _left(self, _: Imu) -> None:
        """Wait for the right foot."""

    def _right(self, message: Imu) -> None:
        self._odometry.header.stamp = message.header.stamp
        for publisher in (*self._feet, self._person):
            publisher.publish(self._odometry)
        self._count += 1
        if self._count % SMOOTHED_EVERY == 0:
            self._smoothed.publish(self._odometry)
        if self._count % PATH_EVERY == 0:
            self._path.header.stamp = message.header.stamp
            for publisher in self._paths:
                publisher.publish(self._path)


def main() -> int:
    """Spin until a signal."""
    rclpy.init()
    try:
        rclpy.spin(PassThrough())
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
