"""A pair that just follows is taken by the kernel alone: the same as by the gate, bit for bit."""

from __future__ import annotations

from copy import deepcopy
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import DualFootTracker, ImuPair, TrackerConfig
from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.update import Update

from .following import key
from .harness import quick_engine, walk

PERIOD_NS = 16_666_667
LONGEST_NS = 28_333_333
steps = st.sampled_from(
    (PERIOD_NS,) * 6 + (0, -PERIOD_NS, LONGEST_NS - 9, LONGEST_NS + 9, 11 * 10**9, -(10**10))
)
numbers = st.sampled_from((0.1,) * 6 + (499.0, 600.0, np.nan, np.inf))


@cache
def walking_tracker() -> DualFootTracker:
    """Return a tracker in mid-walk, whose next pair may just follow."""
    tracker = DualFootTracker(TrackerConfig(method="idc"), engine=quick_engine().name)
    for pair in walk(9.0):
        tracker.add(pair)
    assert tracker._stream._walking is tracker._stream.session
    return tracker


def copy_of(tracker: DualFootTracker) -> DualFootTracker:
    """Return a tracker of its own in the same state."""
    code = tracker._stream.engine
    return deepcopy(tracker, {id(code): code})


def the_long_way(tracker: DualFootTracker, pair: ImuPair) -> Update:
    """Have a pair looked at as one of which nothing is known."""
    tracker._stream._walking = None
    return tracker.add(pair)


def content(update: Update) -> tuple:
    """Return all that an update says, in comparable form."""
    told = None if update._told is None else update._told.tobytes()
    events = [key(event) for event in update.announced]
    return update.stamp_ns, update.phase, update.refused, told, events


@given(st.lists(st.tuples(steps, numbers), min_size=2, max_size=30))
@settings(max_examples=40, deadline=None)
def test_the_short_way_is_the_long_one(pairs):
    short, long = copy_of(walking_tracker()), copy_of(walking_tracker())
    stamp, sample = walk(9.0).stamps[-1].item(), walk(9.0).values[-1]
    for step, number in pairs:
        stamp += step
        values = sample.copy()
        values[3] = number
        pair = ImuPair(stamp, values)
        assert content(short.add(pair)) == content(the_long_way(long, pair))
    assert short.counters == long.counters
    assert vars(short._stream.gate) == vars(long._stream.gate)
    spaces = [each._stream.session and each._stream.session.space for each in (short, long)]
    if spaces[0] is not None:  # no start from anew
        assert spaces[0].w.tobytes() == spaces[1].w.tobytes()


def followed(values: object, stamp_ns: int = PERIOD_NS) -> tuple[list[int], list[bytes]]:
    """Return what both forms of the kernel make of a sample that follows."""
    done, state = [], []
    for engine in (quick_engine(), interpreted()):
        space = deepcopy(walking_tracker()._stream.session.space)
        last = space.stamps.item(space.epoch % space.ring)
        told = np.zeros((1, lay.TOLD))
        stamp = last + stamp_ns
        done.append(engine.take_pair(space.w, space.n, space.stamps, stamp, values, told))
        state.append(space.w.tobytes() + space.n.tobytes() + told.tobytes())
    return done, state


@pytest.mark.parametrize(
    ("change", "taken"),
    [
        (lambda v: v, True),
        (lambda v: np.repeat(v, 2)[::2], False),
        (lambda v: v.astype(np.float32), False),
        (lambda v: v.astype(">f8"), False),
        (lambda v: np.append(v, 0.0), False),
        (lambda v: v[:11], False),
        (lambda v: v.reshape(12, 1), False),
        (lambda v: v.tolist(), False),
        (lambda v: v.view(np.recarray), False),
        (lambda v: np.frombuffer(b"0" + v.tobytes(), np.uint8)[1:].view(np.float64), False),
    ],
)
def test_both_forms_take_plain_samples_alone(change, taken):
    done, state = followed(change(walk(9.0).values[-1].copy()))
    expected = {lay.TAKEN, lay.TO_ATTEND} if taken else {lay.NOT_TAKEN}
    assert set(done) <= expected
    assert state[0] == state[1]


@pytest.mark.parametrize("stamp_ns", [2**70, -(2**70), 0, 1, LONGEST_NS - 1, LONGEST_NS + 9])
def test_both_forms_leave_alone_what_does_not_follow(stamp_ns):
    follows = 0 < stamp_ns <= walking_tracker()._stream.session.holes.longest_ns
    done, state = followed(walk(9.0).values[-1].copy(), stamp_ns)
    assert [each != lay.NOT_TAKEN for each in done] == [follows] * 2
    assert state[0] == state[1]


@pytest.mark.parametrize(
    "change", [lambda v: np.repeat(v, 2)[::2], lambda v: v.astype(">f8"), np.asfortranarray]
)
def test_a_sample_that_lies_otherwise_in_memory_gives_the_same_bits(change):
    one, other = copy_of(walking_tracker()), copy_of(walking_tracker())
    for k in range(1, 10):
        stamp, values = walk(9.0).stamps[-1].item() + k * PERIOD_NS, walk(9.0).values[-k].copy()
        update = one.add(ImuPair(np.int64(stamp), change(values)))
        assert content(update) == content(other.add(ImuPair(stamp, values)))
        assert type(update.stamp_ns) is int


def test_pairs_are_counted_whenever_they_are_asked_for():
    tracker = copy_of(walking_tracker())
    before = tracker.counters["pairs"]
    stamp, values = walk(9.0).stamps[-1].item(), walk(9.0).values[-1]
    for k in range(1, 8):
        tracker.add(ImuPair(stamp + k * PERIOD_NS, values))
        if k % 3 == 0:
            assert tracker.counters["pairs"] == before + k
    loaded = DualFootTracker.load(tracker.save(), engine=quick_engine().name)
    assert loaded.counters["pairs"] == tracker.counters["pairs"] == before + 7
    tracker.reset()
    assert tracker.counters["pairs"] == before + 7
