"""Air pressure through the nodes: live is offline, what is missing is said, bad is counted."""

import math
from functools import cache

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import FluidPressure

from dualfoot_ros.core import EventKind, PressureSeries, TrackerConfig
from dualfoot_ros.evaluation import as_live, track
from dualfoot_ros.nodes.demo.live_graph import run_live, same_bits
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.replay import ReplayNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import set_time, to_ns
from dualfoot_ros.recording import Recording, read_bag, write_bag
from dualfoot_ros.settings.nodes import InputConfig
from dualfoot_ros.simulation import BarometerConfig, WalkConfig, simulate

from ..samples import status_values

ON = {"aids.barometer": True, "engine": "compiled", "reports.period": 0.1}
COUNT = 900  # samples of each foot
QUICK = InputConfig(silence=0.3)


@cache
def climb(folder, worn):
    """Return a bag of the first 15 s of a walk on stairs with barometers."""
    walk = WalkConfig(route="stairs", rate=60.0, standing=2.5)
    made = simulate(walk, seed=1, barometer=BarometerConfig(worn=worn))
    end_ns = made.left.stamp_ns[COUNT]
    pressure = {}
    for key, each in made.pressure.items():
        count = np.searchsorted(each.stamp_ns, end_ns)
        pressure[key] = PressureSeries(each.stamp_ns[:count], each.pressure[:count])
    cut = Recording(made.left[:COUNT], made.right[:COUNT], pressure=pressure)
    return write_bag(folder / worn, cut)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return where the bags are."""
    return tmp_path_factory.mktemp("climbs")


@pytest.mark.parametrize("worn", ["feet", "body"])
def test_a_climb_through_the_nodes_is_the_offline_run_to_the_bit(context, folder, worn):
    bag = climb(folder, worn)
    on, off = (
        TrackerConfig.from_mapping({"method": "step_length", "aids.barometer": switch})
        for switch in (True, False)
    )
    live, recording = run_live(bag, {"on": on}, context)["on"], read_bag(bag)
    batch, without = track(recording, as_live(on)), track(recording, as_live(off))
    assert live.lost == 0
    assert same_bits(live.trajectory, batch)
    aids = live.trajectory.of_kind(EventKind.AID)
    assert [(e.stamp_ns, e.detail["height"]) for e in aids] == [
        (e.stamp_ns, e.detail["height"]) for e in batch.of_kind(EventKind.AID)
    ]
    assert len(aids) > 20
    assert live.counters["pressures"] == sum(map(len, recording.pressure.values()))
    heights = (each.left.position[-1, 2] for each in (live.trajectory, without))
    assert abs(np.subtract(*heights)) > 0.01


def test_replay_publishes_the_pressure_of_a_bag_to_the_bit(bench, folder):
    bag = climb(folder, "feet")
    probe, got = bench.plain(), {"left": [], "right": []}
    for foot, found in got.items():
        probe.create_subscription(
            FluidPressure, f"{foot}/pressure", found.append, qos.sensor(20_000)
        )
    values = {"bag": str(bag), "play.rate": 1000.0, "play.wait": 0.0, "play.delay": 0.5}
    replay = bench.add(ReplayNode, values)
    bench.until(replay.done.done, "the end of the bag")
    for foot, series in read_bag(bag).pressure.items():
        bench.until(lambda f=foot, whole=series: len(got[f]) == len(whole), "all samples")
        assert [to_ns(m.header.stamp) for m in got[foot]] == series.stamp_ns.tolist()
        assert [m.fluid_pressure for m in got[foot]] == series.pressure.tolist()


class Station:
    """Sends pressure to a fusion node and keeps its reports."""

    def __init__(self, bench, values=ON):
        self.bench, self.reports = bench, []
        self.fusion = bench.add(FusionNode, values)
        probe = bench.plain()
        probe.create_subscription(
            DiagnosticArray, "/diagnostics", self.reports.append, qos.result(1000)
        )
        self._out = probe.create_publisher(FluidPressure, "pressure", qos.sensor(1000))

    def connect(self):
        self.bench.until(self._out.get_subscription_count, "discovery")
        return self

    def send(self, stamp_ns, pascal):
        message = FluidPressure(fluid_pressure=pascal)
        set_time(message.header.stamp, stamp_ns)
        self._out.publish(message)

    def reported(self, key, value):
        """Wait for a report in which ``key`` has ``value``; return it."""

        def newest():
            return status_values(self.reports[-1]) if self.reports else {}

        self.bench.until(lambda: newest().get(key) == value, f"{key} = {value}")
        return self.reports[-1].status[0]


def test_bad_pressure_is_counted_by_name_in_the_diagnostics(bench):
    station = Station(bench).connect()
    for k in range(3):
        station.send(10**12 + k, 101325.0)
    station.send(10**12, 101325.0)
    for bad in (1013.25, math.nan):
        station.send(10**12 + 10, bad)
    bench.until(lambda: station.fusion.pressure.received == 6, "six samples")
    status = station.reported("tracker pressure_out_of_range", "2")
    values = {each.key: each.value for each in status.values}
    assert values["tracker pressures"] == "3"
    assert values["tracker pressure_out_of_order"] == "1"
    assert values["received /left/pressure or /right/pressure or /pressure"] == "6"


def test_a_barometer_that_is_on_without_pressure_is_said_and_one_sensor_is_enough(bench, clock):
    station = Station(bench, {**ON, "input.silence": 0.3}).connect()
    pressure = station.fusion.pressure
    clock.move_on(1.0)
    bench.until(lambda: pressure.complaint(QUICK) is not None, "a complaint")
    complaint = pressure.complaint(QUICK)
    said = complaint.text
    assert said.startswith("aids.barometer is on but there is no air pressure")
    assert "topic '/left/pressure' has no publisher" in said
    assert "topic '/pressure' has 1 publisher(s) but no sample yet" in said
    assert not complaint.is_error  # one sensor is enough, and it may yet begin
    assert pressure.complaint(InputConfig(silence=0.3, first=0.1)).is_error
    station.send(10**12, 101325.0)
    bench.until(lambda: pressure.complaint(QUICK) is None, "no complaint")


def test_without_the_aid_nobody_listens_to_pressure(bench):
    station = Station(bench, {**ON, "aids.barometer": False})
    assert station.fusion.pressure is None
    bench.until(lambda: station.reports, "a report")
    assert station.fusion.count_subscribers("/pressure") == 0


def test_bringup_records_the_pressure_that_fusion_uses(program, folder, tmp_path):
    bag, target = climb(folder, "body"), tmp_path / "result"
    running = program(
        "bringup", "--ros-args", "-p", f"bag:={bag}", "-p", f"record:={target}",
        "-p", "play.rate:=20.0", "-p", "engine:=compiled", "-p", "aids.barometer:=true",
        "-p", "input.depth:=10000",
    )  # fmt: skip
    assert running.code() == 0, running.output
    played, recorded = read_bag(bag).pressure["both"], read_bag(target).pressure["both"]
    np.testing.assert_array_equal(recorded.pressure, played.pressure)
