import math
import time

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import imu_values, to_ns
from dualfoot_ros.recording import read_bag

from .samples import STANDING, STEP_NS, imu


def relayed(bench, values, samples):
    """Return what an adapter makes of samples on its topic, and the adapter."""
    node = bench.add(ImuAdapterNode, {"source": "topic:///sensor", **values}, namespace="left")
    probe, got = bench.plain(), []
    probe.create_subscription(Imu, "/left/imu/data_raw", got.append, qos.sensor(1000))
    publisher = probe.create_publisher(Imu, "/sensor", qos.sensor(1000))
    bench.until(
        lambda: (
            publisher.get_subscription_count() and probe.count_publishers("/left/imu/data_raw")
        ),
        "discovery",
    )
    for sample in samples:
        publisher.publish(sample)
    bench.until(lambda: sum(node.counters.values()) == len(samples), "samples")
    bench.until(lambda: len(got) == node.counters["relayed"], "relayed samples")
    return got, node


def test_samples_are_relayed_turned_scaled_and_renamed(bench):
    values = {
        "mounting.yaw": math.pi,
        "units.specific_force": "g",
        "units.angular_rate": "deg/s",
        "frame_id": "left_imu",
        "covariance.angular_rate_std": 0.01,
    }
    got, _ = relayed(bench, values, [imu(7, [1.0, 0.0, 1.0, 90.0, 0.0, 0.0])])
    expected = [-9.80665, 0.0, 9.80665, -math.pi / 2, 0.0, 0.0]
    np.testing.assert_allclose(imu_values(got[0]), expected, atol=1e-12)
    assert got[0].header.frame_id == "left_imu" and to_ns(got[0].header.stamp) == 7
    assert got[0].angular_velocity_covariance[0] == pytest.approx(1e-4)


def test_the_stamp_can_be_the_time_of_arrival(bench):
    before_ns = time.time_ns()
    got, node = relayed(bench, {"stamp": "arrival"}, [imu(7)])
    assert before_ns <= to_ns(got[0].header.stamp) <= node.get_clock().now().nanoseconds


def test_samples_that_are_not_finite_are_refused_and_counted(bench):
    bad = STANDING.copy()
    bad[4] = math.nan
    got, node = relayed(bench, {}, [imu(1), imu(2, bad), imu(3)])
    assert [to_ns(each.header.stamp) for each in got] == [1, 3]
    assert node.counters == {"relayed": 2, "not_finite": 1}


def test_a_sensor_in_g_is_recognised_in_the_diagnostics(bench, clock):
    samples = [imu(k * STEP_NS, STANDING / 9.80665) for k in range(150)]
    reports = []
    bench.plain("listener").create_subscription(
        DiagnosticArray, "/diagnostics", reports.append, 10
    )
    relayed(bench, {"reports.period": 0.1}, samples)

    def said():
        return [r for r in reports if "looks like g" in r.status[0].message]

    bench.until(said, "a report")
    assert said()[0].status[0].level == DiagnosticStatus.WARN
    assert said()[0].status[0].name == "left/imu_adapter"


def test_one_foot_of_a_bag_is_played_to_the_bit_by_the_namespace(bench, short_bag):
    probe, got = bench.plain(), []
    probe.create_subscription(Imu, "/right/imu/data_raw", got.append, qos.sensor(10_000))
    values = {"source": f"file://{short_bag}", "play.rate": 1000.0}
    node = bench.add(ImuAdapterNode, values, namespace="right")
    bench.until(node.done.done, "the end of the file")
    series = read_bag(short_bag).right
    bench.until(lambda: len(got) == len(series), "all samples")
    np.testing.assert_array_equal([to_ns(m.header.stamp) for m in got], series.stamp_ns)
    np.testing.assert_array_equal([imu_values(m)[3:] for m in got], series.angular_rate)
