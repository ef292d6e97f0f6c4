"""Of a foot that is missing nothing is published."""

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from nav_msgs.msg import Path as PathMessage

from dualfoot_ros.nodes.results.outputs import Outputs
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.settings import FrameConfig, PathConfig, PersonConfig

from .updates import tracked

FEET = ("left", "right")


@pytest.mark.parametrize(
    ("present", "expected"),
    [((True, True), FEET), ((True, False), FEET[:1]), ((False, True), FEET[1:])],
)
def test_odometry_is_that_of_the_person_and_of_the_feet_that_are_there(
    bench, updates, present, expected
):
    node, got = bench.plain(), {"left": [], "right": [], "person": []}
    for name, found in got.items():
        topic = "odometry" if name == "person" else f"{name}/odometry"
        node.create_subscription(Odometry, topic, found.append, qos.result())
    outputs = Outputs(node, FrameConfig(), PathConfig(), PersonConfig(), 1e-3, tf=False)
    for update in updates[:5]:
        outputs.publish(update, present)
    bench.until(lambda: len(got["person"]) == 5, "odometry of the person")
    bench.until(lambda: all(len(got[foot]) == 5 for foot in expected), "odometry of the feet")
    assert outputs.messages == sum(map(len, got.values())) == 5 * (1 + len(expected))


def test_the_way_before_a_start_without_a_stand_is_in_the_paths_and_events_but_no_odometry(bench):
    """Its estimates come seconds late, all at once: too late to steer by, not to be remembered."""
    node, got = bench.plain(), {"odometry": [], "path": [], "events": []}
    for topic, kind, found, profile in (
        ("left/odometry", Odometry, got["odometry"], qos.result()),
        ("left/path", PathMessage, got["path"], qos.latched()),
        ("~/events", DiagnosticArray, got["events"], qos.latched(200)),
    ):
        node.create_subscription(kind, topic, found.append, profile)
    outputs = Outputs(node, FrameConfig(), PathConfig(), PersonConfig(), 1e-3, tf=False)
    first = tracked(300, 300, **{"alignment.patience": 4.0})[0]
    late = len(first.earlier)
    assert late > 60
    outputs.publish(first)
    bench.until(lambda: got["odometry"] and got["path"], "odometry and path")
    events = sum(bool(update.announced) for update in (*first.earlier, first))
    bench.until(lambda: len(got["events"]) == events, "events")
    names = [status.name for message in got["events"] for status in message.status]
    assert names[0] == "aligned" and "stance_end" in names
    assert len(got["odometry"]) == 1
    (path,) = got["path"]
    stamps = [pose.header.stamp.sec + 1e-9 * pose.header.stamp.nanosec for pose in path.poses]
    assert stamps == sorted(set(stamps)) and stamps[0] < stamps[-1] - 0.5
    assert outputs.messages == 3
