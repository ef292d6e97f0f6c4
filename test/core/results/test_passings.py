"""The moments at which the feet pass each other, on walks made by formula."""

import numpy as np
import pytest
from evaluation.walks import SPACING, along, rectangle, straight
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import (
    DualFootTracker,
    TrackerConfig,
    stance_bounds,
    stance_passings,
    swing_passings,
)
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
