"""Stops and stairs of a walk are nothing to warn of."""

import pytest
from processes import ROOT

from dualfoot_ros.evaluation import RunOptions, run
from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.recording import Recording, read_bag
from dualfoot_ros.simulation import WalkConfig, simulate


def kinds(recording):
    found = run(recording, options=RunOptions())
    return {finding.kind for finding in found.findings}


@pytest.mark.parametrize("stops", [3, 6])
def test_a_person_who_always_starts_and_stops_with_the_same_foot_misses_no_stance(stops):
    made = simulate(WalkConfig(route="figure_eight", rate=60.0, stops=stops), seed=4)
    assert FindingKind.MISSED_STANCES not in kinds(Recording(made.left, made.right))


def test_the_short_strides_of_stairs_miss_no_stance():
    made = simulate(WalkConfig(route="stairs", rate=60.0), seed=2)
    assert FindingKind.MISSED_STANCES not in kinds(Recording(made.left, made.right))


def test_nothing_is_found_wrong_with_the_demo_walk():
    assert not kinds(read_bag(ROOT / "bags" / "demo")) & {
        FindingKind.MISSED_STANCES,
        FindingKind.LONG_STRIDE,
        FindingKind.NO_STANCE,
    }
