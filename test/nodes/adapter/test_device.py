"""imu_adapter by parameters alone: real links, device clocks, a cable that is pulled."""

import signal
import threading

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from drivers import frames
from drivers.links import PluggedDevice
from sensor_msgs.msg import Imu

from dualfoot_ros.drivers import SensorFault, SourceError, State
from dualfoot_ros.drivers.transports.capture_file import FileTransport
from dualfoot_ros.drivers.transports.serial_port import SerialTransport
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import imu_values, to_ns

from ..samples import status_values
from ..skewed_device import RATE, START_NS, STEP_NS, SkewedDevice

COUNT = 2400  # 12 s


class Adapter:
    """An adapter of the left foot, what it publishes and what it says about itself."""

    def __init__(self, bench, source, **values):
        self.samples, self.reports = [], []
        probe = bench.plain()
        profile = qos.sensor(10_000)
        probe.create_subscription(Imu, "/left/imu/data_raw", self.samples.append, profile)
        probe.create_subscription(DiagnosticArray, "/diagnostics", self.reports.append, 10)
        values = {"source": source, "reports.period": 0.1, **values}
        self.node = bench.add(ImuAdapterNode, values, namespace="left")
        bench.until(self.node._output.has_listener, "discovery")

    def report(self):
        """Return the newest report."""
        return self.reports[-1].status[0]

    def says(self, level, words):
        """Tell whether the newest report has that level and those words."""
        return self.reports and self.report().level == level and words in self.report().message


def skewed(bench, adapter, skew_ppm):
    """Return a device on the port of the adapter, once that is open."""
    bench.until(lambda: adapter.node.device.source.state is State.CONNECTED, "the port")
    return SkewedDevice(bench, adapter.node, skew_ppm)


def true_ns(samples):
    """Return when the samples were taken, by the host's clock."""
    numbers = np.array([round(m.angular_velocity.x / RATE) for m in samples])
    return START_NS + numbers * STEP_NS


def listen(stamper):
    """Note the arrivals of all samples that are to be stamped; return the growing list, ns."""
    found, inner = [], stamper.stamp

    def stamp(foot, header_ns, arrival_ns):
        found.append(arrival_ns)
        return inner(foot, header_ns, arrival_ns)

    stamper.stamp = stamp
    return found


def test_a_skewed_clock_behind_a_bursty_link_is_stamped_right_within_seconds(bench, clock):
    adapter = Adapter(bench, "udp://127.0.0.1:0?format=mcu", use_sim_time=True)
    arrivals = listen(adapter.node.stamper)
    skewed(bench, adapter, 1500.0).send(COUNT)
    bench.until(lambda: len(arrivals) == COUNT, "samples")
    bench.until(lambda: len(adapter.samples) == adapter.node.counters["relayed"], "all of them")
    least = (np.array(arrivals) - START_NS - np.arange(COUNT) * STEP_NS).min()
    last = adapter.samples[-400:]  # 10 s and more after the first
    errors = 1e-9 * ([to_ns(m.header.stamp) for m in last] - true_ns(last) - least)
    assert np.median(np.abs(errors)) < 0.003
    assert np.abs(errors).max() < 0.01  # a burst spreads the arrivals over 0.1 s
    bench.until(lambda: status_values(adapter.reports[-1]).get("seen") == str(COUNT), "a report")
    values = status_values(adapter.reports[-1])
    assert values["left clock"] == "tracking" and values["link"] == "connected"
    assert float(values["left skew (ppm)"]) == pytest.approx(1500.0, abs=500.0)
    assert float(values["left offset uncertainty (s)"]) < 0.005
    assert float(values["sampling rate (Hz)"]) == pytest.approx(199.7, abs=0.5)


def test_a_clock_that_is_off_by_two_percent_is_reported_and_not_published(bench, clock):
    adapter = Adapter(bench, "udp://127.0.0.1:0?format=mcu", use_sim_time=True)
    device = skewed(bench, adapter, 20_000.0)
    device.send(COUNT)
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, "ppm it is not fused"), "a report")
    assert adapter.node.stamper.states["left"].skew_ppm == pytest.approx(20_000, rel=0.1)
    counters = adapter.node.stamper.counters
    bench.until(lambda: sum(counters.values()) == COUNT, "samples")
    refused = counters["not_stamped"]
    device.send(40)
    bench.until(lambda: counters["not_stamped"] == refused + 40, "samples")
    assert adapter.node.counters["relayed"] == 0 and adapter.samples == []


def test_a_serial_device_is_unplugged_and_comes_back(bench, tmp_path):
    device = PluggedDevice(tmp_path / "ttyUSB0")
    device.plug()
    source = f"serial://{device.path}?baud=921600&format=mcu&retry_max=0.1"
    adapter = Adapter(bench, source, **{"mounting.axes": "y,-x,z", "stamp": "header"})
    reader = adapter.node.device.source.reader
    bench.until(lambda: reader.state is State.CONNECTED, "the port")
    device.send(frames.stream("mcu", 20))
    bench.until(lambda: len(adapter.samples) == 20, "samples")
    force, rate = frames.truth(7)
    expected = [force[1], -force[0], force[2], rate[1], -rate[0], rate[2]]
    np.testing.assert_allclose(imu_values(adapter.samples[7]), expected, rtol=1e-6)
    device.unplug()
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, "is waiting: "), "the loss")
    device.plug()
    bench.until(lambda: reader.state is State.CONNECTED, "the port again")
    device.send(b"\x05half a frame\0" + frames.stream("mcu", 20, first=40))
    bench.until(lambda: len(adapter.samples) == 40, "samples again")
    bench.until(lambda: status_values(adapter.reports[-1])["samples"] == "40", "a report")
    values = status_values(adapter.reports[-1])
    assert values["reconnects"] == "1" and values["malformed"] == "1"
    device.unplug()


def test_captured_bytes_are_played_with_the_device_s_own_time_to_their_end(bench, tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 300))
    adapter = Adapter(bench, f"file://{path}?format=mcu&speed=5")
    bench.until(adapter.node.done.done, "the end of the file")
    assert adapter.node.counters["relayed"] == 300
    bench.until(lambda: adapter.samples and len(adapter.samples) > 200, "samples")
    steps = np.diff([to_ns(m.header.stamp) for m in adapter.samples])
    np.testing.assert_array_equal(steps, frames.PERIOD_US * 1000)


def adapter_of(bench, source, **values):
    """Return an adapter that nobody listens to."""
    return bench.add(ImuAdapterNode, {"source": source, **values}, namespace="left")


def listen_late(bench):
    """Subscribe to what the adapter publishes; return the growing list of it."""
    got, probe = [], bench.plain()
    probe.create_subscription(Imu, "/left/imu/data_raw", got.append, qos.sensor(10_000))
    return got


@pytest.mark.parametrize("kind", ["captured bytes", "a bag"])
def test_a_file_waits_for_a_subscriber_and_loses_no_sample_to_it(bench, tmp_path, short_bag, kind):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 300))
    source = (
        f"file://{path}?format=mcu&speed=0" if kind == "captured bytes" else f"file://{short_bag}"
    )
    values = {"play.wait": 3600.0, "play.rate": 100.0, "reports.period": 0.1, "input.silence": 0.1}
    node = adapter_of(bench, source, **values)
    reports, probe = [], bench.plain()
    probe.create_subscription(DiagnosticArray, "/diagnostics", reports.append, 10)
    bench.until(lambda: len(reports) > 4, "reports")
    assert node.counters["relayed"] == 0
    assert reports[-1].status[0].level == DiagnosticStatus.OK
    got = listen_late(bench)
    bench.until(node.done.done, "the end of the file")
    bench.until(lambda: len(got) == node.counters["relayed"], "every sample")
    assert len(got) >= 300


def test_a_capture_that_nobody_listens_to_is_played_after_the_longest_wait(bench, tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 30))
    node = adapter_of(bench, f"file://{path}?format=mcu&speed=0", **{"play.wait": 0.2})
    bench.until(node.done.done, "the end of the file")
    assert node.counters["relayed"] == 30


def test_a_capture_that_waits_can_be_stopped(bench, tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 30))
    values = {"play.wait": 3600.0, "play.delay": 3600.0}
    node = adapter_of(bench, f"file://{path}?format=mcu&speed=0", **values)
    bench.until(lambda: node.check.counters["seen"], "the first bytes")
    node.device.stop()
    assert node.counters["relayed"] == 0 and node.device.source.state is State.STOPPED


def test_a_live_device_waits_for_nobody(bench, tmp_path):
    device = PluggedDevice(tmp_path / "ttyUSB0")
    device.plug()
    values = {"play.wait": 3600.0, "play.delay": 3600.0, "stamp": "header"}
    node = adapter_of(bench, f"serial://{device.path}?format=mcu", **values)
    bench.until(lambda: node.device.source.state is State.CONNECTED, "the port")
    device.send(frames.stream("mcu", 20))
    bench.until(lambda: node.counters["relayed"] == 20, "samples")
    device.unplug()


@pytest.mark.parametrize(("content", "size"), [(b"", 0), (b"no frames at all", 16)])
def test_a_capture_without_any_sample_is_an_error_at_once(bench, tmp_path, content, size):
    path = tmp_path / "capture.bin"
    path.write_bytes(content)
    node = adapter_of(bench, f"file://{path}?format=mcu", **{"play.wait": 3600.0})
    bench.until(node.done.done, "the end of the file")
    with pytest.raises(
        SourceError, match=rf"capture\.bin.* no sample in {size} bytes: check format"
    ):
        node.done.result()


def test_a_capture_that_cannot_be_read_ends_the_node_with_its_error(bench, tmp_path, monkeypatch):
    path = tmp_path / "capture.bin"
    path.write_bytes(b"")

    def denied(self):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(FileTransport, "open", denied)
    adapter = Adapter(bench, f"file://{path}?format=mcu")
    bench.until(adapter.node.done.done, "the failure")
    with pytest.raises(SourceError, match=r"capture\.bin.* has failed: .*Permission denied"):
        adapter.node.done.result()


def test_bytes_of_another_format_are_said_to_be_that(bench, clock):
    adapter = Adapter(bench, "udp://127.0.0.1:0?format=xbus", use_sim_time=True)
    skewed(bench, adapter, 0.0).send(200)
    clock.move_on(3.0)
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, "check format and baud"), "it")
    assert adapter.samples == []


def test_a_link_without_a_byte_so_far_is_a_warning_at_first_and_then_an_error(
    bench, clock, tmp_path
):
    """The time that the device was not there does not count."""
    device = PluggedDevice(tmp_path / "ttyUSB0")
    values = {"input.silence": 0.5, "input.first": 2.0, "stamp": "header"}
    adapter = Adapter(bench, f"serial://{device.path}?format=mcu", **values)
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, "is waiting"), "no device")
    clock.move_on(100.0)
    device.plug()
    bench.until(lambda: adapter.node.device.source.state is State.CONNECTED, "the port")
    bench.until(lambda: adapter.says(DiagnosticStatus.OK, ""), "a report")
    clock.move_on(1.0)
    bench.until(lambda: adapter.says(DiagnosticStatus.WARN, "but no sample yet"), "a warning")
    clock.move_on(1.5)
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, "no sample came for"), "an error")
    device.send(frames.stream("mcu", 20))
    bench.until(lambda: adapter.says(DiagnosticStatus.OK, ""), "samples")
    clock.move_on(1.0)
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, "was silent for"), "silence")
    device.unplug()


def test_a_link_that_takes_its_time_is_said_to_be_connecting(bench, clock, tmp_path, monkeypatch):
    """As over Bluetooth, where the first try takes up to 10 s."""
    device, reached = PluggedDevice(tmp_path / "ttyUSB0"), threading.Event()
    device.plug()
    opened = SerialTransport.open
    monkeypatch.setattr(SerialTransport, "open", lambda self: reached.wait() and opened(self))
    values = {"input.silence": 0.5, "input.first": 2.0, "stamp": "header"}
    adapter = Adapter(bench, f"serial://{device.path}?format=mcu", **values)
    clock.move_on(1.0)
    said = "is connecting but no sample yet"
    bench.until(lambda: adapter.says(DiagnosticStatus.WARN, said), "a warning")
    assert status_values(adapter.reports[-1])["link"] == "connecting"
    clock.move_on(1.5)
    said = "is connecting but no sample came for"
    bench.until(lambda: adapter.says(DiagnosticStatus.ERROR, said), "an error")
    reached.set()
    bench.until(lambda: adapter.node.device.source.state is State.CONNECTED, "the port")
    device.send(frames.stream("mcu", 20))
    bench.until(lambda: adapter.says(DiagnosticStatus.OK, ""), "samples")
    device.unplug()


def test_readings_at_the_end_of_the_range_and_a_wrong_rate_are_reported(bench, clock, tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 300))
    values = {"checks.rate": 100.0, "checks.force_range": 15.0}
    adapter = Adapter(bench, f"file://{path}?format=mcu&speed=0&follow=true", **values)
    bench.until(lambda: adapter.node.check.counters["seen"] == 300, "samples")
    bench.until(lambda: adapter.says(DiagnosticStatus.WARN, "200.0 samples a second"), "rate")
    assert SensorFault.CLIPPED_FORCE in [kind for kind, _ in adapter.node.check.findings]
    assert adapter.node.check.counters["clipped_force"] > 0


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
def test_a_signal_while_samples_come_ends_the_process_with_code_0(program, tmp_path, number):
    device = PluggedDevice(tmp_path / "ttyUSB0")
    device.plug()
    source = f"source:=serial://{device.path}?format=mcu"
    running = program("imu_adapter", "--ros-args", "-p", source)
    running.wait_for("is connected")
    for k in range(100):
        device.send(frames.frame("mcu", k))
        if k == 50:
            running.send(number)
    assert running.code() == 0
    assert "Traceback" not in running.output
    device.unplug()
