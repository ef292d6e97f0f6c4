"""Bad data is refused, counted and named; it never raises and never poisons the estimate."""

from __future__ import annotations

import json
import pickle
from copy import deepcopy
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import (
    DualFootTracker,
    EventKind,
    ImuPair,
    Refusal,
    TrackerConfig,
    refusal_of,
)
from dualfoot_ros.core.results.update import Update

from .harness import quick_engine, standing_samples, walk

QUICK = TrackerConfig.from_mapping(
    {"alignment": {"duration": 0.5, "window": 0.1, "still_rate_std": 1.0}}
)
BASE = 10**18
STEP = 10_000_000


@cache
def standing_tracker(engine: str) -> DualFootTracker:
    tracker = DualFootTracker(QUICK, engine=engine)
    for pair in standing_samples(100):
        tracker.add(pair)
    assert tracker.phase == "standing"
    return tracker


def aligned_tracker(engine: str | None = None) -> DualFootTracker:
    """Return a tracker of its own that has just been aligned."""
    made = standing_tracker(engine or quick_engine().name)
    code = made._stream.engine
    return deepcopy(made, {id(code): code})  # code is not copied


def next_pair(tracker: DualFootTracker, **changes: float) -> ImuPair:
    """Return a good pair that follows, but for the given elements (v0=...)."""
    values = standing_samples(1).values[0].copy()
    for name, value in changes.items():
        values[int(name[1:])] = value
    return ImuPair(tracker._stream.gate.last_ns + STEP, values)


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (float("nan"), "not_finite"),
        (float("inf"), "not_finite"),
        (-float("inf"), "not_finite"),
        (501.0, "out_of_range"),
        (-1e300, "out_of_range"),
    ],
)
@pytest.mark.parametrize("element", (0, 5, 11))
def test_a_bad_value_is_refused_by_name_and_counted(value, name, element):
    tracker = aligned_tracker()
    before = tracker.counters["pairs"]
    update = tracker.add(next_pair(tracker, **{f"v{element}": value}))
    assert (update.refused, update.left, update.row) == (name, None, None)
    assert tracker.counters[name] == 1
    assert tracker.counters["pairs"] == before


@pytest.mark.parametrize(
    ("behind_ns", "name"), [(0, "duplicate"), (1, "out_of_order"), (900_000_000, "out_of_order")]
)
def test_a_stamp_that_does_not_follow_is_refused_by_name_and_counted(behind_ns, name):
    tracker = aligned_tracker()
    pair = next_pair(tracker)
    update = tracker.add(ImuPair(tracker._stream.gate.last_ns - behind_ns, pair.values))
    assert update.refused == name
    assert tracker.counters[name] == 1
    assert tracker.phase == "standing"


def test_a_refused_pair_leaves_the_estimate_untouched():
    one, other = aligned_tracker(), aligned_tracker()
    good = next_pair(one)
    one.add(next_pair(one, v3=float("nan")))
    one.add(ImuPair(one._gate.last_ns, good.values))
    one.add(ImuPair(one._gate.last_ns - 5, good.values))
    assert one.add(good).row.tobytes() == other.add(good).row.tobytes()


def test_a_recording_that_begins_anew_is_counted_and_announced():
    """From the second pair on: one that is alone is refused, whatever its stamp."""
    tracker = aligned_tracker()
    values = next_pair(tracker).values
    assert tracker.add(ImuPair(BASE - 10**9, values)).refused == "out_of_order"
    update = tracker.add(ImuPair(BASE - 10**9 + STEP, values))
    assert update.refused is None
    assert update.phase == "aligning"
    assert tracker.counters["resets"] == 1
    resets = [e for e in update.events if e.kind is EventKind.RESET]
    assert [e.detail["reason"] for e in resets] == ["time jumped back"]


@pytest.mark.parametrize("jump_s", [-3600.0, -20.0, 30 * 86400.0, 10 * 365 * 86400.0])
def test_a_clock_that_is_set_costs_one_pair_and_nothing_else(jump_s):
    tracker = aligned_tracker()
    before = tracker.add(next_pair(tracker))
    first = tracker._stream.gate.last_ns + round(jump_s * 1e9)
    found = [tracker.add(ImuPair(first + k * STEP, next_pair(tracker).values)) for k in range(200)]
    assert [update.refused is None for update in found[:3]] == [False, True, True]
    assert tracker.counters["clock_jumps"] == 1 and tracker.counters["resets"] == 0
    assert np.isfinite(found[-1].row).all()
    assert np.abs(found[-1].left.position - before.left.position).max() < 0.05
    assert found[-1].left.pose_covariance()[5, 5] < before.left.pose_covariance()[5, 5] + 0.1**2


def test_a_gap_is_counted_bridged_and_widens_the_uncertainty():
    tracker = aligned_tracker()
    before = tracker.add(next_pair(tracker)).left.pose_covariance()
    pair = next_pair(tracker)
    after = tracker.add(ImuPair(pair.stamp_ns + 3 * 10**9, pair.values))
    assert tracker.counters["gaps"] == 1
    assert after.refused is None
    assert after.left.pose_covariance()[0, 0] > before[0, 0] + 1.0
    assert np.linalg.norm(after.left.position) < 0.1


anything = st.floats(allow_nan=True, allow_infinity=True, width=64)
values = st.lists(anything, min_size=12, max_size=12)
within = st.lists(st.floats(-499.0, 499.0), min_size=12, max_size=12)
stamps = st.integers(-(2**63), 2**63 - 1)
steps = st.integers(-2_000_000_000, 2_000_000_000)


def total(tracker: DualFootTracker, stamp: int, numbers: list[float]) -> None:
    """Add one pair and check that what comes back is an update and every pair is counted."""
    names = ("not_finite", "out_of_range", "duplicate", "out_of_order", "far_ahead", "pairs")
    before = sum(tracker.counters[name] for name in names)
    update = tracker.add(ImuPair(stamp, np.array(numbers)))
    assert isinstance(update, Update)
    assert update.stamp_ns == stamp
    assert sum(tracker.counters[name] for name in names) == before + 1
    assert update.events is not None
    if update.row is not None:
        assert update.left.pose_covariance().shape == (6, 6)
        assert update.pedestrian() is not None


@given(st.lists(st.tuples(stamps, values), max_size=30))
@settings(max_examples=60, deadline=None)
def test_add_never_raises_for_any_numbers_and_any_stamps_while_aligning(pairs):
    tracker = DualFootTracker(QUICK, engine="interpreted")
    for stamp, numbers in pairs:
        total(tracker, stamp, numbers)


@given(st.lists(st.tuples(stamps, st.just([0.0, 0.0, 9.8, 0.0, 0.0, 0.0] * 2)), max_size=60))
@settings(max_examples=40, deadline=None)
def test_add_never_raises_for_a_standstill_with_any_stamps(pairs):
    tracker = DualFootTracker(QUICK, engine="interpreted")
    for stamp, numbers in pairs:
        total(tracker, stamp, numbers)


@given(st.integers(1, 10**17))
@settings(max_examples=40, deadline=None)
def test_add_never_raises_at_any_rate(step):
    tracker = DualFootTracker(QUICK, engine="interpreted")
    still = standing_samples(60).values
    for k in range(60):
        total(tracker, -(2**62) + k * step, still[k].tolist())


@given(st.lists(st.tuples(steps, st.one_of(values, within)), max_size=40))
@settings(max_examples=60, deadline=None)
def test_add_never_raises_for_anything_once_aligned(pairs):
    for engine in ("interpreted", quick_engine().name):
        tracker = aligned_tracker(engine)
        stamp = tracker._stream.gate.last_ns
        for step, numbers in pairs:
            stamp += step
            total(tracker, stamp, numbers)


@given(st.integers(0, 100_000), st.sampled_from((1e-3, 1.0, 100.0, 499.0)))
@settings(max_examples=20, deadline=None)
def test_a_violent_recording_within_range_gives_finite_numbers(seed, size):
    tracker, rng = aligned_tracker(), np.random.default_rng(seed)
    for _ in range(300):
        numbers = rng.uniform(-size, size, 12)
        update = tracker.add(ImuPair(tracker._stream.gate.last_ns + STEP, numbers))
        assert np.isfinite(update.row).all()


def test_a_day_without_data_leaves_finite_numbers_and_a_filter_that_goes_on():
    pairs = walk(12.0)
    tracker = DualFootTracker(engine=quick_engine().name)
    for pair in pairs:
        tracker.add(pair)
    late = 86_400 * 10**9
    first, *others = pairs
    refused = tracker.add(ImuPair(first.stamp_ns + late, first.values)).refused
    assert refused == "far_ahead"  # until another stamp says the same
    for pair in others:
        update = tracker.add(ImuPair(pair.stamp_ns + late, pair.values))
        assert np.isfinite(update.row).all()
    eigenvalues = np.linalg.eigvalsh(update.left.pose_covariance())
    assert eigenvalues[0] > -1e-9 * eigenvalues[-1]


@pytest.mark.parametrize("reason", list(Refusal))
def test_the_counter_of_a_reason_leads_back_to_it_with_its_foot(reason):
    assert refusal_of(str(reason)) == (reason, "")
    for foot in ("left", "right"):
        assert refusal_of(f"{foot}_{reason}") == (reason, foot)


@pytest.mark.parametrize("counter", ["pairs", "samples", "left_accepted", "not_finite_left", ""])
def test_a_counter_of_anything_else_is_no_reason(counter):
    assert refusal_of(counter) is None


@pytest.mark.parametrize("reason", list(Refusal))
def test_a_reason_is_a_phrase_that_fits_into_a_sentence(reason):
    assert reason.words == reason.words.strip() and not reason.words.endswith((".", ":"))
    assert reason.words[0].islower() and "_" not in reason.words


def test_reasons_count_and_travel_as_plain_text():
    counters = {Refusal.NOT_FINITE: 3}
    assert counters == {"not_finite": 3} and counters["not_finite"] == 3
    assert json.loads(json.dumps(counters)) == counters
    assert pickle.loads(pickle.dumps(Refusal.LATE)) is Refusal.LATE
