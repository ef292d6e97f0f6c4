"""``bringup``, every node in one process; ``--show-args`` lists the arguments.

ros2 launch dualfoot_ros bringup.launch.py params:=mine.yaml page:=true
ros2 launch dualfoot_ros bringup.launch.py bag:=walk record:=result namespace:=anna prefix:=anna/
"""

from launch import LaunchDescription

from dualfoot_ros.nodes.launching.launch_description import describe


def generate_launch_description() -> LaunchDescription:
    """Return bringup, and what shows it."""
    return describe("bringup")
