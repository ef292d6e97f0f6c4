"""Feet that do not take turns by their stamps show that the clocks are apart."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.inspection import FindingKind, walk_findings
from dualfoot_ros.inspection.stance_statistics import turn_taking
from dualfoot_ros.simulation import WalkConfig, simulate

from .tracks import track_feet

CYCLE_S = 1.14


@pytest.fixture(scope="module")
def walk():
    """Return a walk with a stop, so that there are starts and stops."""
    return simulate(WalkConfig(route="straight", rate=60.0, stops=1, standing=4.0), seed=1)


def track(walk, late_s):
    """Track the walk with the stamps of the right foot ``late_s`` later."""
    right = replace(walk.right, stamp_ns=walk.right.stamp_ns + round(late_s * 1e9))
    return track_feet(walk.left, right)


def found(trajectory):
    kind = FindingKind.CLOCKS_APART
    return [each.text for each in walk_findings(trajectory) if each.kind is kind]


def test_feet_of_one_clock_take_turns(walk):
    tracks = track(walk, 0.0)
    turns = turn_taking(tracks)
    assert turns.cycles > 10 and turns.steadiness > 0.97
    assert turns.cycle_s == pytest.approx(CYCLE_S, abs=0.05)
    assert turns.late_s == pytest.approx(0.0, abs=0.02)
    assert set(turns.leads) <= {-1, 1}
    assert found(tracks) == []


@pytest.mark.parametrize(
    ("late_s", "said"), [(0.3, "0.30 s too late"), (-0.3, "0.30 s too early")]
)
def test_an_offset_of_a_part_of_a_cycle_is_said_with_its_size(walk, late_s, said):
    tracks = track(walk, late_s)
    assert turn_taking(tracks).late_s == pytest.approx(late_s, abs=0.02)
    (text,) = found(tracks)
    assert said in text


def test_an_offset_of_whole_cycles_is_said_by_the_strides_beside_a_stand(walk):
    tracks = track(walk, 2.0 * CYCLE_S)
    turns = turn_taking(tracks)
    assert abs(turns.late_s) < 0.1 and min(turns.leads) >= 1 and max(turns.leads) >= 2
    (text,) = found(tracks)
    assert "the left foot makes up to" in text


def test_a_foot_that_never_stands_takes_no_turns(walk):
    tracks = track(walk, 0.0)
    never = replace(tracks.left, stance=np.zeros(len(tracks.left), dtype=bool))
    assert turn_taking(replace(tracks, left=never)).cycles == 0
