"""Frames on /tf, with the real tf2_msgs: installed, or built of its definition."""

import importlib
import sys
from contextlib import suppress

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry

from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.inputs.frame_transforms import FrameTransforms
from dualfoot_ros.nodes.results.outputs import Outputs
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.settings import FrameConfig, PathConfig, PersonConfig

from ..real_tf2_msgs import build, why_not

FRAMES = {"left_foot", "right_foot", "base_footprint"}


@pytest.fixture(scope="module")
def tf_message(tmp_path_factory):
    """Return the class of the message; other tests do not find it afterwards."""
    with suppress(ImportError):
        yield importlib.import_module("tf2_msgs.msg").TFMessage
        return
    if why_not():
        pytest.skip(why_not())
    folder = str(build(tmp_path_factory.mktemp("tf2_msgs")))
    sys.path.insert(0, folder)
    try:
        yield importlib.import_module("tf2_msgs.msg").TFMessage
    finally:
        sys.path.remove(folder)
        for name in [name for name in sys.modules if name.partition(".")[0] == "tf2_msgs"]:
            del sys.modules[name]


def publish(bench, tf_message, updates, frames=None, present=(True, True)):
    """Publish updates; return what arrives on /tf, and the odometry by its child frame."""
    node, got, odometry = bench.plain(), [], {}
    node.create_subscription(tf_message, "/tf", got.append, qos.result(100))
    for topic in ("odometry", "left/odometry", "right/odometry"):
        node.create_subscription(
            Odometry,
            topic,
            lambda m: odometry.setdefault(m.child_frame_id, []).append(m),
            qos.result(),
        )
    outputs = Outputs(
        *(node, frames or FrameConfig(), PathConfig(), PersonConfig(), 1e-3), tf=True
    )
    bench.until(lambda: node.count_publishers("/tf"), "discovery")
    for update in updates[:5]:
        outputs.publish(update, present)
    feet = sum(present)
    bench.until(
        lambda: len(got) == 5 and sum(map(len, odometry.values())) == 5 * (1 + feet), "frames"
    )
    return got, odometry


def test_every_frame_has_the_pose_and_the_stamp_of_its_odometry(bench, tf_message, updates):
    got, odometry = publish(bench, tf_message, updates)
    for number, message in enumerate(got):
        assert {each.child_frame_id for each in message.transforms} == FRAMES
        for frame in message.transforms:
            told = odometry[frame.child_frame_id][number]
            pose, move = told.pose.pose, frame.transform
            assert frame.header == told.header and frame.header.frame_id == "odom"
            assert (move.translation.x, move.translation.y, move.translation.z) == (
                *(pose.position.x, pose.position.y, pose.position.z),
            )
            assert move.rotation == pose.orientation


def test_the_frames_are_a_tree_with_the_names_of_the_parameters(bench, tf_message, updates):
    frames = FrameConfig(odom="map", pedestrian="person", prefix="anna/").prefixed()
    got, _ = publish(bench, tf_message, updates, frames)
    parents = {}
    for frame in got[0].transforms:
        assert frame.child_frame_id not in parents  # one parent each
        parents[frame.child_frame_id] = frame.header.frame_id
    assert parents == dict.fromkeys(
        ["anna/person", "anna/left_foot", "anna/right_foot"], "anna/map"
    )


def test_the_person_stands_level_on_the_floor_below_the_feet(bench, tf_message, updates):
    got, _ = publish(bench, tf_message, updates)
    frames = {each.child_frame_id: each.transform for each in got[-1].transforms}
    person = frames["base_footprint"]
    assert (person.rotation.x, person.rotation.y) == (0.0, 0.0)
    feet = [frames[name].translation.z for name in ("left_foot", "right_foot")]
    assert person.translation.z < min(feet)


def test_a_foot_that_is_missing_has_no_frame(bench, tf_message, updates):
    got, _ = publish(bench, tf_message, updates, present=(True, False))
    children = {each.child_frame_id for message in got for each in message.transforms}
    assert children == FRAMES - {"right_foot"}


def test_fusion_offers_the_frames_only_when_it_is_told_to(bench, tf_message):
    silent = bench.add(FusionNode, namespace="silent")
    assert silent.outputs._tf is None
    node = bench.add(FusionNode, {"publish_tf": True}, namespace="anna")
    bench.until(lambda: node.count_publishers("/tf") == 1, "the publisher")


def test_transforms_of_others_are_taken_from_tf_and_tf_static(bench, tf_message):
    node = bench.plain()
    for topic, child in (("/tf_static", "map"), ("/tf", "odom")):
        frame = TransformStamped(child_frame_id=child)
        frame.header.frame_id = {"map": "earth", "odom": "map"}[child]
        frame.transform.translation.x, frame.transform.rotation.w = 2.0, 1.0
        publisher = node.create_publisher(tf_message, topic, qos.latched())
        publisher.publish(tf_message(transforms=[frame]))
        if child == "map":
            transforms = FrameTransforms(node)  # late for the static one
        else:
            again = publisher, tf_message(transforms=[frame])

    def found():
        again[0].publish(again[1])
        return transforms.find("earth", "odom")

    bench.until(found, "transforms")
    np.testing.assert_allclose(found().position(np.zeros(3)), [4.0, 0.0, 0.0])
