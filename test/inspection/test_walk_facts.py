"""The figures of a tracked walk that the findings on it are made of."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import stance_bounds
from dualfoot_ros.inspection import FindingKind, walk_facts, walk_findings
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


def test_the_interval_of_slow_samples_is_no_hole_and_a_lost_sample_is_one(walk):
    slow = replace(
        walk,
        left=replace(walk.left, stamp_ns=10 * walk.left.stamp_ns),
        right=replace(walk.right, stamp_ns=10 * walk.right.stamp_ns),
    )
    assert walk_facts(slow).feet["left"].longest_hole_s == 0.0
    assert not [f for f in walk_findings(slow) if "samples are missing" in f.text]
    stance = stance_bounds(walk.left.stance)[:, 0]
    present = walk.left.present.copy()
    present[stance] = False
    lossy = replace(slow, left=replace(slow.left, present=present))
    assert walk_facts(lossy).feet["left"].longest_hole_s == pytest.approx(0.2)


def longer(walk, times):
    """Return the walk with its positions scaled."""
    feet = (walk.left, walk.right)
    left, right = (replace(foot, position=times * foot.position) for foot in feet)
    return replace(walk, left=left, right=right)


def test_strides_that_nobody_makes_point_to_the_time_and_a_single_one_to_a_stance(walk):
    found = [f for f in walk_findings(longer(walk, 7.0)) if f.kind is FindingKind.LONG_STRIDE]
    assert [f.about for f in found] == ["left", "right"]
    assert all("in the median, which nobody makes" in f.text for f in found)
    assert all("the sampling rate, the unit of the stamps" in f.remedy for f in found)
    one = walk.left.stance.copy()
    bounds = stance_bounds(one)
    one[bounds[1, 0] : bounds[-1, 0]] = False
    alone = replace(walk, left=replace(walk.left, stance=one))
    (text,) = (f.text for f in walk_findings(alone) if f.kind is FindingKind.LONG_STRIDE)
    assert text.endswith("after the start of the track, so a stance is missed in it")


def test_a_foot_without_any_stance_is_found_and_stops_nothing(walk):
    never = replace(walk.left, stance=np.zeros(len(walk.left), dtype=bool))
    lame = replace(walk, left=never)
    steps = walk_facts(lame).feet["left"]
    assert (steps.strides, steps.longest_hole_s, steps.way_m) == (0, 0.0, 0.0)
    assert "missed_stances" in {finding.kind.value for finding in walk_findings(lame)}
