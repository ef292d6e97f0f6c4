"""One foot without samples: the other goes on, and the foot is joined again when it is back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import DualFootTracker, EventKind, ImuPair, TrackerConfig

from ..following import live, same_bits
from ..harness import Pairs, quick_engine, simulated, walk

ENGINE = quick_engine().name
RATE = 60.0


def without(pairs: Pairs, foot: int, first_s: float, last_s: float) -> Pairs:
    """Return the pairs with nan for ``foot`` from ``first_s`` to ``last_s``."""
    values = pairs.values.copy()
    values[round(first_s * RATE) : round(last_s * RATE), 6 * foot : 6 * foot + 6] = np.nan
    return Pairs(pairs.stamps, values)


def run(pairs: Pairs, **options):
    config = TrackerConfig.from_mapping(options)
    return DualFootTracker(config, engine=ENGINE).run(*pairs.series())


@pytest.mark.parametrize("foot", (0, 1))
@pytest.mark.parametrize("method", ("zupt", "idc", "spacing_vector"))
def test_the_other_foot_goes_on_at_full_rate_and_the_one_that_is_back_is_joined(foot, method):
    whole = walk()
    plain, result = run(whole, method=method), run(without(whole, foot, 14.0, 19.0), method=method)
    assert np.array_equal(result.left.stamp_ns, plain.left.stamp_ns)
    tracks = (result.left, result.right)
    missing = ~tracks[foot].present
    assert missing.sum() == round(5.0 * RATE) and tracks[1 - foot].present.all()
    assert not tracks[foot].stance[missing].any()
    for track in tracks:
        assert np.isfinite(track.position).all()
    (gone,), (joined,) = (result.of_kind(k) for k in (EventKind.MISSING, EventKind.JOINED))
    assert gone.foot == joined.foot == ("left", "right")[foot]
    back_ns = int(whole.stamps[round(19.0 * RATE)])
    stances = [e for e in result.of_kind(EventKind.STANCE_END, gone.foot) if e.stamp_ns > back_ns]
    assert joined.detected_ns <= stances[1].detected_ns  # within two of its stances


@pytest.mark.parametrize(("method", "median_m", "most_m"), [(None, 0.3, 0.7), ("zupt", 0.8, 1.6)])
def test_a_foot_that_was_away_for_five_seconds_is_hardly_off_ten_seconds_later(
    method, median_m, most_m
):
    """Before, in and after a corner, whichever foot it is: it goes on where it would have been."""
    off = []
    options = {"method": method} if method else {}
    for seed, start in ((0, 14.0), (1, 16.0), (2, 18.0)):
        whole = walk(round(start) + 16.0, seed=seed)
        plain = run(whole, **options)
        k = int(np.searchsorted(plain.left.stamp_ns, whole.stamps[round((start + 15.0) * RATE)]))
        for foot in (0, 1):
            result = run(without(whole, foot, start, start + 5.0), **options)
            for one, other in ((plain.left, result.left), (plain.right, result.right)):
                off.append(np.linalg.norm((one.position - other.position)[k, :2]))
            apart = result.left.position[k:] - result.right.position[k:]
            assert np.linalg.norm(apart[:, :2], axis=1).max() < 1.5 + most_m
    assert np.median(off) < median_m and max(off) < most_m


def test_the_first_zero_velocity_of_a_foot_that_is_back_does_not_tell_its_place():
    """Standing now says nothing of how fast the foot went meanwhile."""
    whole = walk(24.0)
    for start in np.arange(14.0, 15.2, 0.2):
        result = run(without(whole, 0, start, start + 4.0), method="zupt")
        (joined,) = result.of_kind(EventKind.JOINED)
        back_ns = int(whole.stamps[round((start + 4.0) * RATE)])
        between = (result.left.stamp_ns >= back_ns) & (result.left.stamp_ns < joined.detected_ns)
        covariance = result.left.position_covariance[between, :2, :2]
        assert np.sqrt(np.trace(covariance, axis1=1, axis2=2)).min() > 5.0


def test_a_foot_that_is_away_is_as_uncertain_as_its_absence_makes_it():
    whole = walk()
    result = run(without(whole, 0, 14.0, 19.0))
    gone = np.flatnonzero(~result.left.present)
    stds = np.sqrt(np.trace(result.left.position_covariance[:, :2, :2], axis1=1, axis2=2))
    assert (np.diff(stds[gone[5:]]) > 0.0).all()
    assert stds[gone[-1]] > 5.0
    assert stds[-1] < 1.0


@pytest.mark.parametrize("foot", (0, 1))
def test_one_sensor_alone_gives_its_track(foot):
    whole = walk(route="straight")
    result = run(without(whole, foot, 0.0, 1e6))
    track = (result.left, result.right)[1 - foot]
    made = simulated(route="straight")
    truth = (made.left_truth, made.right_truth)[1 - foot]
    way = np.linalg.norm(np.ptp(truth.position[:, :2], axis=0))
    assert np.linalg.norm(track.position[-1, :2] - track.position[0, :2]) == pytest.approx(
        way, rel=0.05
    )
    assert result.of_kind(EventKind.HEADING, ("left", "right")[1 - foot])


def test_a_foot_that_comes_late_is_joined():
    result = run(without(walk(), 1, 0.0, 20.0))
    (joined,) = result.of_kind(EventKind.JOINED)
    assert joined.foot == "right"
    apart = (result.left.position - result.right.position)[-1]
    assert np.linalg.norm(apart[:2]) < 1.2


spans = st.lists(
    st.tuples(st.sampled_from((0, 1)), st.floats(3.0, 16.0), st.floats(0.01, 4.0)), max_size=5
)


@given(spans, st.sampled_from(("zupt", "idc", "spacing_vector")))
@settings(max_examples=15, deadline=None)
def test_live_equals_batch_to_the_bit_with_any_pattern_of_missing_samples(away, method):
    pairs = walk(18.0)
    for foot, first_s, seconds in away:
        pairs = without(pairs, foot, first_s, first_s + seconds)
    config = TrackerConfig(method=method)
    tracker, batch = (DualFootTracker(config, engine=ENGINE) for _ in range(2))
    followed = live(tracker, pairs)
    same_bits(followed, batch.run(*pairs.series()))
    assert dict(+tracker.counters) == dict(+batch.counters)


@pytest.mark.parametrize(("seconds", "most_m"), [(0.1, 0.5), (0.15, 1.0)])
def test_a_hole_of_both_feet_is_filled_and_its_cost_is_within_two_sigma(seconds, most_m):
    off, within = [], []
    whole = walk()
    plain = run(whole)
    for k in range(14):
        first = round((10.0 + 1.13 * k) * RATE)
        keep = np.ones(len(whole), dtype=bool)
        keep[first : first + round(seconds * RATE)] = False
        result = run(Pairs(whole.stamps[keep], whole.values[keep]))
        assert result.counters["filled"] == 1
        stamp = int(whole.stamps[first]) + 8 * 10**9
        for one, other in ((plain.left, result.left), (plain.right, result.right)):
            i, j = np.searchsorted(one.stamp_ns, stamp), np.searchsorted(other.stamp_ns, stamp)
            shift = np.linalg.norm((one.position[i] - other.position[j])[:2])
            off.append(shift)
            within.append(shift < 2.0 * np.sqrt(np.trace(other.position_covariance[j][:2, :2])))
    assert np.median(off) < most_m and np.mean(within) > 0.9


def test_what_is_no_number_never_leaves():
    whole = walk(14.0)
    tracker = DualFootTracker(engine=ENGINE)
    pairs = [ImuPair(int(s), v) for s, v in zip(whole.stamps, whole.values, strict=True)]
    for pair in pairs[:600]:
        tracker.add(pair)
    tracker._stream.session.space.w[0] = np.nan
    update = tracker.add(pairs[600])
    assert update.row is None and tracker.phase == "aligning"
    assert [e.detail["reason"] for e in update.events] == ["the estimate was not finite"]
