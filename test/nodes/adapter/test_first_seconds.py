"""imu_adapter says once, within seconds, what arrives and what to change."""

import socket

import numpy as np
import pytest
from drivers.frames import stream, vectornav_ascii
from sensor_msgs.msg import Imu

from dualfoot_ros.drivers import SourceError, State
from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.ros import qos

from ..samples import STANDING, STEP_NS, imu

pytestmark = pytest.mark.usefixtures("clock")


@pytest.fixture
def topic(bench):
    """Start an adapter of a topic, send it samples, and return the lines it says."""

    def start(values, *, zero_stamps=False, **parameters):
        probe = bench.plain()
        out = probe.create_publisher(Imu, "/imu_a", qos.sensor(500))
        parameters = {"source": "topic:///imu_a", **parameters}
        node = bench.add(ImuAdapterNode, parameters, namespace="left")
        bench.until(out.get_subscription_count, "discovery")
        noise = np.random.default_rng(0).normal(0.0, 0.001, (100, 6))
        for k, off in enumerate(noise):
            out.publish(imu(0 if zero_stamps else 10**12 + k * STEP_NS, values * (1.0 + off)))
        bench.until(lambda: node.check.counters["seen"] == 100, "samples")
        node.first_seconds.report()
        node.first_seconds.report()
        return node.first_seconds.said

    return start


def test_a_sensor_that_is_right_is_described_in_one_line(topic):
    (line,) = topic(STANDING)
    assert "receives 100.0 Hz" in line
    assert "at rest: specific force 9.81, +z up" in line
    assert "from topic /imu_a" in line
    assert line.endswith("nothing to change")


def test_units_and_axes_that_are_wrong_are_followed_by_what_to_set(topic):
    lines = topic(np.array([0.0, 0.0, -1.0, 1.2, 0.5, 0.3]))
    assert len(lines) == 4
    assert "units.specific_force: set it to g" in lines
    assert any(line.startswith("units.angular_rate: set it to deg/s") for line in lines)
    assert any(line.startswith("mounting.axes: set them to x,-y,-z") for line in lines)


def test_parameters_that_were_set_are_not_advised_again(topic):
    said = topic(np.array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]), **{"units.specific_force": "g"})
    assert not any("units" in line for line in said)


def test_headers_of_zero_are_no_clock(topic):
    lines = topic(STANDING, zero_stamps=True)
    assert "headers without stamps" in lines[0]


def test_nothing_is_said_before_there_are_samples(bench):
    node = bench.add(ImuAdapterNode, {"source": "topic:///imu_a"}, namespace="left")
    node.first_seconds.report()
    assert node.first_seconds.said == []


def test_a_device_taken_for_another_format_is_recognised_in_diagnostics(bench, clock):
    source = "udp://127.0.0.1:0?format=vectornav"
    node = bench.add(ImuAdapterNode, {"source": source}, namespace="left")
    device = node.device
    bench.until(lambda: device.source.state is State.CONNECTED, "the port")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        for k in range(0, 40, 4):
            data = stream("witmotion", 4, first=k)
            out.sendto(data, ("127.0.0.1", device.source.transport.port))
    bench.until(lambda: device.source.decoder.counters["bytes"] == 40 * 33, "all bytes")
    clock.move_on(5.0)
    complaint = device.complaint()
    assert complaint.kind is FindingKind.NO_FRAMES
    assert "the bytes are of the format 'witmotion'" in complaint.text


def test_a_capture_taken_for_another_format_is_recognised(bench, tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(stream("witmotion", 300))
    source = f"file://{path}?format=vectornav"
    node = bench.add(ImuAdapterNode, {"source": source, "play.wait": 0.0}, namespace="left")
    bench.until(node.done.done, "the end of the file")
    with pytest.raises(SourceError, match="the bytes are of the format 'witmotion'"):
        node.done.result()


def test_a_file_that_is_over_sooner_is_described_and_its_pace_is_no_rate(bench, tmp_path):
    path = tmp_path / "capture.txt"
    path.write_bytes(b"".join(vectornav_ascii(k) for k in range(200)))
    source = f"file://{path}?format=vectornav_ascii"
    node = bench.add(ImuAdapterNode, {"source": source, "play.wait": 0.0}, namespace="left")
    bench.until(node.done.done, "the end of the file")
    (line, *_) = node.first_seconds.said
    assert "rate unknown, no clock of its own" in line
    assert "format vectornav_ascii" in line
