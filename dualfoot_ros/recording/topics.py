"""Names of the topics and frames of a recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

IMU_TYPE = "sensor_msgs/msg/Imu"
VECTOR_TYPE = "geometry_msgs/msg/Vector3Stamped"
FIELD_TYPE = "sensor_msgs/msg/MagneticField"
TRUTH_TYPE = "nav_msgs/msg/Odometry"
INCREMENTS_TYPE = "std_msgs/msg/String"
PRESSURE_TYPE = "sensor_msgs/msg/FluidPressure"
DATA_NAMES = ("data_raw", "data_sync", "data")  # of samples, by REP 145 and here
PRESSURE_TOPICS = {"left": "/left/pressure", "right": "/right/pressure", "both": "/pressure"}


@dataclass(frozen=True)
class FootTopics:
    """Topics and frames of one foot.

    ``force`` is the topic of the specific force where ``imu`` has the angular rate only; both are
    then of type Vector3Stamped, or Imu with one half of it filled in.  It is empty otherwise.
    """

    imu: str
    magnetic_field: str
    truth: str
    imu_frame: str
    foot_frame: str
    force: str = ""

    @property
    def samples(self) -> str:
        """The topic or the two topics of the samples, as ``--left-topic`` takes them."""
        return f"{self.force},{self.imu}" if self.force else self.imu

    @property
    def increments(self) -> str:
        """The topic that says what the samples are: beside ``imu``, below it for other names."""
        space, _, name = self.imu.rpartition("/")
        return f"{space if name in DATA_NAMES else self.imu}/increments"


@dataclass(frozen=True)
class Topics:
    """Topics of both feet; the defaults are those of every bag this package writes.

    ``pressure`` goes by where the sensor is worn: on a foot, or on the body for "both".
    """

    left: FootTopics = FootTopics(
        "/left/imu/data_raw", "/left/imu/mag", "/left/ground_truth", "left_imu", "left_foot"
    )
    right: FootTopics = FootTopics(
        "/right/imu/data_raw", "/right/imu/mag", "/right/ground_truth", "right_imu", "right_foot"
    )
    pressure: Mapping[str, str] = field(default_factory=lambda: dict(PRESSURE_TOPICS))

    def of(self, foot: str) -> FootTopics:
        """Return the topics of ``foot``, "left" or "right"."""
        return self.left if foot == "left" else self.right
