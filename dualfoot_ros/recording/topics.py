"""Names of the topics and frames of a recording."""

from __future__ import annotations

from dataclasses import dataclass

IMU_TYPE = "sensor_msgs/msg/Imu"
FIELD_TYPE = "sensor_msgs/msg/MagneticField"
TRUTH_TYPE = "nav_msgs/msg/Odometry"


@dataclass(frozen=True)
class FootTopics:
    """Topics and frames of one foot."""

    imu: str
    magnetic_field: str
    truth: str
    imu_frame: str
    foot_frame: str


@dataclass(frozen=True)
class Topics:
    """Topics of both feet; the defaults are those of every bag this package writes."""

    left: FootTopics = FootTopics(
        "/left/imu/data_raw", "/left/imu/mag", "/left/ground_truth", "left_imu", "left_foot"
    )
    right: FootTopics = FootTopics(
        "/right/imu/data_raw", "/right/imu/mag", "/right/ground_truth", "right_imu", "right_foot"
    )

    def of(self, foot: str) -> FootTopics:
        """Return the topics of ``foot``, "left" or "right"."""
        return self.left if foot == "left" else self.right
