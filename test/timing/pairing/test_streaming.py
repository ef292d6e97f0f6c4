"""The streaming aligner: the same pairs as in batch, bounded delay and memory, nothing raised."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.timing import Aligner, AlignerConfig, align_with_report

MS = 1_000_000
SAMPLE = np.arange(6.0)

intervals = st.lists(st.integers(-3 * MS, 120 * MS), min_size=1, max_size=80)
rates = st.sampled_from([0.0, 60.0, 100.0, 333.0])


def noisy(stamps, seed):
    """Return a series of random values, a few of them not finite."""
    rng = np.random.default_rng(seed)
    values = rng.normal(size=(2, len(stamps), 3))
    values[0][rng.random((len(stamps), 3)) < 0.01] = np.nan
    return ImuSeries(np.asarray(stamps, dtype=np.int64), values[0], values[1])


def arrivals(left, right, lateness=None):
    """Yield foot, stamp and values in the order in which they would arrive."""
    feet = [("left", left), ("right", right)]
    items = [
        (int(np.maximum.accumulate(s.stamp_ns)[i]) + (lateness or {}).get(foot, 0), k, i)
        for k, (foot, s) in enumerate(feet)
        for i in range(len(s))
    ]
    for _, k, i in sorted(items):
        foot, s = feet[k]
        yield foot, s.stamp_ns[i], np.concatenate([s.specific_force[i], s.angular_rate[i]])


def stream(config, samples):
    aligner = Aligner(config)
    pairs = [pair for sample in samples for pair in aligner.push(*sample)]
    return aligner, pairs


@settings(deadline=None)
@given(
    intervals,
    intervals,
    rates,
    st.sampled_from(["left", "right"]),
    st.sampled_from(["interpolate", "hold"]),
    st.integers(0, 150 * MS),
    st.integers(0, 2**31),
)
def test_streaming_and_batch_give_the_same_pairs_to_the_bit(
    a, b, rate, reference, between, late, seed
):
    left, right = noisy(np.cumsum(a) + 10**9, seed), noisy(np.cumsum(b) + 10**9, seed + 1)
    config = AlignerConfig(rate=rate, reference=reference, between=between, restart_after=1000)
    aligner, pairs = stream(config, arrivals(left, right, {"right": late}))
    batch_left, batch_right, report = align_with_report(left, right, config)
    assert [p.stamp_ns for p in pairs] == batch_left.stamp_ns.tolist()
    values = np.array([p.values for p in pairs]).reshape(-1, 12)
    assert np.array_equal(values, stack_pairs(batch_left, batch_right))
    for name in ("pairs", "interpolated", "left_gap", "right_duplicate", "left_out_of_order"):
        assert aligner.counters[name] == report.counters[name]


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 2**62)), max_size=200), rates)
def test_any_stamps_in_any_order_give_increasing_pairs_and_no_exception(samples, rate):
    aligner, pairs = stream(
        AlignerConfig(rate=rate, restart_after=1000),
        (("left" if is_left else "right", stamp, SAMPLE) for is_left, stamp in samples),
    )
    stamps = [p.stamp_ns for p in pairs]
    assert stamps == sorted(set(stamps))
    counters = aligner.counters
    seen = sum(
        counters[f"{foot}_{name}"]
        for foot in ("left", "right")
        for name in ("accepted", "not_finite", "duplicate", "out_of_order")
    )
    assert seen == len(samples)


def test_a_silent_foot_delays_nothing_beyond_the_stated_time_and_is_counted():
    config = AlignerConfig(max_gap=0.05, max_delay=0.1)
    aligner = Aligner(config)
    for k in range(10):
        aligner.push("left", k * 10 * MS, SAMPLE)
        aligner.push("right", k * 10 * MS, SAMPLE)
    for k in range(10, 100):
        assert aligner.push("left", k * 10 * MS, SAMPLE) == []
    assert aligner.counters["late"] == 79  # 100 ms of samples still wait
    late = [p for k in range(10, 100) for p in aligner.push("right", k * 10 * MS, SAMPLE)]
    assert [p.stamp_ns for p in late] == [k * 10 * MS for k in range(89, 100)]


def test_a_foot_late_by_less_than_the_delay_loses_no_pair():
    stamps = np.arange(300) * 10 * MS
    left, right = noisy(stamps, 0), noisy(stamps + 3 * MS, 1)
    left.specific_force[:] = right.specific_force[:] = 1.0
    aligner, pairs = stream(AlignerConfig(), arrivals(left, right, {"left": 90 * MS}))
    assert len(pairs) == 299
    assert aligner.counters["late"] == aligner.counters["in_gap"] == 0


@settings(deadline=None)
@given(
    st.lists(st.integers(2 * MS, 30 * MS), min_size=5, max_size=60),
    st.lists(st.integers(2 * MS, 30 * MS), min_size=5, max_size=60),
    rates,
    st.integers(0, 60 * MS),
    st.floats(0.25, 10.0),
)
def test_feet_that_are_in_time_never_wait_however_long_a_late_one_would_be_waited_for(
    a, b, rate, late, max_delay
):
    left, right = noisy(np.cumsum(a), 0), noisy(np.cumsum(b), 1)
    samples = list(arrivals(left, right, {"right": late}))
    short, long = (Aligner(AlignerConfig(rate=rate, max_delay=d)) for d in (0.25, max_delay))
    for sample in samples:
        found = [[p.stamp_ns for p in each.push(*sample)] for each in (short, long)]
        assert found[0] == found[1]


def test_by_default_a_foot_that_is_held_up_for_most_of_a_second_loses_nothing():
    aligner = Aligner()
    for k in range(10):
        aligner.push("left", k * 10 * MS, SAMPLE)
        aligner.push("right", k * 10 * MS, SAMPLE)
    for k in range(10, 100):
        assert aligner.push("left", k * 10 * MS, SAMPLE) == []
    for k in range(10, 100):
        assert len(aligner.push("right", k * 10 * MS, SAMPLE)) == 1
    assert aligner.counters["late"] == 0 and aligner.counters["pairs"] == 100


def test_the_memory_of_an_aligner_does_not_grow_while_one_foot_is_silent():
    aligner = Aligner(AlignerConfig(max_delay=0.25))
    for k in range(5000):
        aligner.push("right", k * 5 * MS, SAMPLE)
    assert len(aligner._buffers["right"].samples) < 60


def test_a_stream_that_begins_anew_is_taken_up_again_and_counted():
    aligner = Aligner(AlignerConfig(restart_after=10))
    for k in list(range(100)) + list(range(100)):
        for foot in ("left", "right"):
            pairs = aligner.push(foot, k * 10 * MS, SAMPLE)
    assert aligner.counters["restarts"] >= 1
    assert [p.stamp_ns for p in pairs] == [99 * 10 * MS]


def test_one_stamp_far_in_the_future_does_not_silence_a_foot_for_good():
    aligner = Aligner(AlignerConfig())
    for k in range(200):
        aligner.push("left", k * 10 * MS, SAMPLE)
        pairs = aligner.push("right", 10**18 if k == 50 else k * 10 * MS, SAMPLE)
    assert [p.stamp_ns for p in pairs] == [1990 * MS]
    assert aligner.counters["right_out_of_order"] == 20


def test_a_hole_of_hours_on_a_uniform_grid_is_jumped_at_once():
    aligner = Aligner(AlignerConfig(rate=200.0))
    hours = 10 * 3600 * 10**9
    for start in (0, hours):
        for k in range(100):
            for foot in ("left", "right"):
                pairs = aligner.push(foot, start + k * 5 * MS, SAMPLE)
    assert [p.stamp_ns for p in pairs] == [hours + 99 * 5 * MS]
    assert aligner.counters["in_gap"] == 36000 * 200 - 100
