"""The moments at which the feet pass each other, on walks made by formula."""

from dataclasses import replace

import numpy as np
import pytest
from evaluation.walks import SPACING, along, rectangle, straight
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import (
    FEET,
    DualFootTracker,
    TrackerConfig,
    stance_bounds,
    stance_passings,
    swing_passings,
)
from dualfoot_ros.core.results.passings import ended_stances
from dualfoot_ros.evaluation.frames.yaw_transform import YawTransform
from dualfoot_ros.simulation import WalkConfig, simulate


def test_feet_side_by_side_never_cross_and_pass_at_their_spacing():
    left, right, stance = straight(strides=10)
    passings = swing_passings(left.position, right.position, *stance)
    assert len(passings.index) == 21
    assert passings.crossed_percent == 0.0
    np.testing.assert_allclose(passings.lateral_m, SPACING, atol=1e-12)
    np.testing.assert_allclose(passings.distance_m[1:-1], SPACING, atol=1e-3)


def test_exchanged_feet_are_crossed_at_every_passing():
    left, right, stance = straight()
    passings = swing_passings(right.position, left.position, stance[1], stance[0])
    assert passings.crossed_percent == 100.0


def test_feet_that_drift_over_one_another_half_way_are_crossed_half_of_the_time():
    left, right, stance = straight(strides=40)
    drift = np.zeros_like(left.position)
    drift[:, 1] = -2 * SPACING * left.position[:, 0] / left.position[-1, 0]
    passings = swing_passings(left.position + drift, right.position, *stance)
    assert passings.crossed_percent == pytest.approx(50.0, abs=3.0)


def test_the_corners_of_a_rectangle_cross_nothing_either_way_round():
    for points in (rectangle(), rectangle() * [-1, 1]):
        left, right, stance = along(points)
        assert swing_passings(left.position, right.position, *stance).crossed_percent == 0.0


@given(st.floats(-3, 3), st.tuples(*[st.floats(-500, 500)] * 3).map(np.array))
def test_the_sides_of_the_feet_do_not_depend_on_the_frame(yaw, shift):
    left, right, stance = along(rectangle())
    move = YawTransform(yaw, shift).position
    passings = swing_passings(move(left.position), move(right.position), *stance)
    same = swing_passings(left.position, right.position, *stance)
    np.testing.assert_allclose(passings.lateral_m, same.lateral_m, atol=1e-9)


def test_the_swings_of_a_walk_together_are_to_the_bit_those_one_by_one():
    """In a turn, and with other swings than those of the walk, some of them short."""
    left, right, _ = along(rectangle())
    rng = np.random.default_rng(4)
    made = [np.repeat(rng.random(len(left.position) // 7 + 1) > 0.5, 7) for _ in range(2)]
    stance = [own[: len(left.position)] for own in made]
    expected = []
    for track, own in zip((left.position, right.position), stance, strict=True):
        bounds = stance_bounds(own)
        for begin, end in zip(bounds[:-1, 1], bounds[1:, 0], strict=True):
            quarter = (end - begin) // 4
            way = (track[end - 1 - quarter] - track[begin + quarter])[:2]
            if np.linalg.norm((track[end] - track[begin - 1])[:2]) >= 0.3 and way.any():
                middle = (begin + end - 1) // 2
                x, y = (left.position[middle] - right.position[middle])[:2]
                forward = way / np.linalg.norm(way)
                expected.append((middle, forward[0] * y - forward[1] * x))
    expected.sort(key=lambda passing: passing[0])
    passings = swing_passings(left.position, right.position, *stance)
    found = list(zip(passings.index.tolist(), passings.lateral_m.tolist(), strict=True))
    assert found == expected and len(found) > 10


def test_shuffling_on_the_spot_has_no_direction_and_no_swing_passings():
    left, right, stance = straight(length=0.1)
    passings = swing_passings(left.position, right.position, *stance)
    assert len(passings.index) == 0
    assert passings.crossed_percent is None


def test_the_middles_of_stances_are_moments_of_the_true_passings_of_a_simulated_walk():
    made = simulate(WalkConfig(route="straight"), seed=1)
    tracks = DualFootTracker(TrackerConfig(method="zupt")).run(made.left, made.right)
    passings = stance_passings(tracks)
    stamps = tracks.left.stamp_ns[[passing.epoch for passing in passings]]
    nearest = np.abs(made.moment_ns[:, None] - stamps).min(axis=1)
    assert np.median(nearest) < 60_000_000
    assert [p.standing for p in passings[:-1]] == [1 - p.standing for p in passings[1:]]
    for passing in passings:
        assert passing.forward @ [1.0, 0.0] > 0.99
        assert passing.left @ passing.forward == pytest.approx(0.0, abs=1e-12)
        assert passing.swing[0] < passing.epoch < passing.swing[1]
        assert passing.stance.first < passing.epoch < passing.stance.last


def way_of(track, begin, end):
    """Return the unit vector between two footprints, None for a short swing."""
    way = (track.position[end] - track.position[begin])[:2]
    length = np.sqrt(way @ way)
    return None if length < 0.3 else way / length


def passings_one_by_one(walk):
    """Yield epoch, direction, middle and separation of each passing, foot by foot."""
    tracks, stances = (walk.left, walk.right), [ended_stances(walk, foot) for foot in FEET]
    for foot, own in enumerate(stances):
        for number, (first, last) in enumerate(own):
            moment = round(0.5 * first + 0.5 * last)
            after = sum(begin <= moment for begin, _ in stances[1 - foot])
            if not 0 < after < len(stances[1 - foot]) or stances[1 - foot][after - 1][1] >= moment:
                continue
            swing = stances[1 - foot][after - 1][1], stances[1 - foot][after][0]
            way, along = way_of(tracks[1 - foot], *swing), None
            if way is None or walk.left.stamp_ns[last] - walk.left.stamp_ns[first] > 1.2e9:
                continue
            if 0 < number < len(own) - 1:
                along = way_of(tracks[foot], own[number - 1][1], own[number + 1][0])
            forward = way if along is None else (way + along) / 2
            size = np.sqrt(forward @ forward)
            left, right = (track.position[moment, :2] for track in tracks)
            if size >= 0.5:
                yield (
                    (moment, foot, (first, last), swing),
                    *((forward / size).tolist(), (0.5 * (left + right)).tolist()),
                    (left - right).tolist(),
                )


def test_the_stance_passings_of_a_walk_are_to_the_bit_those_one_by_one():
    """In turns, and where tracks jump so far that feet go short ways and opposite ones."""
    made = simulate(WalkConfig(route="rectangle"), seed=1)
    tracks = DualFootTracker(TrackerConfig(method="zupt")).run(made.left, made.right)
    jumps = np.random.default_rng(2).normal(0.0, 0.5, (len(tracks.left) // 50 + 1, 3))
    tracks.left.position[:] += np.repeat(jumps, 50, axis=0)[: len(tracks.left)]
    found = [
        (
            (each.epoch, each.standing, each.stance, each.swing),
            *(values.tolist() for values in (each.forward, each.middle, each.separation)),
        )
        for each in stance_passings(tracks)
    ]
    expected = sorted(passings_one_by_one(tracks), key=lambda passing: passing[0][0])
    assert found == expected and len(found) > 50


def test_a_walk_without_stances_has_no_stance_passings():
    made = simulate(WalkConfig(route="straight"), seed=1)
    tracks = DualFootTracker(TrackerConfig(method="zupt")).run(made.left, made.right)
    assert stance_passings(replace(tracks, events=())) == []
