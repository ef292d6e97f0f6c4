from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.watched_publisher import watched_publisher

from ..samples import imu

RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)


def test_a_subscriber_that_asks_for_more_than_is_offered_is_warned_about(bench, program):
    arguments = ["-p", "source:=topic:///sensor", "-r", "__ns:=/left"]
    adapter = program("imu_adapter", "--ros-args", *arguments)
    bench.plain().create_subscription(Imu, "/left/imu/data_raw", lambda _: None, RELIABLE)
    said = "a subscriber of '/left/imu/data_raw' asks for a QoS that is not offered (RELIABILITY)"
    bench.until(lambda: said in adapter.output, "the warning")


def test_a_publisher_without_mismatch_says_nothing(bench, capfd):
    node = bench.plain("talker")
    publisher = watched_publisher(node, Imu, "imu", qos.sensor(10))
    received = []
    bench.plain("listener").create_subscription(Imu, "imu", received.append, qos.sensor(10))
    bench.until(publisher.get_subscription_count)
    publisher.publish(imu(1))
    bench.until(lambda: received)
    assert "QoS" not in capfd.readouterr().err
