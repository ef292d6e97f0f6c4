"""A foot that is silent or late: stale within 0.2 s of data, and back with its first pair."""

import pytest

from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.nodes.inputs.foot_states import FootStates
from dualfoot_ros.nodes.ros.status import OK, WARN, Status
from dualfoot_ros.timing import Aligner

from ..samples import STANDING, STEP_NS

FEET = ("left", "right")


class Bench:
    def __init__(self, feet=FEET):
        self.aligner = Aligner(feet=feet)
        self.states = FootStates(self.aligner, feet)
        self.k = 0

    def run(self, seconds, feet=FEET, late_s=0.0):
        """Let the feet deliver, the right one late; return when states changed, s."""
        changes = []
        for i in range(round(seconds * 1e9 / STEP_NS)):
            self.k += 1
            for foot in feet:
                late = round(late_s * 1e9 / STEP_NS) if foot == "right" else 0
                self.aligner.push(foot, (self.k - late) * STEP_NS, STANDING)
                if self.states.observe():
                    changes.append((i + 1) * STEP_NS * 1e-9)
        return changes

    def status(self):
        status = Status()
        self.states.describe(status)
        return status


@pytest.mark.parametrize("silent", FEET)
def test_a_silent_foot_is_stale_a_fifth_of_a_second_later_and_back_with_its_first_pair(silent):
    bench = Bench()
    assert bench.run(2.0) == []
    assert bench.status().level == OK and bench.status().values["state"] == "OK"
    (stale,) = bench.run(3.0, [foot for foot in FEET if foot != silent])
    assert stale == pytest.approx(0.2, abs=0.02)
    status = bench.status()
    assert status.values[f"{silent} foot"] == "STALE" and status.values["state"] == "DEGRADED"
    assert status.level == WARN
    (finding,) = status.of_kind(FindingKind.STALE_FOOT)
    assert finding.about == silent and f"the {silent} foot is STALE, 3.0 s behind" in finding.text
    (back,) = bench.run(1.0)
    assert back <= 0.03
    assert bench.status().level == OK


def test_a_foot_that_is_always_as_late_is_not_stale():
    bench = Bench()
    bench.run(5.0, late_s=0.3)
    assert bench.run(5.0, late_s=0.3) == []
    assert bench.status().level == OK


def test_a_foot_that_has_not_begun_is_stale():
    bench = Bench()
    assert len(bench.run(1.0, ["left"])) == 1
    assert bench.status().values["right foot"] == "STALE"


def test_a_foot_that_is_not_used_is_no_fault():
    bench = Bench(["left"])
    assert bench.run(1.0, ["left"]) == []
    assert bench.status().values["right foot"] == "UNUSED"
    assert bench.status().level == OK
