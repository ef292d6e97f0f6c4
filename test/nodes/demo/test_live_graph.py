import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.results.events import EventKind
from dualfoot_ros.evaluation import as_live, track
from dualfoot_ros.nodes.demo.collector import PERSON
from dualfoot_ros.nodes.demo.live_graph import LiveGraph, same_bits
from dualfoot_ros.nodes.ros.messages import to_ns
from dualfoot_ros.recording import Recording, read_bag, write_bag

from .plain_ekf import LEAST_VARIANCE, POSE, TWIST, VX, VY, YAW, PlainEkf, X, Y

DEMO = Path(__file__).resolve().parents[3] / "bags" / "demo"
BEGIN_S, END_S = 6.0, 45.0  # a stand, one loop of the eight, a stop, the start of the other loop


@pytest.fixture(scope="module")
def recording() -> Recording:
    """Return a part of the demo."""
    whole = read_bag(DEMO)
    ends_ns = whole.left.stamp_ns[0] + np.array([BEGIN_S, END_S]) * 1e9
    series = whole.left, whole.right
    left, right = (each[slice(*np.searchsorted(each.stamp_ns, ends_ns))] for each in series)
    return replace(whole, left=left, right=right)


@pytest.fixture(scope="module")
def bag(recording, tmp_path_factory) -> Path:
    """Return a bag of it."""
    return write_bag(tmp_path_factory.mktemp("bags") / "demo", recording)


@pytest.fixture(scope="module")
def played(bag):
    """Return the bag through the nodes, and the odometry of the person as published."""
    import rclpy

    context = rclpy.Context()
    rclpy.init(args=["--ros-args", "--log-level", "error"], context=context)
    graph = LiveGraph(bag, {"default": TrackerConfig()}, context)
    try:
        graph.run(lambda share: None)
        person = graph.collectors["default"].messages[PERSON]
        return graph.result("default"), [deserialize_message(data, Odometry) for data in person]
    finally:
        graph.close()
        rclpy.try_shutdown(context=context)


@pytest.fixture(scope="module")
def both(played, bag):
    """Return the bag through the nodes, and the same samples offline."""
    return played[0], track(read_bag(bag), as_live(TrackerConfig()))


@pytest.fixture(scope="module")
def person(played, recording):
    """Return stamps, messages and true places of the person, from where the heading is known."""
    live, messages = played
    known = max(e.detected_ns for e in live.trajectory.of_kind(EventKind.HEADING))
    messages = [m for m in messages if to_ns(m.header.stamp) > known]
    stamps = np.array([to_ns(m.header.stamp) for m in messages])
    feet = [
        [np.interp(stamps, truth.stamp_ns, truth.position[:, axis]) for axis in range(2)]
        for truth in (recording.left_truth, recording.right_truth)
    ]
    return stamps, messages, np.mean(feet, axis=0).T


def test_the_demo_bag_through_the_nodes_is_the_offline_run_to_the_bit(both):
    live, batch = both
    assert live.lost == 0
    assert same_bits(live.trajectory, batch)


def test_the_events_of_both_runs_are_the_same(both):
    live, batch = both

    def told(trajectory):
        return [(e.kind, e.stamp_ns, e.foot, e.detected_ns, e.nis) for e in trajectory.events]

    np.testing.assert_equal(told(live.trajectory), told(batch))
    assert len(live.trajectory.of_kind(EventKind.HEADING)) == 2


def test_the_stances_of_both_runs_are_the_same(both):
    live, batch = both
    np.testing.assert_array_equal(live.trajectory.left.stance, batch.left.stance)
    np.testing.assert_array_equal(live.trajectory.right.stance, batch.right.stance)


def test_what_the_twist_turns_forth_and_back_agrees_to_rounding(both):
    live, batch = both
    for a, b in ((live.trajectory.left, batch.left), (live.trajectory.right, batch.right)):
        np.testing.assert_allclose(a.velocity, b.velocity, atol=1e-12)
        np.testing.assert_allclose(a.velocity_covariance, b.velocity_covariance, atol=1e-12)
    plane = np.s_[:, :2, :2]  # the height of the person is that of the floor
    np.testing.assert_allclose(
        live.trajectory.relative_covariance[plane], batch.relative_covariance[plane], atol=1e-9
    )


def test_every_sample_was_taken_and_none_refused(both, recording):
    live, _ = both
    assert live.counters["pairs"] == len(recording.left) - 1  # the last has nothing to pair with
    refusals = ("not_finite", "out_of_order", "duplicate", "gaps", "resets")
    assert not any(live.counters.get(name) for name in refusals)


def test_every_covariance_of_the_person_is_one_that_a_filter_can_use(person):
    stamps, messages, _ = person
    assert (np.diff(stamps) > 0).all()
    for part in ("pose", "twist"):
        found = np.array([np.reshape(getattr(m, part).covariance, (6, 6)) for m in messages])
        assert np.isfinite(found).all()
        turned = found.transpose(0, 2, 1)
        assert (np.abs(found - turned) <= np.maximum(1e-9 * np.abs(turned), 1e-15)).all()
        assert np.linalg.eigvalsh(found).min() > LEAST_VARIANCE


@pytest.mark.parametrize(
    ("used", "differential", "worst_m"),
    [
        (POSE, False, 0.12),
        ((*POSE, *TWIST), False, 0.12),
        (POSE, True, 0.05),
        (TWIST, False, 0.2),
    ],
)
def test_a_filter_by_the_rules_of_robot_localization_follows_the_truth(
    person, used, differential, worst_m
):
    _, messages, truth = person
    ekf = PlainEkf(used, differential=differential)
    states = np.array([ekf.add(message) for message in messages])
    assert np.isfinite(states).all()
    assert np.linalg.eigvalsh(ekf.covariance).min() > 0
    assert misfit(states[:, [X, Y]], truth) < worst_m
    # the body moves forward in its own frame, at 1.2 m/s with the ripple of the steps
    moving = np.abs(states[:, VX]) > 0.5
    assert np.mean(states[moving, VX]) == pytest.approx(1.2, abs=0.2)
    assert np.abs(np.mean(states[moving, VY])) < 0.1


def test_the_person_as_published_follows_the_truth(person):
    _, messages, truth = person
    places = [(m.pose.pose.position.x, m.pose.pose.position.y) for m in messages]
    assert misfit(np.array(places), truth) < 0.05


def test_the_configuration_for_robot_localization_on_its_page_follows_the_truth(person):
    _, messages, truth = person
    page = DEMO.parents[1] / "docs" / "how_to" / "other_packages.md"
    block = re.search(r"```yaml\n(ekf_filter_node:.*?)```", page.read_text(encoding="utf-8"), re.S)
    values = yaml.safe_load(block[1])["ekf_filter_node"]["ros__parameters"]
    used = np.flatnonzero(values["odom0_config"])
    in_the_plane = {0: X, 1: Y, 5: YAW}  # of x, y, z, roll, pitch, yaw, their rates, accelerations
    assert values["two_d_mode"] and values["odom0"] == "/odometry" and len(used) == 3
    ekf = PlainEkf(
        [in_the_plane[k] for k in used.tolist()],
        world_frame=values["world_frame"],
        base_link_frame=values["base_link_frame"],
        differential=values["odom0_differential"],
    )
    states = np.array([ekf.add(message) for message in messages])
    assert misfit(states[:, [X, Y]], truth) < 0.05
    # what moves only relative to itself is known less and less
    assert ekf.covariance[X, X] + ekf.covariance[Y, Y] > 1.0


def misfit(places: np.ndarray, truth: np.ndarray) -> float:
    """Return the RMSE (m) after the best turn and shift in the plane: frames are free."""
    a, b = (points - points.mean(axis=0) for points in (places, truth))
    turn = np.arctan2(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.sum(a * b))
    c, s = np.cos(turn), np.sin(turn)
    return float(np.sqrt(np.mean(np.sum((a @ np.array([[c, s], [-s, c]]) - b) ** 2, axis=1))))


def test_one_changed_bit_is_seen(both):
    live, batch = both
    moved = batch.left.position.copy()
    moved[100, 0] = np.nextafter(moved[100, 0], np.inf)
    assert not same_bits(live.trajectory, replace(batch, left=replace(batch.left, position=moved)))


def test_no_node_of_the_graph_warns_of_its_own_replay():
    import rclpy

    context = rclpy.Context()
    rclpy.init(args=["--ros-args", "--log-level", "error"], context=context)
    graph = None
    try:
        graph = LiveGraph(DEMO, {"default": TrackerConfig()}, context)
        inputs = [graph.sync, *graph.fusions.values()]
        patience = [node.get_parameter("input.silence").value for node in inputs]
        assert min(patience) >= 60.0
    finally:
        if graph is not None:
            graph.close()
        rclpy.try_shutdown(context=context)
