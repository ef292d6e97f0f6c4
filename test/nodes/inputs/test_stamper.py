import numpy as np
import pytest

from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.inputs.stamper import Stamper
from dualfoot_ros.nodes.ros.status import ERROR, OK, WARN, Status
from dualfoot_ros.nodes.time_sync import TimeSyncNode
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing import DeviceClockConfig, StampConfig

from ..samples import imu, imu_bytes

STEP_NS = 10_000_000
HOUR_NS = 3600 * 10**9


def fed(skew_ppm, seconds, **policies):
    """Return a stamper that was fed one foot with a clock an hour behind the host's."""
    stamper = Stamper(StampConfig(**policies), DeviceClockConfig())
    rate = 1.0 + 1e-6 * skew_ppm
    found = [
        stamper.stamp("left", round(k * STEP_NS * rate), HOUR_NS + k * STEP_NS)
        for k in range(100 * seconds)
    ]
    return stamper, found


def described(stamper):
    status = Status()
    stamper.describe(status)
    return status


def test_a_header_passes_with_its_offset_and_nothing_is_said_of_clocks():
    stamper, found = fed(0.0, 1, left_offset=0.5)
    assert found == [k * STEP_NS + 500_000_000 for k in range(100)]
    assert described(stamper).level == OK and "left skew (ppm)" not in described(stamper).values


def test_a_device_s_clock_is_told_with_offset_skew_and_their_uncertainty():
    stamper, found = fed(300.0, 20, left="device")
    values = described(stamper).values
    assert found[-1] == pytest.approx(HOUR_NS + 1999 * STEP_NS, abs=1e6)
    assert values["left clock"] == "tracking" and values["left clock resets"] == 0
    assert values["left skew (ppm)"] == pytest.approx(300.0, abs=20.0)
    assert 0.0 < values["left skew uncertainty (ppm)"] < 100.0
    assert float(values["left offset (s)"]) == pytest.approx(3600.0 - 0.006, abs=1e-3)
    assert 0.0 < values["left offset uncertainty (s)"] < 1e-3


def test_a_clock_that_is_being_learnt_is_said_to_be_and_its_samples_are_counted_apart():
    stamper, found = fed(30.0, 1, left="device")
    status = described(stamper)
    assert set(found) == {None} and stamper.counters == {"settling": 100, "not_stamped": 0}
    assert status.level == WARN
    assert status.message.startswith("the clock of the left foot is being learnt: 1.0 s so far")
    assert status.values["left clock"] == "settling" and status.values["settling"] == 100
    stamper, found = fed(30.0, 8, left="device")
    assert found[-1] is not None and stamper.counters["settling"] == found.count(None) < 300
    assert described(stamper).level == OK


def test_a_clock_that_is_learnt_for_too_long_is_said_to_have_another_unit():
    stamper = Stamper(StampConfig(left="device"), DeviceClockConfig())
    for k in range(3000):
        assert stamper.stamp("left", k * STEP_NS // 1000, HOUR_NS + k * STEP_NS) is None
    status = described(stamper)
    assert status.level == WARN and "30.0 s so far" in status.message
    assert "unit of its stamps" in status.message


def test_a_skew_beyond_the_limit_is_reported_with_the_limit_and_no_stamp_is_given():
    stamper, found = fed(15_000.0, 20, left="device")
    status = described(stamper)
    assert set(found) == {None} and stamper.counters["not_stamped"] > 0
    assert status.level == ERROR
    assert "left foot is off by 15" in status.message and "beyond 10000 ppm" in status.message
    (finding,) = status.of_kind(FindingKind.CLOCK_REFUSED)
    assert finding.kind.logged_once and finding.about == "left"
    assert finding.sentence == status.message


def test_a_time_that_no_message_can_hold_is_refused_and_counted():
    stamper = Stamper(StampConfig(), DeviceClockConfig())
    assert stamper.stamp("left", -1, 0) is None
    assert stamper.stamp("left", 1 << 62, 0) is None
    assert stamper.counters == {"settling": 0, "not_stamped": 2}
    assert described(stamper).level == WARN and described(stamper).level == OK


def test_one_clock_for_both_feet_keeps_the_difference_of_their_links_out():
    stamper = Stamper(
        StampConfig(left="device", right="device", agreement="shared"), DeviceClockConfig()
    )
    for k in range(2000):
        left = stamper.stamp("left", k * STEP_NS, HOUR_NS + k * STEP_NS)
        right = stamper.stamp("right", k * STEP_NS, HOUR_NS + k * STEP_NS + 30_000_000)
    assert abs(left - right) < 1_000


def test_fusion_takes_the_policies_for_raw_streams_and_not_again_for_synchronised_ones(bench):
    seen = []
    for sync in ("internal", "external"):
        node = bench.add(FusionNode, {"sync": sync, "stamping.right_offset": 2.0}, namespace=sync)
        node.streams.aligner.push = lambda foot, stamp_ns, *_: seen.append(stamp_ns) or []
        node.streams.receive("right", imu_bytes(7))
    assert seen == [2 * 10**9 + 7, 7]


@pytest.mark.parametrize("kind", [FusionNode, TimeSyncNode])
def test_no_node_hands_on_a_sample_before_the_clock_of_its_device_is_known(bench, kind):
    seen = []
    node = bench.add(kind, {"stamping.left": "device"})
    node.streams.aligner.push = lambda foot, stamp_ns, *_: seen.append(stamp_ns) or []
    for k in range(600):
        node.streams.inputs["left"].arrival_ns = HOUR_NS + k * STEP_NS
        node.streams.receive("left", imu_bytes(k * STEP_NS))
    begun = 600 - len(seen)
    assert 100 <= begun <= 300 and node.streams.stamper.counters["settling"] == begun
    assert seen[0] == pytest.approx(HOUR_NS + begun * STEP_NS, abs=5_000_000)


def test_an_adapter_publishes_no_sample_before_the_clock_of_its_device_is_known(bench):
    node = bench.add(ImuAdapterNode, {"stamp": "device"}, namespace="left")
    for k in range(600):
        node._input.arrival_ns = HOUR_NS + k * STEP_NS
        node._relay(imu(k * STEP_NS))
    withheld = node.stamper.counters["settling"]
    assert 100 <= withheld <= 300 and node.counters["relayed"] == 600 - withheld


def test_a_device_in_step_with_its_link_is_warned_of():
    """100 ms from notification to notification, 25 ms from event to event: nothing ever slips."""
    link, stamper = (
        BleLinkConfig(interval=0.025),
        Stamper(StampConfig(left="device"), DeviceClockConfig()),
    )
    sampled = np.arange(3000) * STEP_NS
    arrived = HOUR_NS + arrivals(link, sampled, np.random.default_rng(1))
    for k, (sampled_ns, arrived_ns) in enumerate(zip(sampled, arrived, strict=True)):
        stamper.stamp("left", int(sampled_ns), int(arrived_ns))
        if k == 1500:
            assert described(stamper).level == OK  # it may slip yet
    status = described(stamper)
    assert status.level == WARN
    assert "in step with its link, which delivers every 0.0250 s" in status.message
    assert status.values["left link interval (s)"] == pytest.approx(0.025, rel=1e-4)
