"""The nodes as processes of their own; ``--show-args`` lists the arguments.

ros2 launch dualfoot_ros dualfoot.launch.py left:=/imu_a/data right:=/imu_b/data
ros2 launch dualfoot_ros dualfoot.launch.py bag:=walk config:=liu2023 rviz:=true
"""

from launch import LaunchDescription

from dualfoot_ros.nodes.launching.launch_description import describe


def generate_launch_description() -> LaunchDescription:
    """Return the adapters or replay, time_sync and fusion, and what shows or records them."""
    return describe("dualfoot")
