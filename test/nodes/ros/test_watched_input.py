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


class Queue:
    """A queue of a process that gets a sample every 10 ms, on the clock of the test.

    ``work_s`` is what it spends on one; ``waited_s`` how old each one was that it has taken.
    """

    def __init__(self, bench, clock, latency_s):
        self.waited_s, self.work_s, self._clock = [], 0.001, clock
        self._waiting, self._due_ns, node = [], clock.time_ns(), bench.plain("listener")
        self.input = WatchedInput(
            node, Imu, "imu", self._take, qos.sensor(10), latency_s=latency_s
        )
        config = InputConfig(latency=latency_s)
        self.monitor = InputMonitor(node, [self.input], config)

    def _take(self, message):
        arrived_ns = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
        self.waited_s.append((self._clock.time_ns() - arrived_ns) * 1e-9)
        self._clock.move_on(self.work_s)

    def run(self, seconds):
        """Let samples come for some seconds, and take them as fast as the work allows."""
        end_ns = self._clock.time_ns() + round(1e9 * seconds)
        while self._clock.time_ns() < end_ns:
            while self._due_ns <= self._clock.time_ns():
                self._waiting.append(self._due_ns)
                self._due_ns += 10_000_000
            if self._waiting:
                arrived_ns = self._waiting.pop(0)
                self.input._receive(imu(arrived_ns), {"received_timestamp": arrived_ns})
            else:
                self._clock.move_on(0.001)

    def findings(self):
        status = Status()
        self.monitor.describe(status)
        assert status.values["dropped /imu"] == self.input.dropped
        return list(status.of_kind(FindingKind.FALLING_BEHIND))


def test_a_process_that_is_too_slow_for_its_samples_drops_to_the_newest_and_says_so(bench, clock):
    queue = Queue(bench, clock, latency_s=2.0)
    queue.run(5.0)
    assert max(queue.waited_s) < 0.02 and not queue.findings()
    queue.work_s = 0.03
    queue.run(60.0)
    assert 1.9 < max(queue.waited_s) <= 2.0  # it waits for better times so long, and no longer
    taken, dropped = len(queue.waited_s), queue.input.dropped
    assert taken + dropped == queue.input.received
    assert taken >= 0.9 * 60.0 / 0.03  # what it can do, it does
    (finding,) = queue.findings()
    assert finding.about == "/imu"
    assert finding.text.startswith(f"{dropped} samples on '/imu' waited")


def test_a_process_that_was_held_up_is_up_to_date_at_once_and_drops_nothing_more(bench, clock):
    queue = Queue(bench, clock, latency_s=2.0)
    queue.run(2.0)
    clock.move_on(5.0)
    queue.run(2.0)
    assert max(queue.waited_s) < 0.25
    assert 480 <= queue.input.dropped <= 500
    assert queue.findings() and not queue.findings()
    queue.run(10.0)
    assert not queue.findings() and queue.waited_s[-1] < 0.02


def test_without_a_time_of_arrival_nothing_is_dropped(bench):
    taken, node = [], bench.plain("listener")
    each = WatchedInput(node, Imu, "imu", taken.append, qos.sensor(10), latency_s=0.001)
    each._receive(imu(0), {})
    assert len(taken) == 1 and each.dropped == 0
