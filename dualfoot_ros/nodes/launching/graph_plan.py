"""Processes of a launch file, from its arguments; plain values, without `launch`.

An argument that is empty is not given: what the parameter files say holds, and else the default.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...core import FEET, ConfigError
from ...settings import PAGE_PORT, FrameConfig, find_config

PACKAGE = "dualfoot_ros"
FLAGS = {"true": True, "1": True, "false": False, "0": False}
RVIZ = "rviz/dualfoot.rviz"
COMMON = {
    "config": "preset (liu2023 ...) or parameter file, read first",
    "params": "parameter file, whose values win over those of config",
    "namespace": "namespace of all nodes and topics, as anna",
    "prefix": "put before the names of the frames, as anna/",
    "method": "method of the tracker; wins over the files",
    "use_sim_time": "true or false; wins over the files",
    "bag": "play this bag in place of sensors",
    "record": "write what is received and published to this new bag",
    "rviz": "true: start RViz with the display of this package",
    "page": f"true, or a port: show the walk in a browser (true: port {PAGE_PORT})",
}
TOPICS = {foot: f"topic of the {foot} sensor (default: /{foot}/imu/data)" for foot in FEET}
ARGUMENTS = {"dualfoot": {**COMMON, **TOPICS}, "bringup": COMMON}
"""Arguments of each launch file, with what they mean; the default of each is empty."""

INSIDE = (
    *("bringup", "fusion", "time_sync", "replay", "recorder"),
    *(f"{foot}/imu_adapter" for foot in FEET),
)
RECORDED = (
    *(f"{foot}/{topic}" for foot in FEET for topic in ("imu/data_raw", "odometry", "path")),
    *(f"{foot}/imu/increments" for foot in FEET),
    *("odometry", "path", "steps", "fusion/events", "fusion/trust", "/diagnostics"),
)


@dataclass(frozen=True)
class NodeStart:
    """A process with nodes: parameter files, and ``parameters`` that win over them.

    ``inside`` are the nodes of the process, where there are others than that of its name.
    """

    executable: str
    namespace: str = ""
    files: tuple[str, ...] = ()
    parameters: Mapping[str, Any] = field(default_factory=dict)
    arguments: tuple[str, ...] = ()
    inside: tuple[str, ...] = ()
    package: str = PACKAGE

    def parameter_file(self) -> dict[str, Any]:
        """Return a parameter file that wins over ``files`` when it is read after them.

        It names each node in full: a section for `/**` would lose against one of a file before
        it that names the node.
        """
        root = f"/{self.namespace}" if self.namespace else ""
        nodes = self.inside or (self.executable,)
        if not self.parameters:
            return {}
        # A mapping for each node: YAML would name one that is shared, and rcl reads no names.
        return {f"{root}/{node}": {"ros__parameters": dict(self.parameters)} for node in nodes}


@dataclass(frozen=True)
class CommandStart:
    """A process of another program."""

    command: tuple[str, ...]


Start = NodeStart | CommandStart
Plan = Callable[[Mapping[str, str]], list[Start]]


def separate_nodes(arguments: Mapping[str, str]) -> list[Start]:
    """Return the nodes as processes of their own, as of ``dualfoot.launch.py``.

    Raises
    ------
    ConfigError
        For an argument that cannot be used.
    """
    given = {name: value for name, value in arguments.items() if value}
    space, files, common = given.get("namespace", "").strip("/"), _files(given), _common(given)
    starts = list(_sensors(given, space, files, common))
    starts.append(NodeStart("time_sync", space, files, common))
    fusion = {**common, **_tracking(given), "sync": "external"}
    starts.append(NodeStart("fusion", space, files, fusion))
    if "record" in given:
        starts.append(_recorder(given["record"], space, common))
    return [*starts, *_displays(given, space, common)]


def one_process(arguments: Mapping[str, str]) -> list[Start]:
    """Return ``bringup`` with everything in it, as of ``bringup.launch.py``.

    Raises
    ------
    ConfigError
        For an argument that cannot be used.
    """
    given = {name: value for name, value in arguments.items() if value}
    space, common = given.get("namespace", "").strip("/"), _common(given)
    own = {name: given[name] for name in ("bag", "record") if name in given}
    parameters = common | _tracking(given) | own
    bringup = NodeStart("bringup", space, _files(given), parameters, inside=INSIDE)
    return [bringup, *_displays(given, space, common)]


PLANS: Mapping[str, Plan] = {"dualfoot": separate_nodes, "bringup": one_process}


def _files(given: Mapping[str, str]) -> tuple[str, ...]:
    config = [str(find_config(given["config"]))] if "config" in given else []
    params = [str(Path(given["params"]).expanduser())] if "params" in given else []
    if params and not Path(params[0]).is_file():
        raise ConfigError(f"argument 'params': there is no file '{params[0]}'")
    return (*config, *params)


def _common(given: Mapping[str, str]) -> dict[str, Any]:
    """Return the parameters that every node takes."""
    if "use_sim_time" not in given:
        return {}
    return {"use_sim_time": _flag("use_sim_time", given["use_sim_time"])}


def _tracking(given: Mapping[str, str]) -> dict[str, Any]:
    """Return the parameters of fusion."""
    names = {"method": "method", "prefix": "frames.prefix"}
    return {own: given[name] for name, own in names.items() if name in given}


def _sensors(
    given: Mapping[str, str], space: str, files: tuple[str, ...], common: Mapping[str, Any]
) -> Iterator[Start]:
    if "bag" in given:
        yield NodeStart("replay", space, files, {**common, "bag": given["bag"]})
        return
    for foot in FEET:
        source = f"topic://{given.get(foot, f'/{foot}/imu/data')}"
        inner = f"{space}/{foot}" if space else foot
        yield NodeStart("imu_adapter", inner, files, {**common, "source": source})


def _recorder(path: str, space: str, common: Mapping[str, Any]) -> Start:
    root = f"/{space}" if space else ""
    topics = [name if name.startswith("/") else f"{root}/{name}" for name in RECORDED]
    simulated = ["--use-sim-time"] if common.get("use_sim_time") else []
    command = ["ros2", "bag", "record", "--storage", "mcap", "--output", path]
    return CommandStart((*command, *simulated, "--topics", *topics))


def _displays(given: Mapping[str, str], space: str, common: Mapping[str, Any]) -> Iterator[Start]:
    if _flag("rviz", given.get("rviz", "false")):
        display = find_config("default").parent / RVIZ
        frame = given.get("prefix", "") + FrameConfig().odom
        shown = ["--display-config", str(display), "--fixed-frame", frame]
        if common.get("use_sim_time"):
            shown += ["--ros-args", "-p", "use_sim_time:=true"]
        yield NodeStart("rviz2", space, arguments=tuple(shown), package="rviz2")
    page = _page(given.get("page", "false"))
    if page is not None:
        yield NodeStart("live_page", space, (), {"port": page})


def _page(value: str) -> int | None:
    """Return the port of the live page, or None when it is not wanted."""
    if value.isdigit() and value not in FLAGS:
        return int(value)
    return PAGE_PORT if _flag("page", value) else None


def _flag(name: str, value: str) -> bool:
    if value.lower() not in FLAGS:
        raise ConfigError(f"argument '{name}' is '{value}'; allowed is true or false")
    return FLAGS[value.lower()]
