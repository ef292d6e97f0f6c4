"""Two feet whose stamps are far apart: which one, by how much and what to do."""

import numpy as np
import pytest

from dualfoot_ros.inspection import FindingKind, Severity
from dualfoot_ros.nodes.inputs import stamp_gap as module
from dualfoot_ros.nodes.inputs.stamp_gap import StampGap
from dualfoot_ros.nodes.ros.status import ERROR, OK, WARN, Status
from dualfoot_ros.timing import Aligner

from ..samples import STANDING, STEP_NS
from ..test_fusion import FEET, Walker


class Bench:
    """Feet that deliver in real time, by a wall clock of our own."""

    def __init__(self, monkeypatch):
        self.aligner, self.now_s = Aligner(), 0.0
        self.gap = StampGap(self.aligner)
        self.stamp_ns = dict.fromkeys(FEET, 10**12)
        monkeypatch.setattr(module.time, "monotonic", lambda: self.now_s)

    def run(self, seconds, feet=FEET, broken=""):
        """Let the feet deliver for that time; return the last report of one a second.

        The samples of the foot that is ``broken`` are not finite.
        """
        status = Status()
        for k in range(round(seconds * 1e9 / STEP_NS)):
            self.now_s += 1e-9 * STEP_NS
            for foot in feet:
                self.stamp_ns[foot] += STEP_NS
                self.gap.observe(foot, self.stamp_ns[foot])
                values = STANDING * (np.nan if foot == broken else 1.0)
                self.aligner.push(foot, self.stamp_ns[foot], values)
            if k % 100 == 99:
                status = Status()
                self.gap.describe(status)
        return status


@pytest.fixture
def feet(monkeypatch):
    return Bench(monkeypatch)


@pytest.mark.parametrize("behind", FEET)
def test_feet_that_never_pair_are_an_error_with_foot_difference_and_remedy(feet, behind):
    feet.stamp_ns[behind] -= 162_500_000_000
    status = feet.run(5.0)
    assert feet.aligner.pairs_of_both == 0 and status.level == ERROR
    assert f"the {behind} foot are 162.5 s behind" in status.message
    sign = 1.0 if behind == "right" else -1.0
    assert f"add {sign * 162.5:.3f} s with stamping.right_offset" in status.message
    for remedy in ("stamping.left and stamping.right to device", "dualfoot sync"):
        assert remedy in status.message
    (finding,) = status.of_kind(FindingKind.STAMPS_APART)
    assert finding.kind.logged_once
    found = status.values["right less left, newest stamps (s)"]
    assert found == pytest.approx(-sign * 162.5, abs=0.02)


def test_the_offset_that_is_named_brings_the_feet_together(feet):
    feet.stamp_ns["right"] += 40_000_000_000
    offset_s = float(feet.run(5.0).message.split("add ")[1].split(" s ")[0])
    feet.aligner.reset()
    feet.stamp_ns["right"] += round(1e9 * offset_s)
    assert feet.run(5.0).level == OK and feet.aligner.pairs_of_both > 300


def test_feet_in_time_raise_no_finding(feet):
    assert feet.run(5.0).level == OK


def test_a_foot_that_falls_silent_is_not_said_to_be_behind(feet):
    feet.run(5.0)
    for _ in range(10):
        assert "no pairs" not in feet.run(1.0, feet=("left",)).message


def test_a_foot_that_is_now_and_then_too_late_is_a_warning_with_its_name(feet):
    feet.run(3.0)
    feet.run(1.2, feet=("left",))
    status = feet.run(1.0)
    assert status.level == WARN and "samples of the right foot come too late" in status.message
    assert "aligner.max_delay is 0.5 s" in status.message


def test_feet_that_deliver_and_never_pair_for_another_reason_are_said_with_it(feet):
    feet.run(1.0)
    assert feet.run(1.99, broken="right").level == OK
    status = feet.run(1.01, broken="right")  # the first report after two seconds
    (finding,) = status.of_kind(FindingKind.NO_PAIRS)
    assert finding.severity is Severity.ERROR
    assert "values that are not finite, of the right foot" in finding.text


def test_fusion_says_it_in_diagnostics_and_log(bench, clock, capfd):
    walker, stamp_ns = Walker(bench), 10**12
    for _ in range(5):
        for _ in range(100):
            clock.move_on(1e-9 * STEP_NS)
            stamp_ns += STEP_NS
            walker.send("left", stamp_ns)
            walker.send("right", stamp_ns + 162_500_000_000)
        walker.taken()
        report = walker.report(lambda r: True)
    assert report.status[0].level == ERROR
    said = report.status[0].message
    assert "the stamps of the left foot are 162.5 s behind those of the right foot" in said
    assert capfd.readouterr().err.count("162.5 s behind those of the right") == 1


def test_fusion_does_not_blame_the_publisher_of_pairs_that_are_not_made(bench, clock):
    walker = Walker(bench, {"sync": "external", "input.silence": 0.2, "input.first": 0.4})
    clock.move_on(1.0)
    report = walker.report(lambda r: "no sample came for" in r.status[0].message)
    assert "as time_sync, reports in /diagnostics why" in report.status[0].message
