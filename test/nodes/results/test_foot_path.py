import math
from types import SimpleNamespace

import numpy as np
import pytest
from nav_msgs.msg import Path
from rclpy.serialization import deserialize_message

from dualfoot_ros.core import YawTurn, yaw_quaternion
from dualfoot_ros.core.results.events import Event, EventKind
from dualfoot_ros.nodes.results.foot_path import FootPath

SECOND = 1_000_000_000


def estimate(x, y=0.0, stance=True, yaw=0.0):
    return SimpleNamespace(
        position=np.array([x, y, 0.0]), quaternion=yaw_quaternion(yaw), stance=stance
    )


def end(foot="left"):
    return Event(EventKind.STANCE_END, 0, foot, 0)


def heading(yaw, foot="left"):
    turn = YawTurn(yaw, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    return Event(EventKind.HEADING, 0, foot, 0, payload=turn)


def walked(path, stances):
    for k in range(stances):
        path.add(2 * k * SECOND, estimate(float(k)), ())
        path.add((2 * k + 1) * SECOND, estimate(k + 0.5, stance=False), (end(),))
    return path


def places(path):
    return [pose.pose.position.x for pose in deserialize_message(path.message(), Path).poses]


def test_a_path_has_one_pose_a_stance_and_the_newest():
    assert places(walked(FootPath("left", "odom", 100, 1.0), 3)) == [0.0, 1.0, 2.0, 2.5]


def test_the_oldest_poses_of_a_long_path_are_dropped():
    assert places(walked(FootPath("left", "odom", 3, 1.0), 10)) == [8.0, 9.0, 9.5]


def test_events_of_the_other_foot_leave_a_path_alone():
    path = FootPath("left", "odom", 100, 1.0)
    path.add(0, estimate(0.0), ())
    path.add(1, estimate(0.1, stance=False), (end("right"), heading(1.0, "right")))
    assert places(path) == [0.1]


def test_a_heading_turns_the_path_so_far():
    path = walked(FootPath("left", "odom", 100, 1.0), 3)
    path.add(9 * SECOND, estimate(0.0, 3.0, yaw=math.pi / 2), (heading(math.pi / 2),))
    poses = deserialize_message(path.message(), Path).poses
    assert [p.pose.position.x for p in poses] == pytest.approx([0.0, 0.0, 0.0, 0.0], abs=1e-12)
    assert [p.pose.position.y for p in poses] == pytest.approx([0.0, 1.0, 2.0, 3.0])
    assert poses[0].pose.orientation.z == pytest.approx(math.sin(math.pi / 4))


def test_messages_are_at_most_one_in_the_period():
    path = FootPath("left", "odom", 100, 1.0)
    due = [path.due(k * SECOND // 100) for k in range(301)]
    assert sum(due) == 4


def test_a_cleared_path_is_empty():
    path = walked(FootPath("left", "odom", 100, 1.0), 3)
    path.clear()
    assert places(path) == []
