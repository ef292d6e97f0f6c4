"""Straight lines: long straights hold the heading, short ones and turns do not; live is batch."""

import math
from functools import cache

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, ImuPair, TrackerConfig
from dualfoot_ros.core.aids.straight_lines import FootDirections
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import align

AID = {"aids.straight_lines": True}


@cache
def samples(route, seed=0, **settings):
    """Return a simulated walk and its paired series."""
    made = simulate(WalkConfig(route=route, rate=60.0, standing=4.0, **settings), seed=seed)
    return made, align(made.left, made.right)


def tracked(series, **settings):
    """Return the track of paired series, with these parameters besides the defaults."""
    return DualFootTracker(TrackerConfig.from_mapping(settings)).run(*series)


def rows(run):
    """Return the rows that the aid gave."""
    return [each for each in run.of_kind(EventKind.AID) if each.detail["aid"] == "straight_lines"]


def put(directions, angles, way=1.4):
    """Walk strides of ``way`` m in these directions, rad."""
    place = np.zeros(3)
    directions.add(place)
    for angle in angles:
        place = place + way * np.array([math.cos(angle), math.sin(angle), 0.0])
        directions.add(place)


def test_it_is_off_by_default():
    _, series = samples("straight")
    assert not rows(tracked(series))


def test_directions_that_scatter_about_one_are_straight():
    found = FootDirections(12)
    put(found, 0.05 * np.random.default_rng(0).standard_normal(12))
    assert found.straight(0.1) and abs(found.mean()) < 0.05


@pytest.mark.parametrize(
    "angles",
    [np.linspace(0.0, 0.12, 12), [0.0] * 11, [0.0] * 6 + [0.5] + [0.0] * 5],
    ids=("a bend", "too few strides", "a step aside"),
)
def test_bends_short_ways_and_steps_aside_are_no_straight(angles):
    found = FootDirections(12)
    put(found, angles)
    assert not found.straight(0.026)


def test_a_stride_on_the_spot_begins_anew():
    found = FootDirections(4)
    put(found, [0.0] * 6)
    assert found.straight(0.026)
    put(found, [0.0], way=0.1)
    assert not found.straight(0.026)


def test_directions_go_on_past_half_a_turn_and_turn_with_the_track():
    found = FootDirections(4)
    put(found, [3.13, -3.13, 3.12, -3.12])
    assert found.straight(0.1)
    assert math.cos(found.mean()) == pytest.approx(-1.0, abs=1e-3)
    before = found.mean()
    found.turn(0.3)
    assert found.mean() == pytest.approx(before + 0.3)


def test_laps_with_long_straights_drift_less():
    ends = {False: [], True: []}
    for seed in range(3):
        _, series = samples("track", seed)
        for on, errors in ends.items():
            run = tracked(series, method="spacing_vector", **({"aids.straight_lines": on}))
            assert bool(rows(run)) is on
            middle = 0.5 * (run.left.position + run.right.position)
            errors.append(float(np.linalg.norm((middle[-1] - middle[0])[:2])))
    assert np.median(ends[True]) < 0.6 * np.median(ends[False]), ends


def test_a_figure_of_eight_of_circles_has_no_straight():
    _, series = samples("figure_eight")
    assert not rows(tracked(series, **AID))


def test_one_row_turns_the_heading_by_no_more_than_the_clip():
    _, series = samples("track", 1)
    found = rows(tracked(series, **AID, **{"aids.straight_clip": 1e-3}))
    turns = [abs(turned) for each in found for turned in each.detail["turned"]]
    assert found and max(turns) < 1.5e-3


def test_straights_the_other_way_round_count_as_parallel():
    _, series = samples("track", 1)
    references = {round(each.detail["reference"], 3) for each in rows(tracked(series, **AID))}
    apart = [math.remainder(a - b, math.pi) for a in references for b in references]
    assert max(map(abs, apart)) < 0.1


def test_live_and_batch_give_the_same_bits():
    _, series = samples("straight", 2)
    config = TrackerConfig.from_mapping(AID)
    whole = DualFootTracker(config).run(*series)
    live = DualFootTracker(config)
    last = None
    for stamp, values in zip(series[0].stamp_ns, stack_pairs(*series), strict=True):
        last = live.add(ImuPair(int(stamp), values))
    assert rows(whole)
    assert np.array_equal(last.left.position, whole.left.position[-1])
