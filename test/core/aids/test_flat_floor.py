"""The flat-floor aid: a standing foot is at the height of the floor and stays where it is."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig
from dualfoot_ros.core.results.trajectory import stance_bounds

from ..following import live, same_bits
from ..harness import quick_engine, walk

ENGINE = quick_engine().name
ROUTE = {"route": "figure_eight", "rate": 60.0, "standing": 4.0, "seed": 5}


AS_THE_PAPER = {"aids.static_std": 0.02}


def config(on: bool = True, **settings) -> TrackerConfig:
    return TrackerConfig.from_mapping({"aids.flat_floor": on, **settings})


@cache
def tracked(on: bool = True):
    """Return two level circles of 5 m radius with the aid or without."""
    return DualFootTracker(config(on), engine=ENGINE).run(*walk(**ROUTE).series())


@cache
def as_the_paper():
    """Return them with the place of the paper too."""
    return DualFootTracker(config(**AS_THE_PAPER), engine=ENGINE).run(*walk(**ROUTE).series())


def in_stance(track) -> np.ndarray:
    """Return the rows of the second half of every stance, the first few being still found."""
    rows = [np.arange((a + b) // 2, b) for a, b in stance_bounds(track.stance)[1:-1]]
    return np.concatenate(rows)


def heights(result) -> np.ndarray:
    return np.concatenate([t.position[in_stance(t), 2] for t in (result.left, result.right)])


def test_on_a_level_walk_the_height_is_held_where_it_drifted():
    without, with_it = np.abs(heights(tracked(False))), np.abs(heights(tracked()))
    assert without.max() > 0.1
    assert with_it.max() < 0.025


def test_the_height_at_the_end_is_known_to_about_the_unevenness_of_the_floor():
    for track in (tracked().left, tracked().right):
        assert np.sqrt(track.position_covariance[-1, 2, 2]) < 0.02
        loose = tracked(False).left.position_covariance[-1, 2, 2]
        assert loose > 4.0 * track.position_covariance[-1, 2, 2]


def test_the_floor_says_nothing_of_the_place():
    for foot in ("left", "right"):
        with_it, without = (getattr(tracked(on), foot) for on in (True, False))
        stds = [np.sqrt(np.trace(t.position_covariance[-1, :2, :2])) for t in (with_it, without)]
        assert stds[0] == pytest.approx(stds[1], rel=0.1)
    whats = {event.detail["what"] for event in tracked().of_kind(EventKind.AID)}
    assert whats == {"height"}


def test_as_in_the_paper_each_stance_gives_its_height_at_its_begin_and_its_place_at_its_end():
    result = as_the_paper()
    for foot in ("left", "right"):
        what = [event.detail["what"] for event in result.of_kind(EventKind.AID, foot)]
        starts = len(result.of_kind(EventKind.STANCE_START, foot))
        ends = len(result.of_kind(EventKind.STANCE_END, foot))
        assert what.count("height") == starts
        assert what.count("place") == ends
        assert what[:4] == ["height", "place", "height", "place"]


def test_the_place_at_the_end_of_a_stance_is_that_of_its_begin():
    """The innovation is how far the foot slid in the estimate; the aid pulls it back."""
    events = [e for e in as_the_paper().of_kind(EventKind.AID) if e.detail["what"] == "place"][2:]
    slid = np.array([np.linalg.norm(e.innovation) for e in events])
    assert np.median(slid) < 0.02
    assert all(e.S.shape == (2, 2) and e.innovation.shape == (2,) for e in events)
    assert np.mean([e.nis for e in events]) < 2.0 * 2.0


@pytest.mark.parametrize("std", [1e-4, 1.0])
def test_the_floor_counts_as_much_as_its_unevenness_says(std):
    result = DualFootTracker(config(**{"aids.floor_std": std}), engine=ENGINE).run(
        *walk(**ROUTE).series()
    )
    deviation = np.abs(heights(result)).max()
    assert deviation < 0.03 if std < 1.0 else deviation > 0.05


def test_live_gives_the_same_bits_as_batch():
    found = live(DualFootTracker(config(**AS_THE_PAPER), engine=ENGINE), walk(**ROUTE))
    same_bits(found, as_the_paper())


def test_set_pose_takes_the_floor_along():
    pairs, tracker = walk(**ROUTE), DualFootTracker(config(), engine=ENGINE)
    middle, heights = len(pairs) // 2, []
    for k, pair in enumerate(pairs):
        if k == middle:
            tracker.set_pose([1.0, 2.0, 30.0], 0.5)
        update = tracker.add(pair)
        if k > middle and update.left.stance:
            heights.append(update.left.position[2])
    assert abs(np.array(heights) - 30.0).max() < 0.2
    assert abs(heights[-1] - np.median(heights)) < 0.05
