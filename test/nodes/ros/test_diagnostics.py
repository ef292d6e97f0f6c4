import pytest

from dualfoot_ros.inspection import Finding, FindingKind, Severity
from dualfoot_ros.nodes.ros.diagnostics import OVER_S, FindingMemory, to_message
from dualfoot_ros.nodes.ros.status import ERROR, OK, WARN, Status

STUCK = Finding(FindingKind.STUCK, Severity.WARNING, "it is stuck", about="sensor")
WORSE = Finding(FindingKind.STUCK, Severity.ERROR, "it is broken", "get one", "sensor")
OTHER = Finding(FindingKind.STUCK, Severity.WARNING, "one axis is stuck", about="axis")


def test_a_finding_is_logged_once_when_it_begins_and_once_when_it_is_over():
    memory = FindingMemory()
    nothing = ([], [])
    assert memory.update([STUCK], 0.0) == ([STUCK], [])
    assert memory.update([STUCK], 1.0) == memory.update([], 2.0) == nothing
    assert memory.update([STUCK], 0.9 * OVER_S) == nothing
    assert memory.update([WORSE], 0.95 * OVER_S) == ([WORSE], [])
    assert memory.update([STUCK], 1.0 * OVER_S) == nothing
    assert memory.update([], 1.9 * OVER_S) == nothing
    assert memory.update([], 2.1 * OVER_S) == ([], [WORSE])
    assert memory.update([], 2.2 * OVER_S) == nothing
    assert memory.update([STUCK], 3.0 * OVER_S) == ([STUCK], [])


def test_findings_of_one_kind_about_different_things_are_logged_each():
    memory = FindingMemory()
    assert memory.update([STUCK, OTHER], 0.0).begun == [STUCK, OTHER]
    assert memory.update([OTHER], OVER_S).over == [STUCK]


def test_what_happened_at_a_moment_is_never_over():
    memory = FindingMemory()
    moment = Finding(FindingKind.CLOCK_SET, Severity.WARNING, "a clock was set", about="left")
    assert memory.update([moment], 0.0).begun == [moment]
    assert memory.update([], 2.0 * OVER_S) == ([], [])


def test_a_finding_that_is_for_the_report_only_is_not_logged():
    only = Finding(FindingKind.NOT_BEGUN, Severity.WARNING, "no sample yet", about="/imu")
    memory = FindingMemory()
    assert memory.update([only], 0.0) == memory.update([], 2.0 * OVER_S) == ([], [])


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
