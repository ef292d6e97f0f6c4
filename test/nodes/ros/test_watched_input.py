import time

import pytest
import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu
from std_msgs.msg import String

from dualfoot_ros.inspection import FindingKind, Severity
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.status import ERROR, WARN, Status
from dualfoot_ros.nodes.ros.watched_input import InputMonitor, WatchedInput, silence
from dualfoot_ros.settings.nodes import InputConfig

from ..samples import imu

QUICK = InputConfig(silence=0.3)


def listening(bench, profile=None):
    node = bench.plain("listener")
    each = WatchedInput(node, Imu, "imu", lambda _: None, profile or qos.sensor(10))
    return each, InputMonitor(node, [each], QUICK)


def said(each):
    complaint = each.complaint(QUICK)
    return complaint.text if complaint else ""


def severity(each):
    complaint = each.complaint(QUICK)
    return complaint.severity if complaint else None


def test_a_topic_without_publisher_is_named(bench, clock):
    each, watch = listening(bench)
    clock.move_on(1.0)
    bench.until(lambda: said(each))
    complaint = each.complaint(QUICK)
    assert complaint.key == (FindingKind.NO_PUBLISHER, "/imu") and complaint.is_error
    status = Status()
    watch.describe(status)
    assert (status.level, status.message) == (ERROR, "topic '/imu' has no publisher")


@pytest.mark.parametrize(
    ("begun", "silent_s", "expected"),
    [
        (False, 2.5, (FindingKind.NOT_BEGUN, Severity.WARNING, "it is there but no sample yet")),
        (False, 19.9, (FindingKind.NOT_BEGUN, Severity.WARNING, "it is there but no sample yet")),
        (
            False,
            20.1,
            (FindingKind.BEGINS_LATE, Severity.ERROR, "it is there but no sample came for 20.1 s"),
        ),
        (True, 2.5, (FindingKind.SILENT, Severity.ERROR, "it is there but was silent for 2.5 s")),
    ],
)
def test_only_what_has_not_begun_is_given_time(begun, silent_s, expected):
    finding = silence("it is there", begun, silent_s, InputConfig())
    assert (finding.kind, finding.severity, finding.text) == expected


def test_an_input_that_has_spoken_is_an_error_as_soon_as_it_is_silent(bench, clock):
    each, watch = listening(bench)
    clock.move_on(1.0)
    publisher = bench.plain().create_publisher(Imu, "imu", qos.sensor(10))
    bench.until(lambda: "1 publisher(s) but no sample yet" in said(each), "a publisher")
    assert severity(each) is Severity.WARNING
    status = Status()
    watch.describe(status)
    assert status.level == WARN and "no sample yet" in status.message
    publisher.publish(imu(1))
    bench.until(lambda: each.received == 1)
    assert said(each) == ""
    clock.move_on(1.0)
    bench.until(lambda: "1 publisher(s) but was silent for" in said(each), "silence")
    assert severity(each) is Severity.ERROR


def test_a_first_sample_is_waited_for_from_when_its_publisher_is_there(bench, clock):
    each, _ = listening(bench)
    clock.move_on(100.0)
    bench.until(lambda: "no publisher" in said(each))
    bench.plain().create_publisher(Imu, "imu", qos.sensor(10))
    bench.until(lambda: "publisher(s)" in said(each), "a publisher")
    assert severity(each) is Severity.WARNING
    clock.move_on(100.0)
    assert severity(each) is Severity.ERROR and "no sample came for 100." in said(each)


RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)


def test_a_publisher_whose_qos_does_not_fit_is_said_with_what_it_lacks(bench, clock):
    each, _ = listening(bench, RELIABLE)
    clock.move_on(1.0)
    bench.plain().create_publisher(Imu, "imu", qos.sensor(10))
    bench.until(lambda: "QoS does not fit" in said(each), "incompatible QoS")
    assert "(best effort publisher and reliable subscription)" in said(each)
    assert severity(each) is Severity.ERROR


def test_a_publisher_that_fits_is_not_blamed_for_the_one_before_it(bench, clock):
    each, _ = listening(bench, RELIABLE)
    clock.move_on(1.0)
    node = bench.plain()
    bad = node.create_publisher(Imu, "imu", qos.sensor(10))
    bench.until(lambda: "QoS does not fit" in said(each), "incompatible QoS")
    node.create_publisher(Imu, "imu", RELIABLE)  # the one that was killed may linger
    bench.until(lambda: "2 publisher(s) but no sample yet" in said(each), "a publisher that fits")
    assert severity(each) is Severity.WARNING
    node.destroy_publisher(bad)
    bench.until(lambda: "1 publisher(s) but no sample yet" in said(each), "the bad one to go")
    assert severity(each) is Severity.WARNING


def test_a_topic_of_another_type_is_said_as_long_as_nobody_publishes_the_right_one(bench, clock):
    each, _ = listening(bench)
    clock.move_on(1.0)
    other = rclpy.Context()  # one process with one context cannot have a topic of two types
    rclpy.init(args=[], context=other)
    try:
        node = rclpy.create_node("other", context=other)
        node.create_publisher(String, "imu", 10)
        bench.until(lambda: "std_msgs/msg/String" in said(each), "another type")
        assert "expected is sensor_msgs/msg/Imu" in said(each)
        bench.plain().create_publisher(Imu, "imu", qos.sensor(10))
        bench.until(lambda: "2 publisher(s) but no sample yet" in said(each), "the right type")
        node.destroy_node()
    finally:
        rclpy.try_shutdown(context=other)


def test_data_ends_the_complaint(bench, clock):
    each, _ = listening(bench)
    clock.move_on(1.0)
    publisher = bench.plain().create_publisher(Imu, "imu", qos.sensor(10))
    bench.until(publisher.get_subscription_count)
    bench.until(lambda: said(each))
    publisher.publish(imu(1))
    bench.until(lambda: each.received == 1)
    assert each.complaint(QUICK) is None


def test_samples_that_a_full_queue_drops_are_counted(bench):
    each, _ = listening(bench, qos.sensor(5))
    publisher = bench.plain().create_publisher(Imu, "imu", qos.sensor(1000))
    bench.until(publisher.get_subscription_count)
    publisher.publish(imu(0))
    bench.until(lambda: each.received == 1)
    for k in range(100):
        publisher.publish(imu(k + 1))
    bench.until(lambda: each.received == 6)
    publisher.publish(imu(200))
    bench.until(lambda: each.received == 7)
    assert each.lost == 95


def test_what_has_waited_too_long_is_dropped_down_to_the_newest_and_said(bench):
    taken, node = [], bench.plain("listener")
    config = InputConfig(latency=60.0)
    each = WatchedInput(node, Imu, "imu", taken.append, qos.sensor(10), latency_s=60_000.0)
    watch = InputMonitor(node, [each], config)
    for waited_s in (50_000, 61_000, 30_000, 7_000, 5_000, 50_000):
        arrived_ns = time.time_ns() - waited_s * 10**9
        each._receive(imu(waited_s), {"received_timestamp": arrived_ns})
    assert [message.header.stamp.nanosec for message in taken] == [50_000, 5_000, 50_000]
    assert (each.received, each.dropped) == (6, 3)
    status = Status()
    watch.describe(status)
    (finding,) = status.of_kind(FindingKind.FALLING_BEHIND)
    assert finding.about == "/imu" and finding.text.startswith("3 samples on '/imu' waited")
    assert status.values["dropped /imu"] == 3
    status = Status()
    watch.describe(status)
    assert not list(status.of_kind(FindingKind.FALLING_BEHIND))


def test_without_a_time_of_arrival_nothing_is_dropped(bench):
    taken, node = [], bench.plain("listener")
    each = WatchedInput(node, Imu, "imu", taken.append, qos.sensor(10), latency_s=0.001)
    each._receive(imu(0), {})
    assert len(taken) == 1 and each.dropped == 0
