"""Of a foot that is missing nothing is published."""

import pytest
from nav_msgs.msg import Odometry

from dualfoot_ros.nodes.results.outputs import Outputs
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.settings import FrameConfig, PathConfig, PersonConfig

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
