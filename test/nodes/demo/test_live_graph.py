from pathlib import Path

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.results.events import EventKind
from dualfoot_ros.evaluation import as_live, track
from dualfoot_ros.nodes.demo.live_graph import LiveGraph, run_live, same_bits
from dualfoot_ros.recording import read_bag

DEMO = Path(__file__).resolve().parents[3] / "bags" / "demo"


@pytest.fixture(scope="module")
def both():
    """Return the demo bag through the nodes, and the same samples offline."""
    import rclpy

    context, config, recording = rclpy.Context(), TrackerConfig(), read_bag(DEMO)
    rclpy.init(args=["--ros-args", "--log-level", "error"], context=context)
    try:
        live = run_live(DEMO, {"default": config}, context)["default"]
    finally:
        rclpy.try_shutdown(context=context)
    return live, track(recording, as_live(config))


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


def test_every_sample_was_taken_and_none_refused(both):
    live, _ = both
    assert live.counters["pairs"] == len(read_bag(DEMO).left) or live.counters["pairs"] > 13_000
    refusals = ("not_finite", "out_of_order", "duplicate", "gaps", "resets")
    assert not any(live.counters.get(name) for name in refusals)


def test_one_changed_bit_is_seen(both):
    live, batch = both
    moved = batch.left.position.copy()
    moved[100, 0] = np.nextafter(moved[100, 0], np.inf)
    from dataclasses import replace

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
