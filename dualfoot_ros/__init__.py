"""Two IMUs, one on each foot, to two trajectories: live in ROS 2 and offline."""

__version__ = "0.2.0"
