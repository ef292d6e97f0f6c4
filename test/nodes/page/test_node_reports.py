"""What the nodes report, as the page reads it."""

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from dualfoot_ros.nodes.page.node_reports import NodeReports
from dualfoot_ros.nodes.ros.status import OK, WARN


def report(node, values, level=OK, message="ok"):
    pairs = [KeyValue(key=key, value=str(value)) for key, value in values.items()]
    status = DiagnosticStatus(level=level, name=node, message=message, values=pairs)
    return DiagnosticArray(status=[status])


def counts(received, lost=0, names=("/left/imu/data_raw", "/right/imu/data_raw"), **values):
    counted = {}
    for name in names:
        counted |= {f"received {name}": received, f"lost {name}": lost}
    return {**counted, "left foot": "OK", "right foot": "OK", **values}


@pytest.mark.parametrize("names", [("/left/imu/data_raw", "/right/imu/data_raw"), ("/a", "/b")])
def test_rate_and_losses_of_a_foot_are_counted_between_reports(clock, names):
    reports = NodeReports("/")
    reports.take(report("fusion", counts(100, names=names)))
    clock.move_on(2.0)
    reports.take(report("fusion", counts(300, 4, names=names)))
    left, right = reports.foot("left"), reports.foot("right")
    assert left["rate"] == right["rate"] == pytest.approx(100.0)
    assert left["lost"] == 4 and left["received"] == 300


def test_a_report_out_of_turn_does_not_spoil_the_rate(clock):
    reports = NodeReports("/")
    reports.take(report("fusion", counts(100)))
    clock.move_on(1.0)
    reports.take(report("fusion", counts(200)))
    clock.move_on(0.001)
    reports.take(report("fusion", counts(205)))
    assert reports.foot("left")["rate"] == pytest.approx(100.0)
    clock.move_on(0.999)
    reports.take(report("fusion", counts(300)))
    assert reports.foot("left")["rate"] == pytest.approx(100.0)


def test_what_arrives_is_counted_where_it_arrives_first(clock):
    reports = NodeReports("/")
    reports.take(report("fusion", counts(90)))
    reports.take(report("time_sync", counts(100, 7)))
    assert reports.foot("left")["lost"] == 7


def test_samples_that_a_slow_node_dropped_are_lost_too(clock):
    reports = NodeReports("/")
    reports.take(report("time_sync", counts(500, 3, **{"dropped /left/imu/data_raw": 215})))
    assert reports.foot("left")["lost"] == 218
    assert reports.foot("right")["lost"] == 3


@pytest.mark.parametrize(
    ("values", "state"),
    [
        ({"phase": "aligning"}, "aligning"),
        ({"phase": "walking"}, "tracking"),
        ({"phase": "walking", "left foot": "STALE"}, "STALE"),
        ({"phase": "walking", "left foot": "UNUSED"}, "UNUSED"),
    ],
)
def test_the_state_of_a_foot_is_that_which_fusion_reports(clock, values, state):
    reports = NodeReports("/")
    reports.take(report("fusion", counts(1, **values)))
    assert reports.foot("left")["state"] == state


def test_a_foot_of_which_nobody_reports_has_no_state(clock):
    assert NodeReports("/").foot("left")["state"] == "no report"


def test_the_only_foot_in_use_has_its_counts_and_the_other_has_none(clock):
    reports = NodeReports("/")
    values = counts(50, names=("/right/imu/data_raw",)) | {"left foot": "UNUSED"}
    reports.take(report("fusion", values))
    assert reports.foot("right")["received"] == 50
    assert reports.foot("left")["received"] is None


def test_warnings_are_those_of_this_namespace_only(clock):
    reports = NodeReports("/anna")
    reports.take(report("anna/fusion", {}, WARN, "no stance of the left foot"))
    reports.take(report("bob/fusion", {}, WARN, "other"))
    reports.take(report("fusion", {}, WARN, "other"))
    reports.take(report("anna/camera", {}, WARN, "other"))
    found = reports.warnings()
    assert found == [{"node": "fusion", "text": "no stance of the left foot"}]


def test_a_node_that_reports_no_more_is_said_and_its_state_is_not_shown(clock):
    reports = NodeReports("/")
    reports.take(report("fusion", counts(1, phase="walking")))
    clock.move_on(6.0)
    assert reports.foot("left")["state"] == "no report"
    assert "has not reported" in reports.warnings()[0]["text"]


def test_the_battery_that_an_adapter_reports_is_shown(clock):
    reports = NodeReports("/")
    reports.take(report("left/imu_adapter", {"battery (%)": "81"}))
    assert reports.foot("left")["battery"] == 81.0
    assert reports.foot("right")["battery"] is None


def test_a_value_that_is_no_number_is_none(clock):
    reports = NodeReports("/")
    reports.take(report("fusion", {"lag (s)": "unknown: the stamps are of another clock"}))
    assert reports.number("fusion", "lag (s)") is None
