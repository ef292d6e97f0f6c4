"""What the samples are goes from every source to the tracker, and is said where it is unknown."""

from dataclasses import replace

import pytest
from drivers import frames
from sensor_msgs.msg import Imu
from std_msgs.msg import String

from dualfoot_ros.core import FEET, Increments
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.inputs.increments_topics import IncrementsOutput
from dualfoot_ros.nodes.replay import ReplayNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.status import Status
from dualfoot_ros.recording import read_bag, write_bag

TOPIC = "left/imu/increments"


def said_on(bench, topic):
    """Return the texts that arrive on a topic, to a subscriber that comes later."""
    texts = []
    bench.plain("listener").create_subscription(
        String, topic, lambda message: texts.append(message.data), qos.latched()
    )
    return texts


def taken(fusion):
    """Return what the tracker of a fusion node takes the samples for, by foot."""
    status = Status()
    fusion.increments.describe(status)
    return [status.values[f"{foot} increments"].partition(",")[0] for foot in FEET]


@pytest.mark.parametrize("kind", list(Increments))
def test_fusion_hears_what_a_source_has_said_before_it_was_there(bench, kind):
    IncrementsOutput(bench.plain("source"), TOPIC).declare(kind)
    fusion = bench.add(FusionNode)
    bench.until(lambda: fusion.increments.declared == {"left": kind}, "the latched message")
    assert taken(fusion) == [kind, "averaged"]


def test_the_parameter_of_fusion_wins_over_the_source(bench):
    IncrementsOutput(bench.plain("source"), TOPIC).declare(Increments.SAMPLED)
    fusion = bench.add(FusionNode, {"increments.left": "compensated"})
    bench.until(lambda: fusion.increments.declared, "the latched message")
    assert taken(fusion) == ["compensated", "averaged"]


def test_a_text_that_is_no_kind_is_ignored(bench):
    source = bench.plain("source")
    publisher = source.create_publisher(String, TOPIC, qos.latched(2))
    fusion = bench.add(FusionNode)
    publisher.publish(String(data="smooth"))
    publisher.publish(String(data="sampled"))
    bench.until(lambda: fusion.increments.declared, "a message")
    assert fusion.increments.declared == {"left": Increments.SAMPLED}


def test_fusion_logs_once_aligned_that_nothing_says_what_the_samples_are(
    program, short_bag, tmp_path
):
    whole = read_bag(short_bag)
    feet = {foot: replace(whole.imu(foot)[:420], increments=None) for foot in FEET}
    unknown = write_bag(tmp_path / "unknown", replace(whole, **feet))
    running = program(
        "bringup", "--ros-args", "-p", f"bag:={unknown}", "-p", "play.rate:=20.0",
        "-p", "input.depth:=10000", "-p", "input.latency:=0.0", "-p", "engine:=compiled",
        "-p", "increments.right:=averaged",
    )  # fmt: skip
    assert running.code() == 0
    text = "left foot: samples are taken for means over their interval (averaged), as nothing says"
    assert running.output.count(text) == 1
    assert (
        "right foot: samples are taken for means over their interval (averaged), as the par"
        in (running.output)
    )


@pytest.fixture
def said_bag(short_bag, tmp_path):
    """Return a bag whose feet have samples of two kinds."""
    whole = read_bag(short_bag)
    left = replace(whole.left[:60], increments=Increments.COMPENSATED)
    right = replace(whole.right[:60], increments=Increments.SAMPLED)
    return write_bag(tmp_path / "said", replace(whole, left=left, right=right))


def test_replay_publishes_what_the_bag_says(bench, said_bag):
    bench.add(ReplayNode, {"bag": str(said_bag), "play.rate": 1000.0})
    fusion = bench.add(FusionNode)
    bench.until(lambda: len(fusion.increments.declared) == 2, "both feet")
    assert taken(fusion) == ["compensated", "sampled"]


@pytest.mark.parametrize(
    ("given", "published"), [("from_source", "sampled"), ("averaged", "averaged")]
)
def test_an_adapter_that_plays_a_bag_says_it_too_unless_its_parameter_does(
    bench, said_bag, given, published
):
    values = {"source": f"file://{said_bag}", "increments.kind": given}
    bench.add(ImuAdapterNode, values, namespace="right")
    texts = said_on(bench, "/right/imu/increments")
    bench.until(lambda: texts, "the latched message")
    assert texts == [published]


@pytest.mark.parametrize("name", ["xbus", "witmotion"])
def test_an_adapter_of_a_device_says_what_its_decoder_does(bench, tmp_path, name):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream(name, 40))
    source = f"file://{path}?format={name}&speed=0"
    bench.plain("sink").create_subscription(Imu, "/left/imu/data_raw", print, qos.sensor(100))
    node = bench.add(ImuAdapterNode, {"source": source}, namespace="left")
    texts = said_on(bench, "/left/imu/increments")
    bench.until(lambda: texts and node.done.done(), "the end of the file")
    assert texts == ["compensated" if name == "xbus" else "sampled"]


def test_an_adapter_of_a_topic_says_nothing_but_its_parameter(bench):
    silent = bench.add(ImuAdapterNode, {"source": "topic:///a"}, namespace="left")
    assert silent.increments.kind is None
    values = {"source": "topic:///a", "increments.kind": "sampled"}
    told = bench.add(ImuAdapterNode, values, namespace="right")
    assert told.increments.kind is Increments.SAMPLED


def test_bringup_records_what_the_samples_are(program, said_bag, tmp_path):
    target = tmp_path / "result"
    running = program(
        "bringup", "--ros-args", "-p", f"bag:={said_bag}", "-p", f"record:={target}",
        "-p", "play.rate:=20.0", "-p", "input.depth:=10000",
    )  # fmt: skip
    assert running.code() == 0, running.output
    recorded = read_bag(target)
    assert recorded.left.increments is Increments.COMPENSATED
    assert recorded.right.increments is Increments.SAMPLED
