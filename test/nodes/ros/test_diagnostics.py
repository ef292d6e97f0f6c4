import pytest

from dualfoot_ros.inspection import Finding, FindingKind, Severity
from dualfoot_ros.nodes.ros.diagnostics import OVER_S, Beginnings, to_message
from dualfoot_ros.nodes.ros.status import ERROR, OK, WARN, Status

STUCK = Finding(FindingKind.STUCK, Severity.WARNING, "it is stuck", about="sensor")
WORSE = Finding(FindingKind.STUCK, Severity.ERROR, "it is broken", "get one", "sensor")
OTHER = Finding(FindingKind.STUCK, Severity.WARNING, "one axis is stuck", about="axis")


def test_a_finding_is_logged_once_until_it_has_stayed_away():
    beginnings = Beginnings()
    assert beginnings.select([STUCK], 0.0) == [STUCK]
    assert beginnings.select([STUCK], 1.0) == beginnings.select([], 2.0) == []
    assert beginnings.select([STUCK], 0.9 * OVER_S) == []
    assert beginnings.select([WORSE], 0.95 * OVER_S) == [WORSE]
    assert beginnings.select([STUCK], 3.0 * OVER_S) == [STUCK]


def test_findings_of_one_kind_about_different_things_are_logged_each():
    assert Beginnings().select([STUCK, OTHER], 0.0) == [STUCK, OTHER]


def test_a_finding_that_is_for_the_report_only_is_not_logged():
    only = Finding(FindingKind.NOT_BEGUN, Severity.WARNING, "no sample yet", about="/imu")
    assert Beginnings().select([only], 0.0) == []


@pytest.mark.parametrize(
    ("findings", "level", "message"),
    [
        ([], OK, "ok"),
        ([STUCK, OTHER], WARN, "it is stuck"),
        ([STUCK, OTHER, WORSE], ERROR, "it is broken; get one"),
    ],
)
def test_the_first_of_the_worst_findings_is_the_message(findings, level, message):
    status = Status({"rate": 1.0 / 3.0})
    for finding in findings:
        status.note(finding)
    sent = to_message("node", status)
    assert (sent.level, sent.message) == (level, message)
    assert [(pair.key, pair.value) for pair in sent.values] == [("rate", "0.333333")]
