import numpy as np
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import imu_values, to_ns
from dualfoot_ros.nodes.ros.status import ERROR, WARN, Status
from dualfoot_ros.nodes.time_sync import TimeSyncNode
from dualfoot_ros.recording import read_bag
from dualfoot_ros.timing import align

from .samples import STEP_NS, imu


class Feet:
    """Publishes raw samples and collects synchronised ones."""

    def __init__(self, bench, node):
        probe = bench.plain()
        profile = qos.sensor(10_000)
        self.raw = {f: probe.create_publisher(Imu, f"{f}/imu/data_raw", profile) for f in FEET}
        self.got = {"left": [], "right": []}
        for foot in FEET:
            probe.create_subscription(Imu, f"{foot}/imu/data_sync", self.got[foot].append, profile)
        bench.until(
            lambda: all(
                node.count_publishers(f"{f}/imu/data_raw")
                and self.raw[f].get_subscription_count()
                and probe.count_publishers(f"{f}/imu/data_sync")
                for f in FEET
            ),
            "discovery",
        )


FEET = ("left", "right")


def test_two_streams_leave_with_equal_stamps_and_the_numbers_of_the_batch(bench, walk_bag):
    node = bench.add(TimeSyncNode, {"input.depth": 10_000})
    feet, recording = Feet(bench, node), read_bag(walk_bag)
    series = {"left": recording.left[:300], "right": recording.right[3:296]}
    for foot, each in series.items():
        values = np.hstack([each.specific_force, each.angular_rate])
        for stamp_ns, row in zip(each.stamp_ns.tolist(), values, strict=True):
            feet.raw[foot].publish(imu(stamp_ns, row, f"{foot}_sensor"))
    left, right = align(series["left"], series["right"])
    bench.until(lambda: min(map(len, feet.got.values())) >= len(left), "pairs")
    for foot, expected in (("left", left), ("right", right)):
        stamps = [to_ns(m.header.stamp) for m in feet.got[foot]]
        assert stamps == expected.stamp_ns.tolist()
        found = np.array([imu_values(m) for m in feet.got[foot]])
        np.testing.assert_array_equal(found[:, :3], expected.specific_force)
        np.testing.assert_array_equal(found[:, 3:], expected.angular_rate)
        assert {m.header.frame_id for m in feet.got[foot]} == {f"{foot}_sensor"}


def test_bad_samples_are_refused_and_counted(bench):
    node = bench.add(TimeSyncNode)
    feet = Feet(bench, node)
    for foot in FEET:
        for k in range(5):
            feet.raw[foot].publish(imu(k * STEP_NS))
    bench.until(lambda: node.streams.aligner.counters["pairs"] == 5, "first pairs")
    feet.raw["left"].publish(imu(5 * STEP_NS, [np.nan] * 6))
    feet.raw["left"].publish(imu(4 * STEP_NS))
    feet.raw["right"].publish(imu(2 * STEP_NS))
    feet.raw["left"].publish(imu(6 * STEP_NS, [np.inf] * 6))
    bench.until(lambda: node.streams.received == 14, "bad samples")
    counters = node.streams.aligner.counters
    assert counters["left_not_finite"] == 2 and counters["left_duplicate"] == 1
    assert counters["right_out_of_order"] == 1 and counters["pairs"] == 5


def test_one_foot_alone_goes_on_at_its_rate_and_the_other_is_stale(bench):
    node = bench.add(TimeSyncNode)
    feet = Feet(bench, node)
    for k in range(200):
        feet.raw["left"].publish(imu(k * STEP_NS))
    bench.until(lambda: node.streams.inputs["left"].received == 200, "samples")
    bench.until(lambda: len(feet.got["left"]) == 199, "pairs of the left foot")
    assert [to_ns(m.header.stamp) for m in feet.got["left"]] == [k * STEP_NS for k in range(199)]
    assert feet.got["right"] == []
    assert node.streams.aligner.counters["right_missing"] == 199
    assert node.streams.states.states == {"left": "OK", "right": "STALE"}


def test_a_bag_that_starts_again_is_counted_as_a_restart(bench):
    node = bench.add(TimeSyncNode)
    feet = Feet(bench, node)
    for _ in range(2):
        for k in range(100):
            for foot in FEET:
                feet.raw[foot].publish(imu(10**12 + k * STEP_NS))
    bench.until(lambda: node.streams.received == 400, "samples")
    assert node.streams.aligner.counters["restarts"] >= 1
    assert node.streams.aligner.counters["pairs"] > 150


def test_streams_without_a_common_clock_are_paired_by_their_arrivals(bench):
    values = {"stamping.left": "arrival", "stamping.right": "arrival", "use_sim_time": True}
    node = bench.add(TimeSyncNode, values)
    feet, start_ns = Feet(bench, node), 10**18
    for k in range(50):
        bench.set_now(node, start_ns + k * STEP_NS)
        feet.raw["left"].publish(imu(k * STEP_NS))
        feet.raw["right"].publish(imu(10**15 + k * STEP_NS))
        bench.until(lambda k=k: node.streams.inputs["right"].received > k, "a sample")
    bench.until(lambda: min(map(len, feet.got.values())) == 50, "pairs")
    stamps = [to_ns(m.header.stamp) for m in feet.got["left"]]
    assert stamps == [start_ns + k * STEP_NS for k in range(50)]


def said_of_the_left_foot(node):
    status = Status()
    node.streams.monitor.describe(status)
    return {(status.level, status.message)} if "left/imu/data_raw" in status.message else set()


def test_a_clock_that_is_being_learnt_is_no_silence_of_its_input(bench, clock):
    """The adapter withholds samples for longer than input.silence; time_sync sees none."""
    values = {"source": "topic:///device", "stamp": "device", "use_sim_time": True}
    adapter = bench.add(ImuAdapterNode, values, namespace="left")
    node, probe, found = bench.add(TimeSyncNode, {"input.silence": 0.5}), bench.plain(), set()
    topics = ("device", "right/imu/data_raw")
    out = [probe.create_publisher(Imu, topic, qos.sensor(100)) for topic in topics]

    def send():
        clock.move_on(1e-9 * STEP_NS)
        now_ns = round(1e9 * clock.now_s)
        bench.set_now(adapter, now_ns)
        for each in out:
            each.publish(imu(now_ns))
        taken = adapter._input.received + 1
        bench.until(lambda: adapter._input.received == taken, "a sample")

    def look():
        found.update(said_of_the_left_foot(node))
        return found

    bench.until(lambda: all(p.get_subscription_count() for p in out), "discovery")
    bench.until(lambda: node.count_publishers("left/imu/data_raw"), "the adapter")
    while not adapter.counters["relayed"]:
        send()
        look()
    assert adapter.stamper.counters["settling"] > 50
    assert found == {(WARN, "topic '/left/imu/data_raw' has 1 publisher(s) but no sample yet")}
    bench.until(lambda: node.streams.inputs["left"].received, "a first sample")
    found.clear()
    assert not look()
    clock.move_on(1.0)
    assert look()
    assert {level for level, _ in found} == {ERROR} and "was silent for" in str(found)


def test_a_fixed_offset_brings_two_streams_together(bench):
    values = {"stamping.right_offset": -5.0}
    node = bench.add(TimeSyncNode, values)
    feet = Feet(bench, node)
    for k in range(50):
        feet.raw["left"].publish(imu(k * STEP_NS))
        feet.raw["right"].publish(imu(5 * 10**9 + k * STEP_NS))
    bench.until(lambda: node.streams.aligner.counters["pairs"] == 50, "pairs")
