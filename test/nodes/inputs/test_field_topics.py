"""The magnetic field through the nodes: live is offline, devices send theirs, bad is counted."""

import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from drivers import frames
from drivers.links import PluggedDevice
from sensor_msgs.msg import Imu, MagneticField

from dualfoot_ros.core import EventKind, TrackerConfig
from dualfoot_ros.core.tracker import fields_of
from dualfoot_ros.drivers import State
from dualfoot_ros.evaluation import as_live, track
from dualfoot_ros.nodes.demo.live_graph import run_live, same_bits
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.playback.player import Sample
from dualfoot_ros.nodes.replay import ReplayNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import imu_values, set_time, to_ns
from dualfoot_ros.recording import Recording, read_bag, write_bag
from dualfoot_ros.settings.nodes import InputConfig
from dualfoot_ros.simulation import MagnetometerConfig, WalkConfig, simulate

from ..samples import STANDING, imu, status_values

ON = {"aids.magnetic_heading": True, "engine": "compiled", "reports.period": 0.1}
FEET = ("left", "right")
COUNT = 1080  # samples of each foot


@pytest.fixture(scope="module")
def felt(tmp_path_factory):
    """Return a bag of the first 18 s of a walk with a magnetometer on each foot."""
    walk = WalkConfig(route="L", rate=60.0, standing=2.5)
    made = simulate(walk, seed=1, magnetometer=MagnetometerConfig())
    path = tmp_path_factory.mktemp("felt") / "walk"
    return write_bag(path, Recording(made.left[:COUNT], made.right[:COUNT]))


def vector(message):
    b = message.magnetic_field
    return [b.x, b.y, b.z]


def test_a_walk_through_the_nodes_is_the_offline_run_to_the_bit(context, felt):
    config = TrackerConfig.from_mapping({"aids.magnetic_heading": True})
    live, recording = run_live(felt, {"on": config}, context)["on"], read_bag(felt)
    batch = track(recording, as_live(config))
    assert live.lost == 0
    assert same_bits(live.trajectory, batch)
    aids = live.trajectory.of_kind(EventKind.AID)
    assert [(e.stamp_ns, e.accepted, e.detail["angle"]) for e in aids] == [
        (e.stamp_ns, e.accepted, e.detail["angle"]) for e in batch.of_kind(EventKind.AID)
    ]
    assert sum(event.accepted for event in aids) > 10
    assert live.counters["fields"] == len(recording.left) + len(recording.right)


def test_replay_publishes_the_fields_of_a_bag_to_the_bit(bench, felt):
    probe, got = bench.plain(), {foot: [] for foot in FEET}
    for foot, found in got.items():
        name = f"{foot}/imu/mag"
        probe.create_subscription(MagneticField, name, found.append, qos.sensor(20_000))
    values = {"bag": str(felt), "play.rate": 1000.0, "play.wait": 0.0, "play.delay": 0.5}
    replay = bench.add(ReplayNode, values)
    bench.until(replay.done.done, "the end of the bag")
    recording = read_bag(felt)
    for foot, field in fields_of(recording.left, recording.right).items():
        bench.until(lambda f=foot, whole=field: len(got[f]) == len(whole), "all fields")
        assert [to_ns(m.header.stamp) for m in got[foot]] == field.stamp_ns.tolist()
        assert [vector(m) for m in got[foot]] == field.tesla.tolist()
        assert {m.header.frame_id for m in got[foot]} == {f"{foot}_imu"}


def test_a_device_publishes_its_field_turned_and_stamped_as_its_sample(bench, tmp_path):
    device = PluggedDevice(tmp_path / "ttyUSB0")
    device.plug()
    probe, samples, fields = bench.plain(), [], []
    probe.create_subscription(Imu, "/left/imu/data_raw", samples.append, qos.sensor(1000))
    probe.create_subscription(MagneticField, "/left/imu/mag", fields.append, qos.sensor(1000))
    source = f"serial://{device.path}?baud=921600&format=mcu"
    values = {"source": source, "mounting.axes": "y,-x,z", "stamp": "header", "stamp_offset": 2.0}
    node = bench.add(ImuAdapterNode, {**values, "reports.period": 0.1}, namespace="left")
    bench.until(
        lambda: (
            node.device.source.reader.state is State.CONNECTED
            and all(probe.count_publishers(f"/left/imu/{name}") for name in ("data_raw", "mag"))
        ),
        "the port",
    )
    field = (20e-6, -5e-6, -43e-6)
    device.send(b"".join(frames.mcu(k, field=field if k % 2 else None) for k in range(20)))
    bench.until(lambda: len(samples) == 20 and len(fields) == 10, "samples and fields")
    stamps = [to_ns(m.header.stamp) for m in samples]
    assert [to_ns(m.header.stamp) for m in fields] == stamps[1::2]
    np.testing.assert_allclose(vector(fields[3]), [-5e-6, -20e-6, -43e-6], atol=1e-9)
    assert fields[0].header.frame_id == samples[0].header.frame_id == "left_imu"
    device.unplug()


def test_a_foot_of_a_bag_is_played_with_its_field(bench, felt):
    probe, samples, fields = bench.plain(), [], []
    probe.create_subscription(Imu, "/right/imu/data_raw", samples.append, qos.sensor(20_000))
    probe.create_subscription(MagneticField, "/right/imu/mag", fields.append, qos.sensor(20_000))
    values = {"source": f"file://{felt}", "play.rate": 1000.0, "mounting.yaw": math.pi}
    values |= {"play.delay": 0.5, "stamp_offset": 1.0}
    node = bench.add(ImuAdapterNode, values, namespace="right")
    bench.until(node.done.done, "the end of the file")
    series = read_bag(felt).right
    bench.until(lambda: len(samples) == len(fields) == len(series), "all samples and fields")
    expected = series.magnetic_field * [-1.0, -1.0, 1.0]
    np.testing.assert_allclose([vector(m) for m in fields], expected, atol=1e-12)
    expected = series.specific_force * [-1.0, -1.0, 1.0]
    np.testing.assert_allclose([imu_values(m)[:3] for m in samples], expected, atol=1e-9)
    stamps = series.stamp_ns + 10**9
    for got in (samples, fields):
        assert [to_ns(m.header.stamp) for m in got] == stamps.tolist()


def test_a_field_of_a_file_waits_like_its_sample_until_the_clock_is_known(bench, felt):
    values = {"source": f"file://{felt}", "play.wait": 3600.0, "stamp": "device"}
    node = bench.add(ImuAdapterNode, values, namespace="left")
    node.stamper.stamp = lambda foot, header_ns, arrival_ns: (
        header_ns + 7 if header_ns > 2 else None
    )
    stamps = []
    node.field.publish = lambda stamp_ns, tesla: stamps.append(stamp_ns)
    for k in range(5):
        for name, sample in (("left", STANDING), ("imu/mag", np.full(3, 2e-5))):
            node._play(Sample(k, name, k, sample))
    assert stamps == [10, 11] and node.counters["relayed"] == 2


class Feet:
    """Sends the samples and the field of the left foot to a fusion node; keeps its reports."""

    def __init__(self, bench, values=ON):
        self.bench, self.reports = bench, []
        self.fusion = bench.add(FusionNode, values)
        probe = bench.plain()
        probe.create_subscription(
            DiagnosticArray, "/diagnostics", self.reports.append, qos.result(1000)
        )
        self._field = probe.create_publisher(MagneticField, "left/imu/mag", qos.sensor(1000))
        self._imu = probe.create_publisher(Imu, "left/imu/data_raw", qos.sensor(1000))

    def connect(self):
        both = self._field, self._imu
        self.bench.until(lambda: all(p.get_subscription_count() for p in both), "discovery")
        return self

    def send(self, stamp_ns, tesla):
        message = MagneticField()
        set_time(message.header.stamp, stamp_ns)
        b = message.magnetic_field
        b.x, b.y, b.z = tesla
        self._field.publish(message)

    def sample(self, stamp_ns):
        before = self.fusion.streams.inputs["left"].received
        self._imu.publish(imu(stamp_ns))
        self.bench.until(lambda: self.fusion.streams.inputs["left"].received > before, "a sample")

    def reported(self, key, value):
        def newest():
            return status_values(self.reports[-1]) if self.reports else {}

        self.bench.until(lambda: newest().get(key) == value, f"{key} = {value}")
        return newest()


def test_bad_fields_are_counted_by_name_in_the_diagnostics(bench):
    feet = Feet(bench).connect()
    for k in range(3):
        feet.send(10**12 + k, [1e-5, 1e-5, -4e-5])
    feet.send(10**12, [1e-5, 1e-5, -4e-5])
    for bad in ([math.nan, 0.0, 0.0], [0.0, 0.0, 0.0], [0.1, 0.1, -0.4]):
        feet.send(10**12 + 10, bad)
    bench.until(lambda: feet.fusion.fields.received == 7, "seven fields")
    values = feet.reported("tracker field_out_of_range", "3")
    assert values["tracker fields"] == "3" and values["tracker field_out_of_order"] == "1"
    assert values["received /left/imu/mag"] == "7"


def test_a_field_gets_the_stamp_its_sample_gets_and_none_before_that_is_known(bench):
    """With arrival stamps nothing is known of a field before the first sample."""
    taken, feet = [], Feet(bench, {**ON, "stamping.left": "arrival"}).connect()
    feet.fusion.fields._take = lambda foot, stamp_ns, tesla: taken.append(stamp_ns)
    feet.send(5_000, [1e-5, 1e-5, -4e-5])
    bench.until(lambda: feet.fusion.fields.received == 1, "a field")
    feet.sample(10_000)
    stamped = feet.fusion.streams.inputs["left"].arrival_ns
    feet.send(10_007, [1e-5, 1e-5, -4e-5])
    bench.until(lambda: feet.fusion.fields.received == 2, "another")
    assert taken == [stamped + 7]


def test_an_aid_without_a_field_is_said_for_each_foot(bench, clock):
    feet = Feet(bench, {**ON, "input.silence": 0.3}).connect()
    fields, quick = feet.fusion.fields.feet, InputConfig(silence=0.3)
    clock.move_on(1.0)
    bench.until(lambda: all(each.complaint(quick) for each in fields.values()), "complaints")
    said = fields["right"].complaint(quick).text
    assert said.startswith("aids.magnetic_heading is on but there is no magnetic field of the r")
    assert said.endswith("topic '/right/imu/mag' has no publisher")
    feet.send(10**12, [1e-5, 1e-5, -4e-5])
    bench.until(lambda: fields["left"].complaint(quick) is None, "no complaint")


def test_without_the_aid_nobody_listens_to_the_field(bench):
    feet = Feet(bench, {**ON, "aids.magnetic_heading": False})
    assert feet.fusion.fields is None
    bench.until(lambda: feet.reports, "a report")
    assert feet.fusion.count_subscribers("/left/imu/mag") == 0


def test_bringup_records_the_field_that_fusion_uses(program, felt, tmp_path):
    """No queue is shorter than the bag, so nothing is lost however slow the machine is."""
    whole, target = read_bag(felt), tmp_path / "result"
    left, right = whole.left[:240], whole.right[:240]
    bag = write_bag(tmp_path / "bag", Recording(left, right))
    running = program(
        "bringup", "--ros-args", "-p", f"bag:={bag}", "-p", f"record:={target}",
        "-p", "play.rate:=20.0", "-p", "engine:=compiled", "-p", "aids.magnetic_heading:=true",
        "-p", "input.depth:=10000",
    )  # fmt: skip
    assert running.code() == 0, running.output
    played, recorded = left.field, read_bag(target).left.field
    np.testing.assert_array_equal(recorded.tesla, played.tesla)
