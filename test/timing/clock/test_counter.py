"""Counters wrap, devices restart, links stall; device time goes on or begins anew."""

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.timing import CounterConfig, Unwrapper

SECOND = 1_000_000_000
KINDS = [("16", 1e3), ("32", 1e6), ("32", 32768.0), ("64", 1e6), ("64", 1e9)]


def feed(unwrapper, counts, arrivals=None):
    times = arrivals or [None] * len(counts)
    return [unwrapper.time_ns(c, a) for c, a in zip(counts, times, strict=True)]


@given(
    kind=st.sampled_from(KINDS),
    start=st.floats(0.0, 1.0, exclude_max=True),
    steps=st.lists(st.integers(1, 400), min_size=1, max_size=50),
    with_arrivals=st.booleans(),
)
def test_a_wrap_at_any_position_changes_no_difference(kind, start, steps, with_arrivals):
    bits, rate = kind
    config = CounterConfig(bits=bits, rate=rate)
    first = int(start * config.range)
    total = [first]
    for step in steps:
        total.append(total[-1] + step)
    arrivals = [round(t * 1e9 / rate) + 5 for t in total] if with_arrivals else None
    unwrapper = Unwrapper(config)
    found = feed(unwrapper, [t % config.range for t in total], arrivals)
    exact = [Fraction(t) * SECOND / Fraction(rate) for t in total]
    assert all(abs(f - e) <= 1 for f, e in zip(found, exact, strict=True))
    assert unwrapper.counters["wraps"] == total[-1] // config.range
    assert unwrapper.epoch == 0


@given(position=st.integers(-200, 200))
def test_the_last_microsecond_before_a_wrap_is_one_before_zero(position):
    edge = 1 << 32
    unwrapper = Unwrapper(CounterConfig(bits="32"))
    counts = [(edge + position + k) % edge for k in range(3)]
    found = feed(unwrapper, counts)
    assert [b - a for a, b in pairwise(found)] == [1000, 1000]


def test_ticks_of_a_watch_crystal_do_not_drift_in_half_a_day():
    unwrapper = Unwrapper(CounterConfig(bits="32", rate=32768.0, max_gap=1e6))
    unwrapper.time_ns(0)
    half = 43_200
    assert unwrapper.time_ns(half * 32768) == half * SECOND


def test_whole_turns_during_a_gap_are_found_from_the_arrivals():
    turn_ns = 65_536_000_000  # 16 bits of milliseconds
    unwrapper = Unwrapper(CounterConfig(bits="16", rate=1e3))
    unwrapper.time_ns(65_000, 0)
    gap_ns = 3 * turn_ns + 700_000_000
    found = unwrapper.time_ns((65_000 + gap_ns // 1_000_000) % 65_536, gap_ns + 40_000_000)
    assert found - 65_000_000_000 == gap_ns
    assert unwrapper.epoch == 0


def test_a_device_that_starts_again_at_zero_begins_a_new_epoch():
    unwrapper = Unwrapper(CounterConfig(bits="32"))
    feed(unwrapper, [1_200_000_000, 1_200_010_000], [0, 10_000_000])
    assert unwrapper.time_ns(5_000, 3 * SECOND) == 5_000_000
    assert unwrapper.epoch == 1
    assert unwrapper.counters["restarts"] == 1


def test_a_count_far_ahead_of_the_host_is_a_jump():
    unwrapper = Unwrapper(CounterConfig(bits="64"))
    feed(unwrapper, [0, 10_000], [0, 10_000_000])
    unwrapper.time_ns(3_600_000_000, 20_000_000)
    assert unwrapper.epoch == 1
    assert unwrapper.counters["jumps"] == 1


def test_without_arrivals_a_step_longer_than_the_gap_is_no_step():
    unwrapper = Unwrapper(CounterConfig(bits="64", max_gap=10.0))
    feed(unwrapper, [50_000_000, 50_010_000])
    assert unwrapper.time_ns(20) == 20_000
    assert unwrapper.counters["restarts"] == 1


def test_a_link_that_stalls_for_long_and_then_delivers_all_is_no_restart():
    unwrapper = Unwrapper(CounterConfig(bits="32"))
    counts = [k * 10_000 for k in range(1000)]
    arrivals = [
        k * 10_000_000 if k < 100 else max(8 * SECOND, k * 10_000_000) for k in range(1000)
    ]
    assert feed(unwrapper, counts, arrivals) == [c * 1000 for c in counts]
    assert unwrapper.epoch == 0


def test_repeated_and_swapped_counts_are_counted_and_keep_their_times():
    unwrapper = Unwrapper()
    assert feed(unwrapper, [0, 10, 10, 30, 20, 40]) == [0, 10_000, 10_000, 30_000, 20_000, 40_000]
    assert unwrapper.counters["duplicates"] == 1
    assert unwrapper.counters["out_of_order"] == 1
    assert unwrapper.counters["counted"] == 6


@given(st.lists(st.integers(-(2**70), 2**70), max_size=60), st.booleans())
def test_nothing_a_device_sends_raises(counts, with_arrivals):
    unwrapper = Unwrapper()
    arrivals = [k * 10_000_000 for k in range(len(counts))] if with_arrivals else None
    assert all(isinstance(t, int) for t in feed(unwrapper, counts, arrivals))


@pytest.mark.parametrize("bits", ["8", "24"])
def test_other_widths_are_refused_by_name(bits):
    with pytest.raises(Exception, match=f"bits.*{bits}.*16, 32, 64"):
        CounterConfig(bits=bits)
