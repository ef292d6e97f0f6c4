"""The launch files, in Python and XML: with `launch` where it is installed, else a stand-in.

The stand-in has the classes and keywords of `launch` that the files use, and records them.
"""

import importlib.util
import re
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace
from xml.etree import ElementTree

import pytest
import yaml

from dualfoot_ros.nodes.launching.graph_plan import ARGUMENTS

ROOT = Path(__file__).resolve().parents[3]
LAUNCH = ROOT / "launch"
MODULE = "dualfoot_ros.nodes.launching.launch_description"


class Recorded:
    """An action that remembers how it was made."""

    def __init__(self, *args, **keywords):
        self.args, self.keywords = args, keywords


def stand_in(monkeypatch):
    """Put modules with the names of `launch` in place; return the kinds of actions."""
    names = {
        "launch": ["LaunchContext", "LaunchDescription"],
        "launch.actions": ["DeclareLaunchArgument", "ExecuteProcess", "OpaqueFunction"],
        "launch_ros": [],
        "launch_ros.actions": ["Node"],
    }
    kinds = {}
    for module, classes in names.items():
        made = ModuleType(module)
        for name in classes:
            kinds[name] = type(name, (Recorded,), {})
            setattr(made, name, kinds[name])
        monkeypatch.setitem(sys.modules, module, made)
    monkeypatch.delitem(sys.modules, MODULE, raising=False)
    return SimpleNamespace(**kinds)


@pytest.fixture
def launch(monkeypatch, tmp_path):
    """Return the kinds of actions; what was imported with them is forgotten afterwards."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    yield stand_in(monkeypatch)
    sys.modules.pop(MODULE, None)


def described(name):
    """Return the entities of a launch file."""
    path = LAUNCH / f"{name}.launch.py"
    spec = importlib.util.spec_from_file_location(f"{name}_launch", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.generate_launch_description().args[0]


def run(launch, name, pushed="", **given):
    """Return what a launch file starts with arguments, below a namespace that was pushed."""
    *declared, function = described(name)
    values = {each.args[0]: each.keywords["default_value"] for each in declared}
    assert set(given) <= set(values)
    context = launch.LaunchContext()
    context.launch_configurations = {**values, **given, "ros_namespace": pushed}
    return function.keywords["function"](context)


@pytest.mark.parametrize("name", ARGUMENTS)
def test_a_launch_file_declares_its_arguments_with_what_they_mean(launch, name):
    *declared, function = described(name)
    assert [each.args[0] for each in declared] == list(ARGUMENTS[name])
    assert all(each.keywords["description"] for each in declared)
    assert isinstance(function, launch.OpaqueFunction)
    wanted = {"namespace", "prefix", "method", "use_sim_time", "record", "rviz", "config"}
    assert wanted <= set(ARGUMENTS[name])


def test_arguments_become_nodes_with_parameter_files(launch):
    actions = run(launch, "dualfoot", namespace="anna", method="idc", bag="walk", record="out")
    nodes = {a.keywords["executable"]: a.keywords for a in actions if isinstance(a, launch.Node)}
    assert set(nodes) == {"replay", "time_sync", "fusion"}
    assert {each["namespace"] for each in nodes.values()} == {"/anna"}
    assert {each["package"] for each in nodes.values()} == {"dualfoot_ros"}
    (own,) = nodes["fusion"]["parameters"]
    content = yaml.safe_load(Path(own).read_text())
    assert content["/anna/fusion"]["ros__parameters"]["method"] == "idc"
    (record,) = [a for a in actions if isinstance(a, launch.ExecuteProcess)]
    assert record.keywords["cmd"][:3] == ["ros2", "bag", "record"]


def test_parameter_files_go_with_the_process_of_the_launch(launch, tmp_path, monkeypatch):
    at_exit = []
    monkeypatch.setattr("atexit.register", lambda *call, **how: at_exit.append((call, how)))
    actions = run(launch, "dualfoot", method="idc", bag="walk")
    written = {Path(path) for each in actions for path in each.keywords["parameters"]}
    assert (
        set(tmp_path.iterdir()) == {path for path in written if path.parent == tmp_path} != set()
    )
    for (function, *rest), how in at_exit:
        function(*rest, **how)
    assert list(tmp_path.iterdir()) == []


def test_a_namespace_around_the_launch_file_reaches_nodes_and_parameters(launch):
    (bringup,) = run(launch, "bringup", pushed="/team", namespace="anna", method="idc")
    assert bringup.keywords["namespace"] == "/team/anna"
    content = yaml.safe_load(Path(bringup.keywords["parameters"][0]).read_text())
    assert content["/team/anna/fusion"]["ros__parameters"]["method"] == "idc"
    (alone,) = run(launch, "bringup")
    assert alone.keywords["namespace"] == "/" and alone.keywords["parameters"] == []


def test_bringup_is_one_process_and_its_page_another(launch):
    actions = run(launch, "bringup", page="true", config="liu2023")
    assert [a.keywords["executable"] for a in actions] == ["bringup", "live_page"]
    assert actions[0].keywords["parameters"][0].endswith("liu2023.yaml")


@pytest.mark.parametrize("name", ARGUMENTS)
def test_the_xml_file_has_the_same_arguments_and_hands_on_each_of_them(name):
    root = ElementTree.parse(LAUNCH / f"{name}.launch.xml").getroot()
    assert root.tag == "launch"
    declared = {each.get("name"): each for each in root.findall("arg")}
    meanings = {key: each.get("description") for key, each in declared.items()}
    assert meanings == ARGUMENTS[name]
    assert {each.get("default") for each in declared.values()} == {""}
    (include,) = root.findall("include")
    handed_on = {each.get("name"): each.get("value") for each in include.findall("arg")}
    assert handed_on == {key: f"$(var {key})" for key in ARGUMENTS[name]}
    file = re.fullmatch(r"\$\(find-pkg-share dualfoot_ros\)/(launch/.*)", include.get("file"))
    assert (ROOT / file[1]).name == f"{name}.launch.py" and (ROOT / file[1]).is_file()
    assert {each.tag for each in root.iter()} == {"launch", "arg", "include"}


@pytest.mark.parametrize("kind", ["py", "xml"])
@pytest.mark.parametrize("name", ARGUMENTS)
def test_launch_itself_reads_the_file(name, kind):
    if importlib.util.find_spec("launch_ros") is None:
        pytest.skip("launch is not installed (it comes with ROS 2, there is no wheel)")
    sources = import_module("launch.launch_description_sources")
    source = sources.AnyLaunchDescriptionSource(str(LAUNCH / f"{name}.launch.{kind}"))
    arguments = source.try_get_launch_description_without_context().get_launch_arguments()
    assert [each.name for each in arguments] == list(ARGUMENTS[name])
