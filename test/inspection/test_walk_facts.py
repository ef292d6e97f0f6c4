"""The figures of a tracked walk that the findings on it are made of."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import stance_bounds
from dualfoot_ros.inspection import walk_facts, walk_findings
from dualfoot_ros.simulation import WalkConfig, simulate

from .tracks import track_feet


@pytest.fixture(scope="module")
def walk():
    """Return the tracks of a short walk."""
    made = simulate(WalkConfig(route="straight"), seed=1)
    return track_feet(made.left, made.right)


def test_the_hole_of_the_longest_stride_is_that_of_the_samples_beside_it(walk):
    """Whichever samples are lost; those of the step before it count too, others do not."""
    rng = np.random.default_rng(2)
    foot, found = walk.left, []
    bounds = stance_bounds(foot.stance)
    places = foot.position[bounds.sum(axis=1) // 2, :2]
    longest = int(np.argmax(np.linalg.norm(np.diff(places, axis=0), axis=1)))
    begin, end = bounds[longest - 1, 0], bounds[longest + 1, 1]
    for share in (0.0, 0.01, 0.1, 0.5, 0.9):
        present = rng.random(len(foot)) < share
        there = np.flatnonzero(present)
        beside = (there[:-1] >= begin) & (there[1:] < end)
        expected = np.diff(foot.stamp_ns[there])[beside].max(initial=0) * 1e-9
        lossy = replace(walk, left=replace(foot, present=present))
        found.append(walk_facts(lossy).feet["left"].longest_hole_s)
        assert found[-1] == expected
    assert longest > 0 and len(set(found)) > 3


def test_a_foot_without_any_stance_is_found_and_stops_nothing(walk):
    never = replace(walk.left, stance=np.zeros(len(walk.left), dtype=bool))
    lame = replace(walk, left=never)
    steps = walk_facts(lame).feet["left"]
    assert (steps.strides, steps.longest_hole_s, steps.way_m) == (0, 0.0, 0.0)
    assert "missed_stances" in {finding.kind.value for finding in walk_findings(lame)}
