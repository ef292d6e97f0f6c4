"""Launch arguments: each of them reaches the parameters of the nodes, and wins over the files."""

import pytest
import yaml

from dualfoot_ros.core import ConfigError
from dualfoot_ros.nodes.launching.graph_plan import (
    ARGUMENTS,
    PLANS,
    RECORDED,
    NodeStart,
    one_process,
    separate_nodes,
)


def started(plan, executable):
    """Return the starts of an executable."""
    return [s for s in plan if isinstance(s, NodeStart) and s.executable == executable]


def parameters(plan, executable):
    (start,) = started(plan, executable)
    return start.parameters


def command_of(plan):
    (command,) = [s.command for s in plan if not isinstance(s, NodeStart)]
    return command


@pytest.mark.parametrize("name", PLANS)
def test_nothing_given_starts_the_nodes_as_they_are(name):
    plan = PLANS[name](dict.fromkeys(ARGUMENTS[name], ""))
    own = {"bringup": {"bringup"}, "dualfoot": {"imu_adapter", "time_sync", "fusion"}}
    assert {start.executable for start in plan} == own[name]
    assert all(start.files == () and start.namespace in ("", "left", "right") for start in plan)


def test_sensors_are_two_adapters_on_the_topics_given():
    left, right = started(separate_nodes({"left": "/imu_a/data"}), "imu_adapter")
    assert (left.namespace, left.parameters["source"]) == ("left", "topic:///imu_a/data")
    assert (right.namespace, right.parameters["source"]) == ("right", "topic:///right/imu/data")


def test_a_bag_is_played_in_place_of_the_sensors():
    plan = separate_nodes({"bag": "walk"})
    assert parameters(plan, "replay")["bag"] == "walk"
    assert started(plan, "imu_adapter") == []
    assert parameters(one_process({"bag": "walk"}), "bringup")["bag"] == "walk"


@pytest.mark.parametrize("plan", PLANS.values())
def test_method_prefix_and_simulated_time_are_parameters(plan):
    given = {"method": "idc", "prefix": "anna/", "use_sim_time": "true"}
    node = "bringup" if plan is one_process else "fusion"
    found = parameters(plan(given), node)
    assert found["method"] == "idc"
    assert found["frames.prefix"] == "anna/"
    assert found["use_sim_time"] is True


def test_every_node_has_the_simulated_time():
    plan = separate_nodes({"use_sim_time": "true", "bag": "walk", "rviz": "true", "record": "out"})
    for start in plan:
        if not isinstance(start, NodeStart):
            assert "--use-sim-time" in start.command
        elif start.executable == "rviz2":
            assert start.arguments[-1] == "use_sim_time:=true"
        else:
            assert start.parameters["use_sim_time"] is True


@pytest.mark.parametrize("plan", PLANS.values())
def test_a_namespace_moves_every_node(plan):
    starts = plan({"namespace": "/anna/", "rviz": "true", "page": "true"})
    assert all(start.namespace.split("/")[0] == "anna" for start in starts)
    assert {s.namespace for s in started(starts, "imu_adapter")} <= {"anna/left", "anna/right"}


def test_a_recording_has_the_topics_of_the_namespace():
    command = command_of(separate_nodes({"record": "out", "namespace": "anna"}))
    assert command[command.index("--output") + 1] == "out"
    assert "/anna/left/odometry" in command and "/diagnostics" in command
    assert "record" in one_process({"record": "out"})[0].parameters


def test_recorded_topics_are_in_the_table_of_topics():
    from ..topics import table

    known = set(table())
    assert [name for name in RECORDED if name not in known] == []


def test_a_preset_is_read_before_the_parameter_file(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("/**:\n  ros__parameters:\n    method: idc\n")
    (start,) = one_process({"config": "liu2023", "params": str(path)})
    assert [name.rpartition("/")[2] for name in start.files] == ["liu2023.yaml", "mine.yaml"]


def test_rviz_shows_the_display_of_the_package_in_the_frame_that_is_used():
    (rviz,) = started(one_process({"rviz": "true", "prefix": "anna/"}), "rviz2")
    words = rviz.arguments
    assert words[words.index("--display-config") + 1].endswith("config/rviz/dualfoot.rviz")
    assert words[words.index("--fixed-frame") + 1] == "anna/odom"
    assert rviz.package == "rviz2"


@pytest.mark.parametrize(("page", "port"), [("true", 8770), ("9000", 9000)])
def test_a_page_is_served_on_its_port(page, port):
    assert parameters(one_process({"page": page}), "live_page")["port"] == port


def test_no_page_and_no_rviz_are_started_when_they_are_not_wanted():
    assert len(one_process({"page": "false", "rviz": "False"})) == 1


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"use_sim_time": "maybe"}, "'use_sim_time' is 'maybe'; allowed is true or false"),
        ({"rviz": "yes"}, "'rviz' is 'yes'"),
        ({"page": "here"}, "'page' is 'here'"),
        ({"config": "lui2023"}, "unknown preset 'lui2023'"),
        ({"params": "/no/such.yaml"}, "there is no file '/no/such.yaml'"),
    ],
)
def test_an_argument_that_cannot_be_used_is_one_sentence(given, said):
    with pytest.raises(ConfigError, match=said.replace("(", r"\(")):
        one_process(given)


@pytest.mark.parametrize("section", ["/**", "/**/fusion", "/anna/fusion"])
def test_arguments_win_over_a_file_however_it_names_the_node(tmp_path, section):
    rclpy = pytest.importorskip("rclpy")
    from dualfoot_ros.nodes.fusion import FusionNode

    mine = tmp_path / "mine.yaml"
    values = {"method": "zupt", "frames": {"prefix": "bob/"}, "person.window": 2.0}
    mine.write_text(yaml.safe_dump({section: {"ros__parameters": values}}))
    arguments = {"namespace": "anna", "method": "idc", "prefix": "anna/", "params": str(mine)}
    (start,) = started(separate_nodes(arguments), "fusion")
    own = tmp_path / "own.yaml"
    own.write_text(yaml.safe_dump(start.parameter_file()))
    words = [word for file in (*start.files, own) for word in ("--params-file", str(file))]
    context = rclpy.Context()
    rclpy.init(context=context)
    try:
        node = FusionNode(
            context=context, namespace=start.namespace, cli_args=["--ros-args", *words]
        )
        assert node.get_parameter("method").value == "idc"
        assert node.get_parameter("frames.prefix").value == "anna/"
        assert node.get_parameter("sync").value == "external"
        assert node.get_parameter("person.window").value == 2.0
        node.destroy_node()
    finally:
        rclpy.try_shutdown(context=context)


def test_arguments_reach_the_nodes_inside_of_bringup(tmp_path):
    rclpy = pytest.importorskip("rclpy")
    from dualfoot_ros.nodes.bringup import build
    from dualfoot_ros.nodes.ros.program import destroy

    (start,) = one_process({"namespace": "anna", "method": "idc", "use_sim_time": "true"})
    own = tmp_path / "own.yaml"
    own.write_text(yaml.safe_dump(start.parameter_file()))
    words = ["", "--ros-args", "-r", "__ns:=/anna", "--params-file", str(own)]
    context = rclpy.Context()
    rclpy.init(args=words, context=context)
    try:
        graph = build(context=context)
        nodes = {node.get_fully_qualified_name(): node for node in graph.nodes}
        assert nodes["/anna/fusion"].get_parameter("method").value == "idc"
        assert "/anna/left/imu_adapter" in nodes
        assert all(node.get_parameter("use_sim_time").value for node in graph.nodes)
        destroy(graph.nodes)
    finally:
        rclpy.try_shutdown(context=context)
