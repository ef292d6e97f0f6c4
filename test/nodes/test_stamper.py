import pytest

from dualfoot_ros.nodes.diagnostics import ERROR, OK, WARN, Status
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.stamper import Stamper
from dualfoot_ros.timing import ClockModel, Stamping

from .samples import imu

STEP_NS = 10_000_000
HOUR_NS = 3600 * 10**9


def fed(skew_ppm, seconds, **policies):
    """Return a stamper that was fed one foot with a clock an hour behind the host's."""
    stamper = Stamper(Stamping(**policies), ClockModel())
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


def test_a_skew_beyond_the_limit_is_reported_with_the_limit_and_no_stamp_is_given():
    stamper, found = fed(15_000.0, 20, left="device")
    status = described(stamper)
    assert found[-1] is None and stamper.counters["not_stamped"] > 0
    assert status.level == ERROR
    assert "left foot is off by 15" in status.message and "beyond 10000 ppm" in status.message


def test_a_time_that_no_message_can_hold_is_refused_and_counted():
    stamper = Stamper(Stamping(), ClockModel())
    assert stamper.stamp("left", -1, 0) is None
    assert stamper.stamp("left", 1 << 62, 0) is None
    assert stamper.counters == {"not_stamped": 2}
    assert described(stamper).level == WARN and described(stamper).level == OK


def test_one_clock_for_both_feet_keeps_the_difference_of_their_links_out():
    stamper = Stamper(Stamping(left="device", right="device", agreement="shared"), ClockModel())
    for k in range(2000):
        left = stamper.stamp("left", k * STEP_NS, HOUR_NS + k * STEP_NS)
        right = stamper.stamp("right", k * STEP_NS, HOUR_NS + k * STEP_NS + 30_000_000)
    assert abs(left - right) < 1_000


def test_fusion_takes_the_policies_for_raw_streams_and_not_again_for_synchronised_ones(bench):
    seen = []
    for sync in ("internal", "external"):
        node = bench.add(FusionNode, {"sync": sync, "stamping.right_offset": 2.0}, namespace=sync)
        node.aligner.push = lambda foot, stamp_ns, values: seen.append(stamp_ns) or []
        node._receiver("right")(imu(7))
    assert seen == [2 * 10**9 + 7, 7]
