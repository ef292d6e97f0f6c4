"""Topics of other names are found where the usual ones are not published, and said in one line."""

import pytest
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.inputs.topic_search import PATIENCE
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.time_sync import TimeSyncNode
from nodes.samples import imu

pytestmark = pytest.mark.usefixtures("clock")


class Log:
    """Collects what a node logs."""

    def __init__(self, node, monkeypatch):
        self.lines = []
        for level in ("info", "warning"):
            monkeypatch.setattr(node.get_logger(), level, self.lines.append)
        monkeypatch.setattr(node, "get_logger", lambda: self)

    def info(self, text):
        self.lines.append(text)

    warning = info


@pytest.fixture
def graph(bench, monkeypatch):
    """Start a node among publishers of Imu topics, and let it look until its patience ends."""

    def start(*topics, kind=FusionNode, **options):
        others = bench.plain()
        publishers = {t: others.create_publisher(Imu, t, qos.sensor(10)) for t in topics}
        node = bench.add(kind, **options)
        bench.until(lambda: all(map(node.count_publishers, topics)), "discovery")
        log = Log(node, monkeypatch)
        search = node.streams.search if hasattr(node, "streams") else node.search
        for _ in range(PATIENCE + 2 if search is not None else 0):
            search.look()
        return node, publishers, [line for line in log.lines if "publishes" in line]

    return start


@pytest.mark.parametrize("kind", [FusionNode, TimeSyncNode])
def test_two_topics_with_fitting_names_are_taken_and_said_in_one_line(graph, bench, kind):
    node, publishers, lines = graph("/imu_left/data", "/imu_right/data", "/body/imu", kind=kind)
    assert node.streams.search.taken == {"left": "/imu_left/data", "right": "/imu_right/data"}
    assert len(lines) == 1
    assert "taking /imu_left/data as left and /imu_right/data as right" in lines[0]
    out = publishers["/imu_left/data"]
    bench.until(out.get_subscription_count, "the subscription")
    out.publish(imu(10**9))
    bench.until(lambda: node.streams.inputs["left"].received == 1, "the sample")


def test_names_that_say_no_foot_are_listed_with_how_to_choose(graph):
    node, _, lines = graph("/imu_a", "/imu_b")
    assert node.streams.search.taken == {}
    assert len(lines) == 1
    assert "/imu_a, /imu_b" in lines[0]
    assert "-r left/imu/data_raw:=/TOPIC -r right/imu/data_raw:=/TOPIC" in lines[0]


def test_two_topics_of_one_foot_are_not_guessed_between(graph):
    node, _, (line,) = graph("/left/imu/a", "/left/imu/b", "/right/imu/a")
    assert node.streams.search.taken == {}
    assert "/left/imu/a, /left/imu/b, /right/imu/a" in line


def test_topics_that_are_published_as_usual_are_left_alone(graph):
    node, _, lines = graph("/left/imu/data_raw", "/right/imu/data_raw", "/imu_left", "/imu_right")
    assert node.streams.search.taken == {}
    assert lines == []
    assert node.streams.inputs["left"].topic == "/left/imu/data_raw"


def test_a_topic_that_was_chosen_by_a_remap_is_left_alone(graph):
    remaps = ["--ros-args", "-r", "left/imu/data_raw:=/mine", "-r", "right/imu/data_raw:=/other"]
    node, _, lines = graph("/imu_left", "/imu_right", cli_args=remaps)
    assert node.streams.search.taken == {}
    assert lines == []
    assert node.streams.inputs["left"].topic == "/mine"


def test_an_adapter_without_a_source_takes_the_topic_that_says_its_foot(graph):
    topics = ("/imu_left/data", "/imu_right/data", "/right/imu/data_raw")
    node, _, (line,) = graph(*topics, kind=ImuAdapterNode, namespace="/right")
    assert node.search.taken == {"right": "/imu_right/data"}
    assert "taking /imu_right/data as right" in line


def test_an_adapter_with_a_source_of_its_own_looks_for_no_other(graph):
    values = {"source": "topic:///mine"}
    node, _, lines = graph("/imu_left/data", kind=ImuAdapterNode, namespace="/left", values=values)
    assert node.search is None
    assert lines == []
