"""``add`` one by one, ``run`` over arrays, compiled and interpreted: the same bits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import (
    AlignmentError,
    DualFootTracker,
    EventKind,
    TrackerConfig,
    Trajectory,
)
from dualfoot_ros.core.constraints import METHODS as ALL_METHODS

from .following import live, same_bits
from .harness import Pairs, quick_engine, walk

METHODS = ("zupt", "idc")  # of those that differ in how they go back; all of them in one test
ENGINE = quick_engine().name


def clean_walk() -> Pairs:
    """Return six seconds of standing and ten of walking."""
    return walk(16.0)


def disturbed(pairs: Pairs, troubles: list[tuple[str, float]]) -> Pairs:
    """Return the pairs with troubles of the given kinds at the given shares of the recording."""
    stamps, values = list(pairs.stamps), list(pairs.values)
    for kind, share in sorted(troubles, key=lambda t: -t[1]):
        k = 1 + int(share * (len(stamps) - 3))
        if kind == "duplicate":
            stamps.insert(k, stamps[k])
            values.insert(k, values[k])
        elif kind == "disorder":
            stamps[k], stamps[k + 1] = stamps[k + 1], stamps[k]
            values[k], values[k + 1] = values[k + 1], values[k]
        elif kind == "not finite":
            values[k] = np.where(
                np.arange(12) == k % 12, (np.nan, np.inf, -np.inf)[k % 3], values[k]
            )
        elif kind == "out of range":
            values[k] = values[k] + 600.0
        elif kind == "lost":
            del stamps[k : k + 5], values[k : k + 5]
        elif kind == "gap":
            del stamps[k : k + 40], values[k : k + 40]
    return Pairs(np.array(stamps), np.array(values))


kinds = st.sampled_from(("duplicate", "disorder", "not finite", "out of range", "lost", "gap"))
troubles = st.lists(st.tuples(kinds, st.floats(0.0, 1.0)), max_size=8)

after_the_stand = st.lists(st.tuples(kinds, st.floats(0.4, 1.0)), max_size=8)


def both(method: str, pairs: Pairs) -> Trajectory | None:
    """Assert that a live run equals a batch run; return the latter, None when nothing aligned."""
    config = TrackerConfig(method=method)
    tracker = DualFootTracker(config, engine=ENGINE)
    followed = live(tracker, pairs)
    batch = DualFootTracker(config, engine=ENGINE)
    try:
        result = batch.run(*pairs.series())
    except AlignmentError:
        assert not followed.rows
        return None
    assert dict(+tracker.counters) == dict(+batch.counters)
    same_bits(followed, result)
    return result


@pytest.mark.parametrize("method", ALL_METHODS)
def test_live_equals_batch_to_the_bit_over_a_clean_walk(method):
    result = both(method, walk())
    assert result is not None
    kinds_seen = {event.kind for event in result.events}
    assert {EventKind.ALIGNED, EventKind.HEADING, EventKind.STANCE_END} <= kinds_seen
    if method in METHODS:
        assert (EventKind.CONSTRAINT in kinds_seen) == (method == "idc")


@given(troubles, st.sampled_from(METHODS))
@settings(max_examples=20, deadline=None)
def test_live_equals_batch_to_the_bit_whatever_is_wrong_with_the_recording(wrong, method):
    both(method, disturbed(clean_walk(), wrong))


@given(troubles, after_the_stand, st.floats(0.0, 1.9))
@settings(max_examples=7, deadline=None)
def test_live_equals_batch_to_the_bit_over_a_recording_that_begins_anew(before, after, late_s):
    first, second = disturbed(walk(9.0), before), disturbed(clean_walk(), after)
    shift = int(second.stamps[0] - first.stamps[0] - late_s * 1e9)
    joined = Pairs(
        np.concatenate([first.stamps, second.stamps - shift]),
        np.concatenate([first.values, second.values]),
    )
    result = both("idc", joined)
    assert result.events[0].kind is EventKind.RESET
    assert result.counters["resets"] == 1


def test_live_equals_batch_where_stamps_far_ahead_come_one_by_one():
    """Good pairs between them say that time has not jumped."""
    pairs = Pairs(clean_walk().stamps.copy(), clean_walk().values)
    for k, ahead_s in ((800, 11.0), (864, 10.0)):  # 0.07 s apart
        pairs.stamps[k] += round(ahead_s * 1e9)
    result = both("zupt", pairs)
    assert result.counters["far_ahead"] == 2


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("wrong", ([], [("duplicate", 0.7), ("gap", 0.8), ("lost", 0.9)]))
def test_interpreted_equals_compiled_to_the_bit(method, wrong):
    if ENGINE == "interpreted":
        pytest.skip("numba is not installed")
    pairs = disturbed(walk(10.5), wrong)
    config = TrackerConfig(method=method)
    interpreted = live(DualFootTracker(config, engine="interpreted"), pairs)
    same_bits(interpreted, DualFootTracker(config, engine="compiled").run(*pairs.series()))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("gone_s", [3.0, 5.2, 5.9])
def test_live_equals_batch_where_a_foot_is_missing_while_both_stand(method, gone_s):
    pairs = clean_walk()
    k = round(gone_s * len(pairs.stamps) / 16.0)
    pairs.values[k : k + 25, 6:] = np.nan
    assert both(method, pairs) is not None


def test_a_switch_of_the_engine_in_mid_walk_leaves_no_trace():
    if ENGINE == "interpreted":
        pytest.skip("numba is not installed")
    pairs = walk(12.0)
    tracker = DualFootTracker(engine="interpreted")
    followed = live(tracker, pairs[:560])
    tracker._stream.use(quick_engine())
    followed = live(tracker, pairs[560:], followed)
    assert followed.engines == {"interpreted", "compiled"}
    same_bits(followed, DualFootTracker(engine="compiled").run(*pairs.series()))


def test_running_twice_gives_the_same_bits():
    pairs = clean_walk()
    one, two = (DualFootTracker(engine=ENGINE).run(*pairs.series()) for _ in range(2))
    assert one.left.position.tobytes() == two.left.position.tobytes()
    assert one.relative_covariance[:].tobytes() == two.relative_covariance[:].tobytes()


def test_nothing_that_comes_later_changes_what_was_put_out_live():
    """A live estimate must not look ahead: a longer recording begins with the same rows."""
    short = live(DualFootTracker(engine=ENGINE), walk(12.0))
    long = live(DualFootTracker(engine=ENGINE), walk(16.0))
    assert np.array_equal(np.array(short.rows), np.array(long.rows)[: len(short.rows)])
