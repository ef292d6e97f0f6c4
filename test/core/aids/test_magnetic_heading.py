"""The magnetic heading: an update of the yaw, gated, against the foot's own first stances."""

from __future__ import annotations

import math
from collections import Counter
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import (
    ConfigError,
    DualFootTracker,
    EventKind,
    FieldSeries,
    SeriesError,
    TrackerConfig,
)
from dualfoot_ros.core.aids import FieldLog, MagneticHeading
from dualfoot_ros.core.aids.field import NavigationField, mean_field
from dualfoot_ros.core.aids.magnetic_heading import heading_row
from dualfoot_ros.core.groups import AidsConfig
from dualfoot_ros.core.results.events import FEET
from dualfoot_ros.simulation import MagnetometerConfig, SensorConfig, WalkConfig, simulate
from dualfoot_ros.timing import align

from ..constraints.joint import MadeUpGait, apart, assert_dense_update, stance, states
from ..following import live, same_bits
from ..harness import Pairs, quick_engine, stack_pairs

ENGINE = quick_engine().name
SECOND = 1_000_000_000
EARTH = MagnetometerConfig(hard_iron=0.0, noise=0.1)
CONFIG = AidsConfig(magnetic_heading=True, magnetic_std=0.3, magnetic_stances=2)
components = st.floats(-60e-6, 60e-6)


# --- the row and the update ----------------------------------------------------------------------


@given(st.floats(5e-6, 60e-6), st.floats(-math.pi, math.pi), components, st.integers(0, 1))
@settings(max_examples=50)
def test_the_row_is_the_derivative_of_the_direction_by_the_attitude_error(level, angle, z, foot):
    """C_hat = (I - [phi x]) C, so the field comes out as m + m x phi."""
    m = np.array([level * math.cos(angle), level * math.sin(angle), z])
    row, step = heading_row(foot, NavigationField(*m)), 1e-6
    for axis in range(3):
        phi = step * np.eye(3)[axis]
        ahead, back = (NavigationField(*(m + np.cross(m, s * phi))).angle for s in (1.0, -1.0))
        slope = math.remainder(ahead - back, math.tau) / (2.0 * step)
        assert row[15 * foot + 6 + axis] == pytest.approx(slope, rel=1e-5, abs=1e-6)


@given(components, components, components, st.floats(-7.0, 7.0))
def test_a_turn_about_the_vertical_changes_direction_only(x, y, z, angle):
    field = NavigationField(x, y, z)
    turned = field.turned(angle)
    assert turned.norm == pytest.approx(field.norm) and turned.z == z
    if field.level > 1e-9:
        off = math.remainder(turned.angle - field.angle - angle, math.tau)
        assert abs(off) < 1e-6


class Stances:
    """Gives an aid the field of one stance after another."""

    def __init__(self, foot: int = 0, config: AidsConfig = CONFIG, seed: int = 0) -> None:
        self.space, self.estimate = apart(seed, 0.2)
        self.foot, self.counters, self._first = foot, Counter(), 10
        self._logs = {name: FieldLog() for name in FEET}
        self.aid = MagneticHeading(config, self._logs, self.counters)
        self._gait = MadeUpGait(np.ones((2, 100_000), dtype=bool))

    def stand(self, field):
        """Stand in ``field`` (3,) T of navigation axes; return what came of it."""
        requests = self.requests(field)
        outcome = requests[0].apply(self.estimate)
        self.aid.note(outcome)
        return outcome

    def requests(self, field):
        """Return what the aid asks for after a stance in ``field``, None for not measured."""
        first, last, self._first = self._first, self._first + 40, self._first + 100
        if field is not None:
            body = self.estimate.rotation(self.foot).T @ field
            for epoch in range(first, last + 1):
                self._logs[FEET[self.foot]].add(self._gait.stamp(epoch), body)
            self._logs[FEET[self.foot]].add(self._gait.stamp(last + 1), 3.0 * body)  # in swing
        return self.aid.on_stance_end(stance(self.foot, first, last), self._gait)


NORTH = np.array([12e-6, 12e-6, -45e-6])


def about_z(angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize("foot", [0, 1])
@pytest.mark.parametrize("seed", range(3))
def test_a_stance_is_the_kalman_update_of_the_direction_in_its_middle(foot, seed):
    made = Stances(foot, seed=seed)
    assert [made.stand(NORTH).accepted for _ in range(2)] == [False, False]
    (request,) = made.requests(about_z(0.2) @ NORTH)
    assert (request.epoch, request.roll_back) == (230, True)
    before, P = states(made.space), made.space.covariance()
    outcome = request.apply(made.estimate)
    assert outcome.accepted and outcome.innovation == pytest.approx(0.2)
    H = np.zeros(30)
    for state, value in heading_row(foot, NavigationField(*(about_z(0.2) @ NORTH))).items():
        H[state] = value
    assert_dense_update(before, P, made.space, H, 0.3**2, 0.2)


def test_the_reference_is_the_mean_of_the_first_stances_that_agree():
    made = Stances(config=AidsConfig(magnetic_heading=True, magnetic_stances=3))
    said = [made.stand(scale * NORTH).accepted for scale in (1.5, 1.02, 0.7, 1.0, 1.03, 1.01)]
    assert not any(said) and made.counters["stances_before_field_reference"] == 5
    assert made.stand(1.01 * NORTH).accepted
    assert made.counters["stances_in_disturbed_field"] == 0


@pytest.mark.parametrize(
    "other",
    [1.08 * NORTH, 0.92 * NORTH, NORTH * [0.5, 0.5, 1.0], NORTH * [1.0, 1.0, -1.0], [0, 0, 5e-5]],
    ids=["larger", "smaller", "steeper", "upside down", "vertical"],
)
def test_another_size_or_dip_is_a_disturbed_field_and_so_are_the_stances_right_after(other):
    made = Stances(config=AidsConfig(magnetic_heading=True, magnetic_stances=3))
    for _ in range(4):
        outcome = made.stand(NORTH)
    assert outcome.accepted
    before = made.space.w.copy()
    said = [made.stand(np.array(field)) for field in (other, NORTH, NORTH)]
    assert [each.accepted for each in said] == [False] * 3
    assert [each.detail["reason"] for each in said] == ["disturbed"] + ["after a disturbance"] * 2
    assert made.space.w.tobytes() == before.tobytes()
    assert made.counters["stances_in_disturbed_field"] == 3
    assert made.stand(NORTH).accepted


def test_a_stance_that_was_not_measured_asks_for_nothing_and_is_counted():
    made = Stances()
    assert made.requests(None) == ()
    assert made.counters["stances_without_field"] == 1


def test_who_turns_the_track_turns_the_reference():
    made = Stances()
    for _ in range(2):
        made.stand(NORTH)
    made.aid.moved(0.0, 1.0)
    assert made.stand(about_z(1.1) @ NORTH).innovation == pytest.approx(0.1)


def test_the_mean_of_fields_is_that_of_their_components():
    fields = [NavigationField(*row) for row in np.arange(6.0).reshape(2, 3)]
    assert mean_field(fields) == NavigationField(1.5, 2.5, 3.5)


# --- a whole walk --------------------------------------------------------------------------------


@cache
def lap(magnetometer: MagnetometerConfig = EARTH, route: str = "rectangle", seed: int = 0):
    """Return a simulated walk with the magnetic field."""
    walk = WalkConfig(route=route, rate=60.0, standing=5.0, final_standing=1.0)
    return simulate(walk, SensorConfig(), seed=seed, magnetometer=magnetometer)


def drifting(made, degrees_per_second: float):
    """Return both series with a bias about z that comes up after the stand."""
    found = []
    for each, truth in ((made.left, made.left_truth), (made.right, made.right_truth)):
        up = Rotation.from_quat(truth.quaternion).apply([0.0, 0.0, 1.0], inverse=True)
        walking = each.stamp_ns > each.stamp_ns[0] + 6 * SECOND
        rate = each.angular_rate + math.radians(degrees_per_second) * up * walking[:, None]
        found.append(each.__class__(each.stamp_ns, each.specific_force, rate, each.magnetic_field))
    return align(*found)


def tracker(on: bool = True, **settings) -> DualFootTracker:
    given = {"aids.magnetic_heading": on, **settings}
    return DualFootTracker(TrackerConfig.from_mapping(given), engine=ENGINE)


def heading_drift(made, result) -> float:
    """Return how much both tracks turned against the truth, from the first strides on, rad."""
    drifts = []
    for track, truth in ((result.left, made.left_truth), (result.right, made.right_truth)):
        there = np.searchsorted(truth.stamp_ns, track.stamp_ns)
        estimated = Rotation.from_quat(track.quaternion)
        turns = (estimated * Rotation.from_quat(truth.quaternion[there]).inv()).as_matrix()
        yaw = np.unwrap(np.arctan2(turns[:, 1, 0], turns[:, 0, 0]))
        begin = np.searchsorted(track.stamp_ns, truth.stamp_ns[0] + 10 * SECOND)
        drifts.append(yaw[-1] - yaw[begin])
    return float(np.mean(drifts))


def accepted(result) -> list[bool]:
    return [event.accepted for event in result.of_kind(EventKind.AID)]


@pytest.mark.parametrize("drift", [-0.1, 0.1])
def test_a_heading_drift_of_both_feet_is_removed(drift):
    """A bias of 0.1 deg/s on both gyros, on 400 m, is half a right angle."""
    made = lap(route="track")
    pair = drifting(made, drift)
    off, on = tracker(False).run(*pair), tracker().run(*pair)
    assert abs(heading_drift(made, off)) > math.radians(20.0)
    assert abs(heading_drift(made, on)) < math.radians(8.0)
    assert np.mean(accepted(on)) > 0.95


def test_a_disturbed_field_is_gated_and_counted_and_does_not_pull():
    made = lap(MagnetometerConfig(disturbance=15.0), "figure_eight", 1)
    pair, used = align(made.left, made.right), tracker()
    on, off = used.run(*pair), tracker(False).run(*pair)
    assert np.mean(accepted(on)) < 0.05
    counted = used.counters["stances_before_field_reference"]
    assert counted + used.counters["stances_in_disturbed_field"] >= 0.9 * len(accepted(on))
    apart_m = np.linalg.norm(on.left.position[-1] - off.left.position[-1])
    assert apart_m < 0.01 * on.left.distance_m


def pairs_of(pair) -> Pairs:
    return Pairs(pair[0].stamp_ns, stack_pairs(*pair))


def fed_live(used: DualFootTracker, pair, late_ns: int = 0, found=None):
    """Feed pairs and fields in the order of their stamps; return ``found`` and what came out."""
    waiting = sorted(
        (int(stamp), foot, tesla.tolist())
        for foot, each in zip(FEET, pair, strict=True)
        for stamp, tesla in zip(each.field.stamp_ns, each.field.tesla, strict=True)
    )
    pairs = pairs_of(pair)
    for k, one in enumerate(pairs):
        while waiting and waiting[0][0] <= one.stamp_ns - late_ns:
            stamp, foot, tesla = waiting.pop(0)
            used.add_magnetic_field(foot, stamp, tesla)
        found = live(used, pairs[k : k + 1], found)
    for stamp, foot, tesla in waiting:
        used.add_magnetic_field(foot, stamp, tesla)
    return found


@pytest.mark.parametrize(
    ("method", "late_ns"),
    [("zupt", -3 * SECOND), ("spacing_vector", 0), ("spacing_vector", SECOND // 20)],
)
def test_live_gives_the_same_bits_as_batch_however_early_the_field_comes_or_a_little_late(
    method, late_ns
):
    made = lap(MagnetometerConfig(disturbance=1.5), "figure_eight", 2)
    pair = align(made.left, made.right)
    batch, one_by_one = tracker(method=method), tracker(method=method)
    found, whole = fed_live(one_by_one, pair, late_ns), batch.run(*pair)
    assert {True, False} == set(accepted(whole))
    same_bits(found, whole)
    assert batch.counters == one_by_one.counters


def test_the_field_of_the_series_is_taken_where_none_is_given_and_nan_is_not_measured():
    made = lap()
    left, right = align(made.left, made.right)
    field = left.magnetic_field.copy()
    field[::2] = np.nan
    thinned = left.__class__(left.stamp_ns, left.specific_force, left.angular_rate, field)
    used, same = tracker(), tracker()
    one = used.run(thinned, right)
    assert used.counters["fields"] == len(left) // 2 + len(right)
    assert used.counters["field_out_of_range"] == 0
    given = {"left": thinned.field, "right": right.field}
    other = same.run(thinned, right, fields=given)
    assert one.left.position.tobytes() == other.left.position.tobytes()


def test_the_field_changes_nothing_while_the_aid_is_off_and_is_counted_as_unused():
    made = lap()
    left, right = align(made.left, made.right)
    off, bare = tracker(False), tracker(False)
    one, other = off.run(left, right), bare.run(left, right, fields={})
    assert one.left.position.tobytes() == other.left.position.tobytes()
    assert off.counters["field_unused"] == len(left) + len(right)
    assert off.add_magnetic_field("left", 0, NORTH) == "field_unused"


def test_without_a_field_the_aid_does_nothing_and_counts_the_stances():
    made = lap()
    pair, on = align(made.left, made.right), tracker(method="idc")
    one, other = on.run(*pair, fields={}), tracker(False, method="idc").run(*pair)
    assert one.left.position.tobytes() == other.left.position.tobytes()
    assert on.counters["stances_without_field"] > 20


def test_bad_fields_are_refused_and_counted_by_name_and_never_raise():
    used = tracker()
    assert used.add_magnetic_field("left", 5 * SECOND, NORTH) is None
    for stamp in (5 * SECOND, 5 * SECOND - 1):
        assert used.add_magnetic_field("left", stamp, NORTH) == "field_out_of_order"
    nan, inf = float("nan"), float("inf")
    bad = ([nan, 0, 0], [0, inf, 0], [0, 0, 0], 1e6 * NORTH, [0.2, 0.2, -0.4], [1e200, 0, 0])
    for tesla in bad:
        assert used.add_magnetic_field("right", 6 * SECOND, tesla) == "field_out_of_range"
    assert used.counters["fields"] == 1
    assert used.counters["field_out_of_order"] == 2
    assert used.counters["field_out_of_range"] == len(bad)


@pytest.mark.parametrize("where", [0.0, 0.6])
def test_one_stamp_from_the_far_future_costs_no_stance_live_and_in_batch(where):
    made = lap()
    pair = align(made.left, made.right)
    plain = tracker().run(*pair)
    field, k = pair[0].field, round(where * len(pair[0]))
    stamps = np.insert(field.stamp_ns, k, field.stamp_ns[-1] + 10**15)
    wrong = FieldSeries(stamps, np.insert(field.tesla, k, NORTH, axis=0))
    found = tracker().run(*pair, fields={"left": wrong, "right": pair[1].field})
    assert found.left.position.tobytes() == plain.left.position.tobytes()
    used = tracker()
    first = fed_live(used, [each[:k] for each in pair]) if k else None
    used.add_magnetic_field("left", int(stamps[k]), NORTH)
    same_bits(fed_live(used, [each[k:] for each in pair], found=first), plain)


@pytest.mark.parametrize("late_ns", [-3 * SECOND, SECOND // 20])
def test_a_recording_that_begins_anew_is_tracked_as_the_first_time(late_ns):
    """The logs have the field of the first round under the same stamps, and later ones.

    The first pair of the second round is refused: alone it might be a stamp that is wrong.
    """
    made, used = lap(), tracker()
    pair = align(made.left, made.right)
    _, again = (fed_live(used, pair, late_ns) for _ in range(2))
    first = fed_live(tracker(), [each[1:] for each in pair], late_ns)
    assert used.counters["resets"] == 1
    assert again.turned().tobytes() == first.turned().tobytes()


@pytest.mark.parametrize(
    ("foot", "tesla", "words"),
    [("both", NORTH, "one of left, right"), ("left", [1e-5], r"allowed is \(3,\)")],
)
def test_a_field_of_no_foot_or_of_no_three_numbers_is_refused_with_what_is_allowed(
    foot, tesla, words
):
    with pytest.raises(ConfigError, match=words):
        tracker().add_magnetic_field(foot, 0, tesla)


@pytest.mark.parametrize("on", [True, False])
def test_a_series_of_no_foot_is_refused_even_if_it_is_empty_and_nobody_uses_it(on):
    made = lap()
    fields = {"both": FieldSeries(np.empty(0), np.empty((0, 3)))}
    with pytest.raises(ConfigError, match="magnetic field is of 'both'; allowed is one of left"):
        tracker(on).run(*align(made.left, made.right), fields=fields)


@pytest.mark.parametrize("shape", [(2,), (3, 3), (2, 2)])
def test_a_series_whose_parts_do_not_fit_together_is_refused(shape):
    with pytest.raises(SeriesError, match="allowed is"):
        FieldSeries(np.arange(2), np.zeros(shape))


def test_set_pose_takes_the_reference_along():
    """Turned by two radians in the middle of the walk, a track is not turned back."""
    made = lap()
    pair, used = align(made.left, made.right), tracker()
    fields = zip(FEET, pair, strict=True)
    for foot, each in fields:
        for stamp, tesla in zip(each.field.stamp_ns, each.field.tesla, strict=True):
            used._inputs.take_field(foot, int(stamp), tesla)
    pairs, yaws = pairs_of(pair), []
    for k, one in enumerate(pairs):
        update = used.add(one)
        if k == len(pairs) // 2:
            person = update.pedestrian()
            used.set_pose(person.position.tolist(), person.heading + 2.0)
        if update.row is not None:
            yaws.append(update.left.yaw)
    plain = tracker().run(*pair)
    before = Rotation.from_quat(plain.left.quaternion).as_euler("ZYX")[:, 0]
    off = np.angle(np.exp(1j * (yaws[-1] - before[-1] - 2.0)))
    assert abs(off) < 0.02
