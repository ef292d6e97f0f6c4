"""Stamps that are zero, equal or uneven, and clocks that were set, are said of the right foot."""

import numpy as np
import pytest

from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.nodes.inputs.stamp_checks import StampChecks
from dualfoot_ros.nodes.ros.status import Status
from dualfoot_ros.timing import Aligner

from ..samples import STANDING, STEP_NS

FEET = ("left", "right")
START_NS = 10**18


def found(stamp, policy="header", seconds=10):
    """Let both feet deliver, the right one with ``stamp(k)``; return the findings of a report."""
    aligner = Aligner()
    checks = StampChecks(aligner, lambda _: policy)
    for k in range(100 * seconds):
        for foot, at in (("left", START_NS + k * STEP_NS), ("right", stamp(k))):
            checks.observe(foot, at, at)
            aligner.push(foot, at, STANDING)
    status = Status()
    checks.describe(status)
    return {(f.kind, f.about): f for f in status.findings}


def test_even_stamps_raise_no_finding():
    assert found(lambda k: START_NS + k * STEP_NS) == {}


def test_lost_samples_are_no_jitter():
    rng = np.random.default_rng(0)
    lost = np.cumsum(1 + (rng.random(1000) < 0.04))
    assert found(lambda k: START_NS + int(lost[k]) * STEP_NS) == {}


def test_zero_stamps_are_said_with_the_remedy():
    ((key, finding),) = found(lambda k: 0).items()
    assert key == (FindingKind.ZERO_STAMPS, "right")
    assert "set stamping.right to even" in finding.remedy


@pytest.mark.parametrize("policy", ["arrival", "even"])
def test_zero_stamps_are_nothing_to_warn_of_where_none_are_needed(policy):
    zero = (FindingKind.ZERO_STAMPS, "right")
    assert zero not in found(lambda k: 0, policy) and zero in found(lambda k: 0, "device")


def test_samples_that_are_bunched_on_one_stamp_are_said():
    findings = found(lambda k: START_NS + k // 10 * 10 * STEP_NS)
    finding = findings[FindingKind.EQUAL_STAMPS, "right"]
    assert "900 of 1000 samples of the right foot" in finding.text


def test_stamps_that_jitter_as_arrivals_do_are_said_with_the_figure():
    late = np.random.default_rng(1).exponential(6e6, 1000)
    arrived = np.maximum.accumulate(START_NS + np.arange(1000) * STEP_NS + late.astype(np.int64))
    finding = found(lambda k: int(arrived[k]) + k)[FindingKind.JITTER, "right"]
    assert "uneven by 9.3 ms" in finding.text and "times of arrival" in finding.text


@pytest.mark.parametrize("jump_s", [-3600, 3600])
def test_a_clock_that_is_set_is_said_of_its_foot(jump_s):
    findings = found(lambda k: START_NS + k * STEP_NS + (jump_s * 10**9 if k > 500 else 0))
    assert (FindingKind.CLOCK_SET, "right") in findings
