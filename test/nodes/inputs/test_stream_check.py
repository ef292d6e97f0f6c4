"""Faults of a live stream are told within ten seconds of walking, and nothing of a good one."""

from types import SimpleNamespace

import numpy as np
import pytest

from dualfoot_ros.core import FEET, TrackerConfig
from dualfoot_ros.nodes.inputs import stream_check
from dualfoot_ros.nodes.inputs.stream_check import StreamCheck
from dualfoot_ros.nodes.ros.status import Status
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import Aligner

STANDING_S = 5.0
WALKING_S = 10.0


@pytest.fixture(scope="module")
def walk():
    made = simulate(WalkConfig(route="figure_eight", standing=STANDING_S, rate=60.0), seed=3)
    return {
        foot: (
            series.stamp_ns,
            np.hstack([series.specific_force, series.angular_rate]),
        )
        for foot, series in zip(FEET, (made.left, made.right), strict=True)
    }


def run(walk, seconds, change=lambda foot, values: values):
    """Feed the first ``seconds`` of a walk, with a report every second; return what is told."""
    tracker = SimpleNamespace(config=TrackerConfig(), engine="compiled")
    check = StreamCheck(tracker, Aligner())
    stamps = {foot: stamp_ns for foot, (stamp_ns, _) in walk.items()}
    begin = int(stamps["left"][0])
    last = dict.fromkeys(FEET, 0)
    found = {}
    for second in range(1, int(seconds) + 1):
        for foot, (stamp_ns, values) in walk.items():
            until = int(np.searchsorted(stamp_ns, begin + second * 10**9))
            for k in range(last[foot], until):
                check.add(foot, int(stamp_ns[k]), change(foot, values[k].copy()))
            last[foot] = until
        status = Status()
        check.describe(status)
        check.wait()
        found |= {finding.key: finding for finding in status.findings}
    return {(key.kind.value, key.about) for key in found}


def test_nothing_is_told_of_a_good_walk(walk):
    assert run(walk, 70.0) == set()


@pytest.mark.parametrize("feet", [("right",), FEET])
def test_a_clock_that_is_set_makes_no_fault_of_a_good_walk(walk, feet):
    aligner = Aligner()
    check = StreamCheck(SimpleNamespace(config=TrackerConfig(), engine="compiled"), aligner)
    found = set()
    for k in range(40 * 60):
        for foot in FEET:
            stamp_ns, values = (column[k] for column in walk[foot])
            if foot in feet and k > 15 * 60:
                stamp_ns = stamp_ns + 3600 * 10**9
            check.add(foot, int(stamp_ns), values)
            aligner.push(foot, int(stamp_ns), values)
        if k % 60 == 59:
            status = Status()
            check.describe(status)
            check.wait()
            found |= {finding.kind for finding in status.findings}
    assert found == set()


def times(factor):
    def change(foot, values):
        values[3:] *= factor if foot == "left" else 1.0
        return values

    return change


@pytest.mark.parametrize(
    ("factor", "kind"),
    [
        (1.0 / 57.3, "rate_unit"),
        (-1.0, "rate_axes"),
        ([1.0, -1.0, 1.0], "rate_axes"),
        (0.85, "rate_scale"),
    ],
)
def test_a_wrong_gyro_is_told_within_ten_seconds_of_walking(walk, factor, kind):
    assert (kind, "left") in run(walk, STANDING_S + WALKING_S, times(factor))


def test_one_topic_for_both_feet_is_told(walk):
    same = dict.fromkeys(FEET, walk["left"])
    assert ("same_samples", "") in run(same, STANDING_S + WALKING_S)


def test_exchanged_feet_are_told_after_a_walk_with_turns_both_ways(walk):
    exchanged = {"left": walk["right"], "right": walk["left"]}
    assert run(exchanged, 70.0) == {("swapped", "")}


def test_a_reset_forgets_the_samples(walk):
    check = StreamCheck(SimpleNamespace(config=TrackerConfig(), engine="compiled"), Aligner())
    stamp_ns, values = walk["left"]
    for k in range(600):
        check.add("left", int(stamp_ns[k]), values[0])
    check.reset()
    status = Status()
    check.describe(status)
    check.wait()
    check.describe(status)
    assert status.findings == []


def test_what_an_inspection_has_freed_goes_back_to_the_system(walk, monkeypatch):
    given_back = []
    monkeypatch.setattr(stream_check, "give_back_memory", lambda: given_back.append(1))
    run(walk, 20.0)
    assert len(given_back) > 2


def test_another_allocator_than_that_of_glibc_is_left_alone(monkeypatch):
    stream_check.give_back_memory()
    monkeypatch.setattr(stream_check.ctypes, "CDLL", lambda _name: object())
    assert stream_check._trim.__wrapped__() is None
