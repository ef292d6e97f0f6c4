import numpy as np
import pytest
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.replay import ReplayNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import imu_values, to_ns
from dualfoot_ros.recording import Recording, RecordingError, read_bag, write_bag

FEET = ("left", "right")


@pytest.mark.parametrize("topic", ["data_raw", "data_sync"])
def test_a_bag_becomes_topics_to_the_bit_and_nothing_is_lost_at_the_start(bench, short_bag, topic):
    probe, got, clock = bench.plain(), {foot: [] for foot in FEET}, []
    for foot in FEET:
        name = f"{foot}/imu/{topic}"
        probe.create_subscription(Imu, name, got[foot].append, qos.sensor(20_000))
    probe.create_subscription(Clock, "/clock", clock.append, qos.sensor(20_000))
    values = {"bag": str(short_bag), "play.rate": 1000.0, "topic": topic}
    replay = bench.add(ReplayNode, values)
    bench.until(replay.done.done, "the end of the bag")
    recording = read_bag(short_bag)
    for foot in FEET:
        series = recording.imu(foot)
        bench.until(lambda f=foot, whole=series: len(got[f]) == len(whole), "all samples")
        stamps = [to_ns(m.header.stamp) for m in got[foot]]
        np.testing.assert_array_equal(stamps, series.stamp_ns)
        found = np.array([imu_values(m) for m in got[foot]])
        np.testing.assert_array_equal(found[:, :3], series.specific_force)
    times = np.array([to_ns(m.clock) for m in clock])
    assert len(times) > 100 and (np.diff(times) > 0).all()


def test_a_bag_of_one_foot_is_played_as_it_is(bench, walk_bag, tmp_path):
    path = write_bag(tmp_path / "one", Recording(left=read_bag(walk_bag).left[:50]))
    replay = bench.add(ReplayNode, {"bag": str(path), "play.rate": 1000.0, "play.wait": 0.0})
    bench.until(replay.done.done, "the end of the bag")
    assert replay.player.played == 50


def test_a_bag_without_samples_is_refused_with_the_topics_it_should_have(
    bench, walk_bag, tmp_path
):
    path = write_bag(tmp_path / "truth", Recording(left_truth=read_bag(walk_bag).left_truth))
    with pytest.raises(RecordingError, match="/left/imu/data_raw or /right/imu/data_raw"):
        bench.add(ReplayNode, {"bag": str(path)})
