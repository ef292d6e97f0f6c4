"""Launch descriptions made of plans: the only module that imports `launch`."""

from __future__ import annotations

import atexit
from functools import partial
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import yaml
from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch_ros.actions import Node

from .graph_plan import ARGUMENTS, PLANS, NodeStart, Start

PUSHED = "ros_namespace"  # where PushRosNamespace keeps it


def describe(name: str) -> LaunchDescription:
    """Return what the launch file ``name`` declares, and does with its arguments."""
    declared = [
        DeclareLaunchArgument(argument, default_value="", description=meaning)
        for argument, meaning in ARGUMENTS[name].items()
    ]
    return LaunchDescription([*declared, OpaqueFunction(function=partial(_start, name=name))])


def _start(context: LaunchContext, *, name: str) -> list[Any]:
    values = context.launch_configurations
    given = {each: values[each] for each in ARGUMENTS[name]}
    around = values.get(PUSHED, "")  # pushed by a launch file around this one
    given["namespace"] = f"{around}/{given['namespace']}".replace("//", "/").strip("/")
    return [_action(start) for start in PLANS[name](given)]


def _action(start: Start) -> Any:
    if not isinstance(start, NodeStart):
        return ExecuteProcess(cmd=list(start.command), output="screen")
    parameters = [*start.files, *_written(start.parameter_file())]
    return Node(
        package=start.package,
        executable=start.executable,
        namespace=f"/{start.namespace}",
        parameters=parameters,
        arguments=list(start.arguments),
        output="screen",
    )


def _written(content: dict[str, Any]) -> list[str]:
    """Write a parameter file and return its path; it goes when the process of the launch ends."""
    if not content:
        return []
    with NamedTemporaryFile("w", prefix="dualfoot_", suffix=".yaml", delete=False) as file:
        atexit.register(Path(file.name).unlink, missing_ok=True)
        yaml.safe_dump(content, file)
    return [file.name]
