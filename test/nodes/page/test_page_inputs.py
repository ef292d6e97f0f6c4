"""What fusion publishes, as the page shows it: real messages on real topics."""

import json
import math
import urllib.request

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import BatteryState

from dualfoot_ros.core import (
    DualFootTracker,
    Event,
    EventKind,
    ImuPair,
    Step,
    Trust,
    YawTurn,
    yaw_quaternion,
)
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.nodes.live_page import LivePageNode
from dualfoot_ros.nodes.page.live_state import HEIGHT, PERSON, LiveState
from dualfoot_ros.nodes.page.page_inputs import PageInputs
from dualfoot_ros.nodes.results import event_messages
from dualfoot_ros.nodes.results.outputs import Outputs
from dualfoot_ros.nodes.results.person_outputs import trust_message
from dualfoot_ros.nodes.results.step_outputs import step_message
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import set_pose, set_time
from dualfoot_ros.recording import read_bag
from dualfoot_ros.settings import FrameConfig, PathConfig, PersonConfig
from dualfoot_ros.timing import align

from .test_node_reports import counts, report

S = 1_000_000_000


def pose(stamp_s, x, y=0.0, z=0.0, yaw=0.0, child="base_footprint"):
    message = Odometry(child_frame_id=child)
    message.header.frame_id = "odom"
    set_time(message.header.stamp, round(stamp_s * S))
    set_pose(message.pose.pose, np.array([x, y, z]), yaw_quaternion(yaw))
    message.pose.covariance[0], message.pose.covariance[7] = 0.04, 0.01
    message.pose.covariance[14], message.pose.covariance[35] = 0.09, math.radians(2.0) ** 2
    return message


def path(stamp_s, places):
    message = Path()
    set_time(message.header.stamp, round(stamp_s * S))
    for t, x in [*places, (stamp_s, 0.0)]:
        at = round(t * S), np.array([x, 0.0, 0.0]), yaw_quaternion(0.0)
        made = PoseStamped()
        set_time(made.header.stamp, at[0])
        set_pose(made.pose, *at[1:])
        message.poses.append(made)
    return message


def heading(foot, detected_s, *, joint, yaw=math.pi / 2):
    turn = YawTurn(yaw, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), joint)
    empty = np.zeros(0), np.zeros((0, 0)), math.nan, True
    at = round(detected_s * S)
    event = Event(EventKind.HEADING, at, foot, at, *empty, turn)
    return event_messages.to_message((event,), at)


@pytest.fixture
def state():
    return LiveState()


@pytest.fixture
def inputs(bench, state):
    return PageInputs(bench.plain("page"), state)


def now(state):
    return state.message({})[0]["now"]


def places(state, name):
    return [place[:3] for place in state.message({})[0]["trails"][name]["places"]]


def walk(inputs, seconds, start_s=100.0):
    """Walk along x at 1 m/s, with 20 poses a second."""
    for k in range(round(20 * seconds) + 1):
        inputs._take_person(pose(start_s + 0.05 * k, 0.05 * k))


def test_a_walk_is_a_line_with_pace_and_uncertainty(inputs, state):
    walk(inputs, 5.0)
    assert places(state, PERSON)[-1] == pytest.approx([5.0, 5.0, 0.0], abs=0.25)
    person = now(state)["person"]
    assert person["speed"] == pytest.approx(1.0)
    assert (person["major"], person["minor"]) == pytest.approx((0.2, 0.1))
    assert person["height_std"] == pytest.approx(0.3)
    assert person["heading_std"] == pytest.approx(2.0)
    assert now(state)["walked"] == pytest.approx(5.0, abs=0.3)
    assert len(places(state, HEIGHT)) == pytest.approx(10, abs=2)


def test_poses_are_taken_no_more_often_than_they_can_be_seen(inputs, state):
    inputs._take_foot("left", pose(1.0, 1.0))
    inputs._take_foot("left", pose(1.01, 2.0))
    assert now(state)["left"]["x"] == 1.0
    inputs._take_foot("left", pose(1.06, 3.0))
    assert now(state)["left"]["x"] == 3.0


def test_a_page_that_is_opened_late_has_the_walk_before(inputs, state):
    walk(inputs, 1.0, start_s=200.0)
    inputs._take_path(PERSON, path(201.0, [(100.0, -5.0), (150.0, -2.0)]))
    inputs._take_path("left", path(201.0, [(100.0, -5.0)]))
    assert [p[1] for p in places(state, PERSON)][:2] == [-5.0, -2.0]
    assert [p[1] for p in places(state, "left")] == [-5.0]
    inputs._take_path("left", path(202.0, [(100.0, -5.0), (201.5, 7.0)]))
    assert len(places(state, "left")) == 1  # it follows by the steps


def test_a_heading_turns_the_walk_once_and_not_what_was_published_turned(inputs, state):
    inputs._take_path(PERSON, path(99.0, [(90.0, -3.0)]))
    inputs._take_events(heading("left", 98.0, joint=True))
    assert places(state, PERSON)[0][1] == -3.0
    walk(inputs, 2.0)
    for foot in ("left", "right"):
        inputs._take_events(heading(foot, 102.5, joint=True))
    assert places(state, PERSON)[0][1:] == pytest.approx([0.0, -3.0], abs=1e-9)
    assert places(state, PERSON)[-1][1:] == pytest.approx([0.0, 2.0], abs=0.25)


def test_the_walk_before_the_first_heading_is_dropped(inputs, state):
    walk(inputs, 2.0)
    inputs._take_events(heading("left", 102.5, joint=False))
    assert places(state, PERSON) == []


def test_steps_are_footprints(inputs, state):
    walk(inputs, 1.0)
    step = Step(
        101 * S, 101 * S, "right", np.array([0.8, -0.1, 0.0]), 0.7, 0.2, 0.0, 1.4, 0.55, 0.1, 0.02
    )
    inputs._take_step(step_message(step))
    assert places(state, "right") == [[1.0, 0.8, -0.1]]
    assert now(state)["step"]["foot"] == "right"
    assert now(state)["step"]["duration"] == 0.55


@pytest.mark.parametrize("how", ["reset", "stamps go back"])
def test_another_walk_begins_an_empty_page(inputs, state, how):
    walk(inputs, 2.0)
    if how == "reset":
        empty = np.zeros(0), np.zeros((0, 0)), math.nan, True
        event = Event(EventKind.RESET, 103 * S, "", 103 * S, *empty)
        inputs._take_events(event_messages.to_message((event,), 103 * S))
        assert now(state)["person"] is None
    else:
        inputs._take_person(pose(50.0, 9.0))
        assert places(state, PERSON) == [[0.0, 9.0, 0.0]]
    assert len(places(state, PERSON)) <= 1


def test_an_old_reset_that_is_latched_is_no_new_walk(inputs, state):
    walk(inputs, 2.0)
    empty = np.zeros(0), np.zeros((0, 0)), math.nan, True
    event = Event(EventKind.RESET, 90 * S, "", 90 * S, *empty)
    inputs._take_events(event_messages.to_message((event,), 90 * S))
    assert places(state, PERSON)


def test_trust_that_has_no_end_is_json_too(inputs, state):
    inputs._take_trust(trust_message(Trust(0, 0.5, 3.0, True, math.inf, math.inf, 1.0)))
    trust = json.loads(json.dumps(now(state), allow_nan=False))["trust"]
    assert trust["radius"] == 0.5 and trust["time_left"] is None
    assert trust["trusted"] and trust["heading_known"]


def test_a_battery_of_a_driver_of_any_kind_is_shown(inputs, state):
    inputs._take_battery("left", BatteryState(percentage=0.62))
    inputs._take_battery("right", BatteryState(percentage=math.nan))
    inputs.look()
    assert now(state)["feet"]["left"]["battery"] == pytest.approx(62.0)
    assert now(state)["feet"]["right"]["battery"] is None


def test_silence_is_explained_with_what_to_do(clock, inputs, state):
    clock.move_on(10.0)
    inputs.look()
    assert "'/odometry' has no publisher" in now(state)["silent"]
    assert "start fusion or bringup" in now(state)["silent"]


def test_the_node_shows_what_is_published_in_its_namespace(bench):
    page = bench.add(LivePageNode, {"port": 0}, namespace="anna")
    node = bench.add(lambda **options: bench_node("fusion", namespace="anna", **options))
    results, told = qos.result(10), node.create_publisher(DiagnosticArray, "/diagnostics", 10)
    person = node.create_publisher(Odometry, "odometry", results)
    left = node.create_publisher(Odometry, "left/odometry", results)

    def shown():
        person.publish(pose(shown.t, 1.0, 2.0, 3.0))
        left.publish(pose(shown.t, 1.5, 2.0, 3.0, child="left_foot"))
        told.publish(report("anna/fusion", counts(5, phase="walking")))
        shown.t += 1.0
        seen = page.inputs._state.message({})[0]["now"]
        return seen.get("left") and seen.get("person") and seen.get("phase") == "walking"

    shown.t = 1.0
    bench.until(shown, "the walk on the page")
    with urllib.request.urlopen(page.server.url + "state.json", timeout=30) as answer:
        seen = json.loads(answer.read())["now"]
    assert seen["person"]["y"] == 2.0 and seen["left"]["x"] == 1.5
    assert seen["feet"]["left"]["state"] == "tracking"


def test_the_page_has_the_walk_that_fusion_has_after_its_headings(bench, state, walk_bag):
    """Both are turned by the same events, fusion's paths and the page's own trails."""
    fusion = bench.add(lambda **options: bench_node("fusion", **options))
    frames, path, person = FrameConfig(), PathConfig(), PersonConfig()
    outputs = Outputs(fusion, frames, path, person, 1e-3, tf=False)
    inputs = PageInputs(bench.plain("page"), state)
    inputs._seeded = {PERSON, "left", "right"}  # nothing was walked before
    bench.until(lambda: fusion.count_subscribers("odometry"), "discovery")
    recording = read_bag(walk_bag)
    left, right = align(recording.left, recording.right)
    tracker = DualFootTracker(engine="compiled")
    for number, row in enumerate(stack_pairs(left, right)[:800]):
        update = tracker.add(ImuPair(int(left.stamp_ns[number]), row))
        outputs.publish(update)
        if update.left is not None and number % 5 == 0:  # as fast as the page takes them
            bench.until(lambda s=update.stamp_ns: inputs._newest_ns >= s, "odometry")
    shown = np.array(places(state, PERSON))[:, 1:]
    known = outputs.person._path.message(outputs.person._person.add(update))
    for pose in deserialize_message(known, Path).poses:
        place = pose.pose.position
        assert np.hypot(*(shown - [place.x, place.y]).T).min() < 0.25
    for foot in ("left", "right"):
        prints = np.array(places(state, foot))[:, 1:]
        path = deserialize_message(outputs._paths[foot].message(), Path).poses
        stood = np.array([[p.pose.position.x, p.pose.position.y] for p in path])
        apart = np.linalg.norm(prints[:, None] - stood[None], axis=2).min(axis=1)
        assert len(prints) > 3 and apart.max() < 0.05


def bench_node(name, **options):
    from rclpy.node import Node

    return Node(name, **options)
