"""The nodes of bringup as processes of their own, for a stock ROS 2 installation.

ros2 launch dualfoot_ros dualfoot.launch.py left:=/imu_a/data right:=/imu_b/data
ros2 launch dualfoot_ros dualfoot.launch.py bag:=bags/demo params:=mine.yaml
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, PythonExpression
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

PACKAGE = "dualfoot_ros"


def generate_launch_description() -> LaunchDescription:
    """Return the adapters or replay, time_sync and fusion, with what can be said about them."""
    params = LaunchConfiguration("params")
    plays = PythonExpression(["'", LaunchConfiguration("bag"), "' != ''"])
    default = PathJoinSubstitution([FindPackageShare(PACKAGE), "config", "default.yaml"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("params", default_value=default, description="parameter file"),
            DeclareLaunchArgument("left", default_value="/left/imu/data", description="its topic"),
            DeclareLaunchArgument(
                "right", default_value="/right/imu/data", description="likewise"
            ),
            DeclareLaunchArgument("bag", default_value="", description="play this bag instead"),
            *(_adapter(foot, params, UnlessCondition(plays)) for foot in ("left", "right")),
            _node("replay", [params, {"bag": LaunchConfiguration("bag")}], IfCondition(plays)),
            _node("time_sync", [params]),
            _node("fusion", [params, {"sync": "external"}]),
        ]
    )


def _node(executable: str, parameters: list, condition: IfCondition | None = None) -> Node:
    return Node(
        package=PACKAGE,
        executable=executable,
        parameters=parameters,
        condition=condition,
        output="screen",
    )


def _adapter(foot: str, params: LaunchConfiguration, condition: UnlessCondition) -> Node:
    return Node(
        package=PACKAGE,
        executable="imu_adapter",
        namespace=foot,
        parameters=[params, {"source": ["topic://", LaunchConfiguration(foot)]}],
        condition=condition,
        output="screen",
    )
