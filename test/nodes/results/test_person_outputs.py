"""What is published of the person: trust in words, steps, path and markers."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from nav_msgs.msg import Path
from rclpy.serialization import deserialize_message
from visualization_msgs.msg import MarkerArray

from dualfoot_ros.core import DualFootTracker, ImuPair, Step, Trust
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.nodes.results.person_outputs import (
    PersonOutputs,
    TrustOutput,
    trust_message,
    trust_sentence,
)
from dualfoot_ros.nodes.results.step_outputs import step_message
from dualfoot_ros.nodes.ros.status import OK, WARN, Status
from dualfoot_ros.recording import read_bag
from dualfoot_ros.settings import FrameConfig, PathConfig, PersonConfig
from dualfoot_ros.timing import align


@pytest.mark.parametrize(
    ("radius", "known", "way", "time_s", "words"),
    [
        (1.0, True, 20.0, 16.0, "20 m or 16 s more at this pace"),
        (1.0, True, 20.0, math.inf, "20 m more of way"),
        (1.0, True, math.inf, math.inf, "as long as can be foretold"),
        (1.0, False, math.inf, math.inf, "not known yet"),
        (4.0, True, 0.0, 0.0, "beyond the limit of 3 m"),
    ],
)
def test_trust_is_said_in_words(radius, known, way, time_s, words):
    trust = Trust(0, radius, 3.0, known, way, time_s, 1.25)
    assert words in trust_sentence(trust)
    assert trust_message(trust).level == (WARN if radius > 3.0 else OK)


@pytest.mark.parametrize(
    ("std", "known", "lost"), [(0.6, True, 1), (0.4, True, 0), (1.8, False, 0)]
)
def test_a_heading_that_is_lost_is_said_with_what_to_do(std, known, lost):
    trust = Trust(0, 1.0, 3.0, known, math.inf, math.inf, 1.25, std)
    assert ("give a pose" in trust_sentence(trust)) == bool(lost)
    person = PersonTrust(trust)
    assert len(person.findings) == lost
    for finding in person.findings:
        assert finding.kind is FindingKind.LOST_HEADING and finding.kind.logged_once
        assert "34 degrees" in finding.sentence and "initialpose" in finding.sentence


class PersonTrust(Status):
    """The status that a trust output makes of a ``trust``."""

    def __init__(self, trust: Trust) -> None:
        super().__init__()
        output = TrustOutput.__new__(TrustOutput)
        output.tracker = SimpleNamespace(result=lambda: trust)
        output.describe(self)


def test_a_step_is_read_back_from_its_message():
    step = Step(10**9, 2 * 10**9, "left", np.ones(3), 0.7, 0.1, 0.0, 1.4, None, 0.1, 0.02)
    (status,) = step_message(step).status
    values = {pair.key: json.loads(pair.value) for pair in status.values}
    assert status.hardware_id == "left" and values["length"] == 0.7
    assert values["duration"] is None and values["confidence"] > 0.99


def test_path_and_markers_have_a_place_for_each_step(bench, walk_bag):
    node = bench.plain()
    got = []
    node.create_subscription(MarkerArray, "markers", got.append, 10)
    outputs = PersonOutputs(node, FrameConfig(), PersonConfig(), PathConfig())
    bench.until(lambda: node.count_publishers("markers"), "discovery")
    recording = read_bag(walk_bag)
    left, right = align(recording.left, recording.right)
    tracker = DualFootTracker(engine="compiled")
    made = 0
    for stamp, row in zip(left.stamp_ns.tolist()[:1000], stack_pairs(left, right), strict=False):
        update = tracker.add(ImuPair(stamp, row))
        outputs.publish(update)
        made += update.left is not None
    assert made > 500
    bench.until(lambda: got, "markers")
    person = outputs._person.add(update)
    path = deserialize_message(outputs._path.message(person), Path)
    drawn = outputs._markers.message(update, person).markers
    spaces = {marker.ns for marker in drawn}
    assert spaces == {"feet", "footprints", "covariance", "constraint"}
    assert {marker.header.frame_id for marker in drawn} == {"odom"}
    prints = [len(marker.points) for marker in drawn if marker.ns == "footprints"]
    assert sum(prints) >= 8 and abs(prints[0] - prints[1]) <= 2
    assert abs(sum(prints) + 1 - len(path.poses)) <= 1
    places = np.array([p.pose.position.x for p in path.poses])
    assert (np.diff(places) > -0.1).all()
