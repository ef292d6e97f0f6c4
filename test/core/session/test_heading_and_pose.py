"""Heading is a gauge: fixed by the first strides, announced, and free to be set."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import (
    BiasPrior,
    ConfigError,
    DualFootTracker,
    EventKind,
    ImuPair,
    TrackerConfig,
)
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.events import FEET

from ..following import live
from ..harness import Pairs, quick_engine, simulated, walk

ENGINE = quick_engine().name
STRAIGHT = {"route": "straight", "rate": 60.0}


def tracker(**options) -> DualFootTracker:
    config = TrackerConfig.from_mapping({"method": "zupt", **options})
    return DualFootTracker(config, engine=ENGINE)


def turned_about_z(pairs: Pairs, angles: tuple[float, float]) -> Pairs:
    """Return what the sensors would read had they been mounted turned about their z axes."""
    values = pairs.values.copy()
    for foot, angle in enumerate(angles):
        c, s = math.cos(angle), math.sin(angle)
        for o in (6 * foot, 6 * foot + 3):
            x, y = pairs.values[:, o], pairs.values[:, o + 1]
            values[:, o], values[:, o + 1] = c * x + s * y, c * y - s * x
    return Pairs(pairs.stamps, values)


def direction(positions: np.ndarray) -> float:
    way = positions[-1] - positions[0]
    return math.atan2(way[1], way[0])


def test_after_the_first_strides_x_is_forward_for_both_feet():
    result = tracker().run(*walk(14.0, **STRAIGHT).series())
    for foot in (result.left, result.right):
        assert abs(direction(foot.position)) < 0.05
        assert foot.position[-1, 0] > 5.0


@pytest.mark.parametrize("given", (1.2, -2.5))
def test_a_given_heading_is_the_direction_of_the_first_strides(given):
    options = {"heading.source": "given", "heading.given": given}
    result = tracker(**options).run(*walk(14.0, **STRAIGHT).series())
    for foot in (result.left, result.right):
        assert direction(foot.position) == pytest.approx(given, abs=0.05)
    apart = result.left.position[0] - result.right.position[0]
    assert apart[:2] @ [math.cos(given), math.sin(given)] == pytest.approx(0.0, abs=0.02)
    assert apart[:2] @ [-math.sin(given), math.cos(given)] > 0.1


def test_how_the_sensors_are_turned_on_the_shoes_does_not_matter():
    """Heading is a gauge: turned sensors give the same track, to rounding, from where it starts.

    (The feet start a few hundredths of a millimetre apart: each is turned about where it is found
    to stand when its first stance is confirmed.  The scatter of the stand is taken axis by axis,
    so here it is not to decide about windows, P0 and what is known of the gyro bias beforehand.)
    """
    same = {
        "alignment.still_rate_std": 1.0,
        "initial.gyro_bias": 0.005,
        "zupt.lever_back": 0.0,  # until the heading is known it lies along the sensor's own axis
    }
    pairs = walk(16.0, **STRAIGHT)
    level = Pairs(pairs.stamps, pairs.values)
    trackers = [tracker(**same) for _ in range(2)]
    for each, foot in product(trackers, FEET):
        each.declare_bias(foot, BiasPrior(np.zeros(3), 1e3))
    plain = trackers[0].run(*level.series())
    turned = trackers[1].run(*turned_about_z(level, (0.4, -0.4)).series())
    for one, other in ((plain.left, turned.left), (plain.right, turned.right)):
        difference = one.position - other.position
        assert np.abs(difference[0]).max() < 1e-3
        assert np.abs(difference - difference[0]).max() < 3e-6


def test_with_the_sensors_own_axes_nothing_is_turned():
    options = {"heading.source": "sensor"}
    result = tracker(**options).run(*walk(14.0, **STRAIGHT).series())
    assert not result.of_kind(EventKind.HEADING)


def test_each_foot_is_turned_exactly_once_and_says_so():
    result = tracker().run(*walk().series())
    assert sorted(e.foot for e in result.of_kind(EventKind.HEADING)) == ["left", "right"]


def test_a_subscriber_who_turns_the_rows_it_has_gets_what_run_gives():
    """With nothing but the event: turn by yaw about the pivot, then move by the shift."""
    pairs = walk(16.0, **STRAIGHT)
    result = tracker().run(*pairs.series())
    followed = live(tracker(), pairs)
    for foot, track in enumerate((result.left, result.right)):
        events = [e for e in followed.events if e.kind is EventKind.HEADING]
        (event,) = [e for e in events if e.foot == ("left", "right")[foot]]
        yaw, pivot = event.detail["yaw"], np.array(event.detail["pivot"])
        c, s = math.cos(yaw), math.sin(yaw)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        before = np.array(followed.stamps) < event.stamp_ns
        rows = np.array(followed.rows)[:, lay.O_FOOT * foot : lay.O_FOOT * (foot + 1)]
        found, velocity = rows[:, :3].copy(), rows[:, lay.O_VEL : lay.O_VEL + 3].copy()
        found[before] = (found[before] - pivot) @ turn.T + pivot + event.detail["shift"]
        velocity[before] = velocity[before] @ turn.T
        attitude = Rotation.from_quat(rows[before, lay.O_QUAT : lay.O_QUAT + 4])
        turned = (Rotation.from_rotvec([0.0, 0.0, yaw]) * attitude).as_matrix()
        assert np.allclose(found, track.position, rtol=0.0, atol=1e-12)
        assert np.allclose(velocity, track.velocity, rtol=0.0, atol=1e-12)
        expected = Rotation.from_quat(track.quaternion[before]).as_matrix()
        assert np.allclose(turned, expected, rtol=0.0, atol=1e-12)
        for k in (0, int(before.sum()) - 1):
            cells = rows[k, lay.O_COV_POS : lay.O_COV_POS + 9]
            P = turn @ cells.reshape(3, 3) @ turn.T
            assert np.allclose(P, track.position_covariance[k], rtol=1e-9, atol=1e-15)


def test_the_separations_covariance_is_turned_with_the_feet():
    """While the feet are uncorrelated it is the sum of the two positions' covariances."""
    result = tracker(zupt={"height_drift": 0.0}).run(*walk(16.0, **STRAIGHT).series())
    total = result.left.position_covariance + result.right.position_covariance
    assert np.allclose(result.relative_covariance, total, atol=1e-12)


def test_the_height_drifts_with_both_feet_alike_and_without_the_root_of_time():
    still = tracker(zupt={"height_drift": 0.0}).run(*walk(20.0, **STRAIGHT).series())
    drifting = tracker(zupt={"height_drift": 0.1}).run(*walk(20.0, **STRAIGHT).series())
    grown = [
        drifting.left.position_covariance[:, 2, 2] - still.left.position_covariance[:, 2, 2],
        drifting.right.position_covariance[:, 2, 2] - still.right.position_covariance[:, 2, 2],
    ]
    walked_s = np.sqrt(grown[0]) / 0.1
    assert np.allclose(grown[0], grown[1], atol=1e-12)
    np.testing.assert_allclose(drifting.relative_covariance, still.relative_covariance, 1e-9)
    np.testing.assert_array_equal(drifting.left.position, still.left.position)
    steps = np.diff(walked_s)
    assert steps.min() > -1e-6 and steps.max() < 1.01 / 60.0
    assert 8.0 < walked_s[-1] < 20.0


def test_the_pose_covariance_says_that_a_heading_error_moves_the_foot_sideways():
    """A heading too far left (positive) puts a foot that walked along x too far left (+y)."""
    followed = None
    one = tracker()
    for pair in walk(20.0, **STRAIGHT):
        followed = one.add(pair)
    for covariance in (followed.left.pose_covariance(), followed.pedestrian().pose_covariance):
        x = followed.left.position[0]
        yaw_variance, sideways = covariance[5, 5], covariance[1, 5]
        assert sideways > 0.3 * x * yaw_variance
        assert np.allclose(covariance, covariance.T)
        assert np.linalg.eigvalsh(covariance)[0] > 0.0


def test_the_covariance_of_a_straight_walk_is_wider_sideways_than_along():
    result = tracker().run(*walk(25.0, **STRAIGHT).series())
    P = result.left.position_covariance[-1]
    assert P[1, 1] > 10.0 * P[0, 0]


# --- set_pose and reset ----------------------------------------------------------------------


@pytest.mark.parametrize("source", ("first_strides", "sensor", "given"))
def test_a_pose_set_while_standing_is_where_the_walk_starts_and_the_way_it_goes(source):
    pairs = walk(14.0, **STRAIGHT)
    plain = tracker(**{"heading.source": source}).run(*pairs.series())
    placed = tracker(**{"heading.source": source})
    placed.set_pose([10.0, -5.0, 2.0], 1.0)
    result = placed.run(*pairs.series())
    middle = 0.5 * (result.left.position[0] + result.right.position[0])
    assert np.allclose(middle, [10.0, -5.0, 2.0], atol=1e-9)
    turn = direction(result.left.position) - direction(plain.left.position)
    assert turn == pytest.approx(1.0, abs=1e-6)


def test_a_pose_set_in_mid_walk_moves_the_person_there_and_turns_the_track_rigidly():
    pairs = walk(24.0, **STRAIGHT)
    plain, moved = tracker(method="idc"), tracker(method="idc")
    at_pose = round(14.0 * 60.0)
    for k, pair in enumerate(pairs):
        a = plain.add(pair)
        if k == at_pose:
            moved.set_pose([1.0, 2.0, 3.0], a.pedestrian().heading + 0.7)
        b = moved.add(pair)
        if k == at_pose:
            events = [e for e in b.events if e.kind is EventKind.HEADING]
            assert [e.foot for e in events] == ["left", "right"]
            assert np.linalg.norm(b.pedestrian().position - [1.0, 2.0, 3.0]) < 0.2
    assert np.linalg.norm(b.left.position - b.right.position) == pytest.approx(
        np.linalg.norm(a.left.position - a.right.position), abs=0.02
    )
    spread = [update.left.pose_covariance()[2, 2] for update in (a, b)]
    assert spread[1] == pytest.approx(spread[0], rel=0.2)  # the constraint under way is forgotten
    turn = b.pedestrian().heading - a.pedestrian().heading
    assert math.remainder(turn - 0.7, math.tau) == pytest.approx(0.0, abs=0.02)


def test_a_pose_asked_for_before_the_heading_is_known_waits_for_it():
    pairs = walk(24.0, **STRAIGHT)
    one = tracker()
    first = next(k for k, p in enumerate(pairs) if one.add(p).phase == "walking")
    one.set_pose([5.0, 5.0, 0.0], 0.0)
    events = [e for p in pairs[first + 1 :] for e in one.add(p).events]
    headings = [e for e in events if e.kind is EventKind.HEADING]
    assert len(headings) == 4


@pytest.mark.parametrize(
    ("position", "yaw"),
    [([0.0, 0.0], 0.0), ([math.nan, 0.0, 0.0], 0.0), ([0.0, 0.0, 0.0], math.inf)],
)
def test_a_pose_that_is_no_pose_is_refused_before_it_can_do_harm(position, yaw):
    with pytest.raises(ConfigError, match="pose is"):
        tracker().set_pose(position, yaw)


def test_a_reset_aligns_anew_and_gives_the_bits_of_a_new_tracker():
    pairs = walk(14.0, **STRAIGHT)
    used = tracker()
    for pair in pairs:
        used.add(pair)
    used.reset()
    late = 20_000_000_000
    again = Pairs(pairs.stamps + late, pairs.values)
    first = used.add(ImuPair(int(again.stamps[0]), again.values[0]))
    assert [e.kind for e in first.events] == [EventKind.RESET]
    assert first.phase == "aligning"
    assert used.counters["resets"] == 1
    old, new = live(used, again[1:]), live(tracker(), again)
    assert len(old.rows) == len(new.rows) > 500
    assert np.array_equal(np.array(old.rows), np.array(new.rows))


def test_steps_on_the_spot_fix_no_heading():
    """A foot that has hardly moved has no direction; the heading waits for a way."""
    result = tracker().run(*walk(24.0, route="standing", rate=60.0, standing=30.0).series())
    assert not result.of_kind(EventKind.HEADING)


def test_the_persons_heading_follows_a_turn_of_the_route():
    made = simulated("L", rate=60.0)
    pairs = walk(route="L", rate=60.0)
    one = tracker()
    updates = [one.add(p) for p in pairs]
    heading = updates[-1].pedestrian().heading
    assert len(made.left) == len(pairs)
    assert heading == pytest.approx(math.pi / 2, abs=0.15)
