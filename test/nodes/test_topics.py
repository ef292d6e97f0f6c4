"""Every topic is in one table with type, rate, frame and meaning, and the displays show no other.

The nodes are asked what they declare, so that the table cannot go stale.
"""

import json
import re
from importlib import import_module, util
from pathlib import Path

import pytest
import yaml
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.live_page import LivePageNode
from dualfoot_ros.nodes.replay import ReplayNode
from dualfoot_ros.nodes.time_sync import TimeSyncNode

from .topics import table

ROOT = Path(__file__).resolve().parents[2]
OF_ROS = {"/rosout", "/parameter_events"}
YOURS = "yours"
HAS_TF = util.find_spec("tf2_msgs") is not None
NEED_TF = {"/tf", "/tf_static"}


def make_all(bench, bag):
    """Make every node with whatever it can publish and take."""
    aids = {"aids.barometer": True, "aids.magnetic_heading": True, "publish_tf": HAS_TF}
    nodes = [
        bench.add(FusionNode, aids),
        bench.add(FusionNode, {"sync": "external"}),
        bench.add(TimeSyncNode),
        bench.add(LivePageNode, {"port": 0}),
        bench.add(ReplayNode, {"bag": str(bag), "play.wait": 3600.0}),
        bench.add(ReplayNode, {"bag": str(bag), "play.wait": 3600.0, "topic": "data_sync"}),
    ]
    return nodes + [bench.add(ImuAdapterNode, namespace=foot) for foot in ("left", "right")]


def declared(nodes, ask):
    """Return topic -> (types, executables), by what ``ask`` tells of a node."""
    found = {}
    for node in nodes:
        for topic, types in ask(nodes[0], node):
            if topic not in OF_ROS:
                relative = topic if topic in absolute() else topic.removeprefix("/")
                known = found.setdefault(relative, (set(), set()))
                known[0].update(types)
                known[1].add(node.get_name())
    return found


def absolute():
    return {name for name in table() if name.startswith("/")}


def publishers(asker, node):
    return asker.get_publisher_names_and_types_by_node(node.get_name(), node.get_namespace())


def subscriptions(asker, node):
    return asker.get_subscriber_names_and_types_by_node(node.get_name(), node.get_namespace())


@pytest.fixture
def nodes(bench, walk_bag):
    made = make_all(bench, walk_bag)
    known = {(node.get_name(), node.get_namespace()) for node in made}
    bench.until(
        lambda: (
            known <= set(made[0].get_node_names_and_namespaces())
            and all(list(publishers(made[0], node)) for node in made)
        ),
        "discovery",
    )
    return made


def test_the_table_has_every_topic_of_every_node_with_its_type(nodes):
    rows = table()
    sent, taken = declared(nodes, publishers), declared(nodes, subscriptions)
    taken.pop("imu", None)  # the default source of an adapter, which is a parameter
    for topic, (types, _) in (sent | taken).items():
        assert topic in rows, topic
        assert types == {rows[topic].type.replace("/", "/msg/")}, topic
    for topic, row in rows.items():
        if topic in NEED_TF and not HAS_TF:
            continue
        own, wanted = sent.get(topic, ((), set()))[1], set(row.published_by) - {YOURS}
        assert own <= wanted, topic
        if not topic.endswith(("mag", "pressure")):  # where the recording or the device has it
            assert own == wanted, topic
        assert taken.get(topic, ((), set()))[1] == set(row.taken_by), topic


def test_the_table_has_the_qos_that_the_nodes_offer(nodes):
    rows = table()
    for topic, row in rows.items():
        for info in nodes[0].get_publishers_info_by_topic(f"/{topic.removeprefix('/')}"):
            profile = info.qos_profile
            reliable = profile.reliability is ReliabilityPolicy.RELIABLE
            latched = profile.durability is DurabilityPolicy.TRANSIENT_LOCAL
            assert row.qos.startswith("reliable" if reliable else "best effort"), topic
            assert ("latched" in row.qos) == latched, topic


def test_every_row_says_rate_frame_and_meaning():
    for topic, row in table().items():
        assert row.rate and row.frame and row.qos and row.meaning, topic


def test_the_frames_of_the_table_are_those_of_the_parameters():
    from dualfoot_ros.settings import FrameConfig

    frames = FrameConfig()
    rows = table()
    assert re.findall("`(.*?)`", rows["odometry"].frame) == [frames.odom, frames.pedestrian]
    assert re.findall("`(.*?)`", rows["left/odometry"].frame) == [
        *(frames.odom, frames.left, frames.right)
    ]


# ---- displays
def published():
    return {topic for topic, row in table().items() if row.published_by - {YOURS}}


def test_the_display_of_rviz_shows_topics_that_fusion_publishes():
    text = (ROOT / "config" / "rviz" / "dualfoot.rviz").read_text(encoding="utf-8")
    manager = yaml.safe_load(text)["Visualization Manager"]
    shown = {d["Topic"]["Value"] for d in manager["Displays"] if "Topic" in d}
    assert {"path", "left/path", "markers", "odometry/smoothed"} <= shown
    assert shown <= published()
    assert manager["Global Options"]["Fixed Frame"] == "odom"


LAYOUT = json.loads((ROOT / "config" / "foxglove" / "dualfoot.json").read_text(encoding="utf-8"))


def panels(kind):
    return [c for name, c in LAYOUT["configById"].items() if name.partition("!")[0] == kind]


def named_paths():
    """Yield every message path of the layout: topic and fields."""
    for plot in panels("Plot"):
        yield from (line["value"] for line in plot["paths"])
    yield from (panel["topicPath"] for panel in panels("RawMessages"))


def leaves(node):
    """Return the panels that the layout shows."""
    if isinstance(node, str):
        return [node]
    return [*leaves(node["first"]), *leaves(node["second"])]


def test_the_layout_of_foxglove_shows_each_of_its_panels_once():
    assert sorted(leaves(LAYOUT["layout"])) == sorted(LAYOUT["configById"])


def test_the_layout_of_foxglove_shows_topics_that_the_nodes_publish():
    (scene,) = panels("3D")
    shown = set(scene["topics"]) | {
        panel["topicToRender"] for panel in panels("DiagnosticSummary")
    }
    shown |= {path.partition(".")[0] for path in named_paths()}
    assert {"/path", "/left/path", "/right/path", "/markers", "/fusion/trust"} <= shown
    known = {f"/{topic.removeprefix('/')}" for topic in published()}
    assert shown - known == set()
    assert scene["publish"]["poseEstimateTopic"] == "/initialpose"
    assert scene["followTf"] == scene["layers"]["grid"]["frameId"] == "odom"


def test_the_markers_of_the_layout_have_the_namespaces_that_fusion_uses():
    from dualfoot_ros.nodes.results import rviz_markers

    (scene,) = panels("3D")
    source = Path(rviz_markers.__file__).read_text(encoding="utf-8")
    assert all(f'"{name}"' in source for name in scene["topics"]["/markers"]["namespaces"])


@pytest.mark.parametrize("path", sorted(named_paths()))
def test_the_fields_that_the_layout_draws_are_in_the_messages(path):
    topic, _, fields = path.partition(".")
    package, _, name = table()[topic.removeprefix("/")].type.partition("/")
    value = getattr(import_module(f"{package}.msg"), name)()
    for field in fields.split("."):
        key, _, index = field.partition("[")
        value = getattr(value, key)
        if index:
            value = value[int(index.rstrip("]"))]
    assert isinstance(value, (float, str))
