"""What is lost, refused or sent by somebody else is said for what it is."""

import math
import socket
import struct

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from drivers import frames
from drivers.links import PluggedDevice

from dualfoot_ros.core import Refusal
from dualfoot_ros.drivers import CheckConfig, Source, State
from dualfoot_ros.nodes.adapter.losses import LossReport, in_words
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.ros.status import OK, WARN, Status

from ..samples import STANDING, status_values
from .test_device import Adapter

ERROR = DiagnosticStatus.ERROR
AGAIN = "is not available and is tried again"


def mcu(k, fault="", shift_s=0.0):
    """Return the k-th frame of a board, with a fault in it."""
    force, rate = frames.truth(k)
    force = {"nan": (math.nan,) * 3, "far": (1e6, 0.0, 0.0)}.get(fault, force)
    ticks = (k * frames.PERIOD_US + round(1e6 * shift_s)) & 0xFFFFFFFF
    plain = struct.pack("<BHI6f", 1, k & 0xFFFF, ticks, *force, *rate)
    crc = frames.crc16(plain, 0xFFFF) ^ (fault == "crc")
    return frames.cobs(plain + struct.pack("<H", crc))


ROUND, ROUNDS = 100, 10


class Boards:
    """Boards that send to the port of an adapter, 100 samples each from report to report."""

    def __init__(self, bench, options="", hosts=("127.0.0.1",), **values):
        values = {"stamp": "header", "reports.period": 60.0, **values}
        self.adapter = Adapter(bench, f"udp://127.0.0.1:0?format=mcu{options}", **values)
        self.source = self.adapter.node.device.source
        bench.until(lambda: self.source.state is State.CONNECTED, "the port")
        self.links = [socket.socket(type=socket.SOCK_DGRAM) for _ in hosts]
        for link, host in zip(self.links, hosts, strict=True):
            link.bind((host, 0))
        self.names = ["{}:{}".format(*link.getsockname()) for link in self.links]
        self.bench, self.sent, self.fault = bench, 0, lambda k: ""
        self._datagrams = 0

    def _send(self):
        for n, link in enumerate(self.links):  # each with a clock and numbers of its own
            if (fault := self.fault(self.sent)) != "lost":
                frame = mcu(self.sent + 7000 * n, fault, 5000.0 * n)
                link.sendto(frame, ("127.0.0.1", self.source.transport.port))
                self._datagrams += 1
        self.sent += 1

    def _arrived(self):
        counters = self.source.counters
        return counters.get("datagrams", 0) + counters.get("foreign", 0) == self._datagrams

    def send(self, count=ROUND):
        """Send so many samples of each board, and wait until they have arrived."""
        for k in range(count):
            self._send()
            if k % 10 == 9:
                self.bench.until(self._arrived, "samples")

    def rounds_until(self, condition, said):
        """Send, and have it reported, until the condition holds."""
        for _ in range(ROUNDS):
            self.send()
            before = len(self.adapter.reports)
            self.adapter.node._reporter.report()
            self.bench.until(lambda n=before: len(self.adapter.reports) > n, "a report")
            if condition():
                return
        raise AssertionError(f"not after {ROUNDS} reports: {said}; {self.adapter.report()}")

    def until(self, level, words):
        """Wait for a report with that level and words, and return it."""
        self.rounds_until(lambda: self.adapter.says(level, words), words)
        return self.adapter.report().message

    def close(self):
        for link in self.links:
            link.close()


@pytest.fixture
def boards(bench):
    made = []

    def start(*arguments, **values):
        made.append(Boards(bench, *arguments, **values))
        return made[-1]

    yield start
    for each in made:
        each.close()


def test_a_device_all_of_whose_samples_are_refused_is_not_said_to_be_silent(boards, clock, capfd):
    sending = boards()
    sending.send()
    sending.bench.until(lambda: len(sending.adapter.samples) == ROUND, "samples")
    sending.fault = lambda k: "nan"
    clock.move_on(5.0)
    said = sending.until(ERROR, "nothing that came can be used for")
    assert Refusal.NOT_FINITE.words in said and "silent" not in said
    assert "nothing that came can be used" in capfd.readouterr().err


def test_a_device_that_never_sent_a_finite_sample_is_told_from_a_wrong_format(boards, clock):
    sending = boards()
    sending.fault = lambda k: "nan"
    clock.move_on(5.0)
    assert "check format" not in sending.until(ERROR, "nothing that came can be used for")


@pytest.mark.parametrize(
    ("fault", "every", "words"),
    [
        ("nan", 3, Refusal.NOT_FINITE.words),
        ("crc", 7, Refusal.BAD_CHECKSUM.words),
        ("lost", 10, Refusal.LOST.words),
        ("far", 5, Refusal.OUT_OF_RANGE.words),
    ],
)
def test_samples_that_are_refused_or_lost_are_a_warning_and_no_wrong_rate(
    boards, clock, fault, every, words
):
    values = {"checks.rate": 200.0, "checks.rate_tolerance": 0.1, "checks.force_range": 1000.0}
    sending = boards(**values)
    sending.fault = lambda k: "" if k % every else fault
    said = sending.until(DiagnosticStatus.WARN, words)
    assert said.startswith("lost or refused of ")
    check = sending.adapter.node.check
    sending.rounds_until(lambda: len(check._intervals) > 100, "intervals")
    assert check.rate_hz == pytest.approx(200.0) and check.findings == []


@pytest.mark.parametrize("fault", ["nan", "crc", "lost", "far"])
def test_every_third_sample_that_is_missing_makes_no_lower_rate(fault):
    checks = CheckConfig(rate=200.0, force_range=1000.0)
    source = Source("udp://127.0.0.1:0?format=mcu", lambda samples: None, checks=checks)
    for k in range(900):
        if (what := "" if k % 3 else fault) != "lost":
            source._take(mcu(k, what), k)
    assert source.check.rate_hz == pytest.approx(200.0) and source.check.findings == []


def test_samples_of_a_topic_that_are_not_finite_make_no_lower_rate(bench):
    node = bench.add(ImuAdapterNode, {"source": "topic:///x", "checks.rate": 200.0})
    for k in range(900):
        values = STANDING if k % 3 else STANDING * math.nan
        node._output.check(k * 5_000_000, values + 1e-3 * math.sin(k))
    assert node.check.rate_hz == pytest.approx(200.0)


def test_two_boards_on_one_port_are_named_with_what_to_do(boards, clock, capfd):
    sending = boards(hosts=("127.0.0.1", "127.0.0.1"))
    said = sending.until(DiagnosticStatus.WARN, "2 devices send to one port")
    assert all(f"{name} (" in said for name in sending.names)
    assert "a port of its own" in said and "peers" in said
    assert status_values(sending.adapter.reports[-1])["senders"] == "2"
    sending.links.pop().close()
    sending.rounds_until(lambda: not sending.adapter.says(WARN, "2 devices"), "one board")
    log = capfd.readouterr().err
    assert log.count("2 devices send to one port") == 1 and "lost on the way" not in log


def test_datagrams_of_a_stranger_only_are_said_with_his_address(boards, clock):
    sending = boards("&peers=127.0.0.7")
    clock.move_on(5.0)
    said = sending.until(ERROR, "accepts nothing: it received ")
    assert "datagrams from 127.0.0.1," in said and "peers (127.0.0.7)" in said
    assert "from 127.0.0.1" in status_values(sending.adapter.reports[-1])["foreign senders"]


def test_a_sensor_that_freezes_is_logged_once(bench, clock, tmp_path, capfd):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 20) + frames.frame("mcu", 20) * 200)
    adapter = Adapter(bench, f"file://{path}?format=mcu&speed=0&follow=true")
    bench.until(lambda: adapter.says(WARN, "the sensor is stuck"), "a report")
    count = len(adapter.reports)
    bench.until(lambda: len(adapter.reports) > count + 3, "more reports")
    assert capfd.readouterr().err.count("the sensor is stuck") == 1


def test_a_damaged_capture_ends_with_what_was_refused(bench, tmp_path, capfd):
    path = tmp_path / "capture.bin"
    broken = [mcu(k, "crc" if k % 20 == 7 else "") for k in range(100) if k != 50]
    path.write_bytes(b"".join(broken) + b"half a frame")
    adapter = Adapter(bench, f"file://{path}?format=mcu&speed=0")
    bench.until(adapter.node.done.done, "the end of the file")
    (line,) = (each for each in capfd.readouterr().err.splitlines() if "is over" in each)
    assert "played 94 samples, the file is over; lost or refused: lost on the way (1)" in line
    assert f"{Refusal.BAD_CHECKSUM.words} (5)" in line


def test_a_device_that_goes_is_logged_once_each_time(bench, tmp_path, capfd):
    device = PluggedDevice(tmp_path / "ttyUSB0")
    values = {"stamp": "header", "input.silence": 0.3}
    adapter = Adapter(bench, f"serial://{device.path}?format=mcu&retry_max=0.1", **values)
    reader = adapter.node.device.source.reader
    for number in (1, 2):
        device.plug()
        bench.until(lambda: reader.state is State.CONNECTED, "the port")
        device.send(frames.stream("mcu", 20))
        bench.until(lambda n=number: len(adapter.samples) == 20 * n, "samples")
        tries = reader.counters["not_opened"]
        device.unplug()
        bench.until(lambda n=tries: reader.counters["not_opened"] > n + 6, "more tries")
        bench.until(lambda: adapter.says(ERROR, "is waiting: "), "a report")
    lines = capfd.readouterr().err.splitlines()
    lost = [each for each in lines if f"{device.path}?" in each and AGAIN in each]
    # One a time that it goes, a second one where the open port breaks before it is missed; and one
    # from before it was there, where that was seen.
    assert 2 <= len(lost) <= 5 < reader.counters["not_opened"]
    assert all("WARN" in each for each in lost)


def test_a_few_samples_that_are_lost_are_only_counted():
    losses, status = LossReport(), Status()
    losses.describe({"samples": 100, "lost": 3}, status)
    assert status.level == OK
    losses.describe({"samples": 200, "lost": 8}, status)
    assert (status.level, status.message) == (
        WARN,
        "lost or refused of 105 samples since the last report: lost on the way (5)",
    )


def test_a_frame_with_a_wrong_checksum_is_not_said_to_be_lost_as_well():
    losses, status = LossReport(), Status()
    losses.describe({"samples": 90, "lost": 10, "bad_checksum": 10}, status)
    assert status.message == (
        "lost or refused of 100 samples since the last report: a wrong checksum (10)"
    )


def test_counts_are_put_in_words():
    assert in_words({"lost": 2, "garbage_bytes": 7}) == (
        "lost on the way (2), bytes that belong to no frame (7)"
    )
    assert in_words({"samples": 100, "lost": 0}) == ""
