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


STEPS = (FindingKind.LONG_STRIDE, FindingKind.NO_STANCE, FindingKind.MISSED_STANCES)


@pytest.mark.parametrize(("feet", "hole_s"), [("both", 3.0), ("left", 3.0), ("left", 0.5)])
def test_what_a_hole_does_to_the_steps_is_not_laid_to_the_stances(feet, hole_s):
    made = simulate(WalkConfig(route="rectangle", rate=60.0), seed=1)
    t = (made.left.stamp_ns - made.left.stamp_ns[0]) * 1e-9
    kept = (t < 20.33) | (t > 20.33 + hole_s)
    recording = Recording(made.left[kept], made.right[kept] if feet == "both" else made.right)
    found = run(recording, options=RunOptions()).findings
    steps = [each for each in found if each.kind in STEPS]
    assert steps
    for finding in steps:
        assert f"{hole_s:.1f}" in finding.text and "samples are missing there" in finding.text
        assert "stance.threshold" not in finding.remedy
