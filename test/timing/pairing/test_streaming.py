"""The streaming aligner: the same pairs as in batch, bounded delay and memory, nothing raised."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import FEET, ImuSeries
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
    return aligner, [*pairs, *aligner.finish()]


def assert_as_in_batch(config, left, right, lateness=None):
    """Check that streaming gives the pairs of the batch to the bit, and counts the same."""
    aligner, pairs = stream(config, arrivals(left, right, lateness))
    batch_left, batch_right, report = align_with_report(left, right, config)
    assert [p.stamp_ns for p in pairs] == batch_left.stamp_ns.tolist()
    values = np.array([p.values for p in pairs]).reshape(-1, 12)
    assert np.array_equal(values, stack_pairs(batch_left, batch_right), equal_nan=True)
    for name in COUNTED:
        assert aligner.counters[name] == report.counters[name]
    return report


COUNTED = (
    "pairs", "interpolated", "left_missing", "right_missing", "left_gap", "right_duplicate",
    "left_out_of_order",
)  # fmt: skip


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
    assert_as_in_batch(config, left, right, {"right": late})


ticks = st.lists(st.integers(1, 12), min_size=35, max_size=120)
holes = st.lists(st.tuples(st.integers(0, 119), st.integers(1, 300)), max_size=4)


@settings(deadline=None)
@given(
    ticks,
    ticks,
    holes,
    holes,
    st.integers(0, 900 * MS),
    st.sampled_from([0.0, 100.0]),
    st.sampled_from(["left", "right"]),
    st.integers(0, 2**31),
)
def test_lost_samples_and_holes_of_any_length_give_the_same_pairs_as_in_batch(
    a, b, holes_a, holes_b, start, rate, reference, seed
):
    feet = []
    for k, (lost, long, from_ns) in enumerate([(a, holes_a, 10**9), (b, holes_b, 10**9 + start)]):
        steps = np.where(np.array(lost) < 11, 1, np.array(lost) - 9)  # two in twelve are holes
        for at, more in long:
            steps[at % len(steps)] += more
        jitter = np.random.default_rng([seed, k]).integers(-MS, MS, len(steps))
        feet.append(noisy(from_ns + 10 * MS * np.cumsum(steps) + jitter, seed + k))
    assert_as_in_batch(AlignerConfig(rate=rate, reference=reference, restart_after=1000), *feet)


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


def push_both(aligner, stamps):
    return [pair for t in stamps for foot in FEET for pair in aligner.push(foot, t, SAMPLE)]


def both_there(pairs):
    return [p.stamp_ns for p in pairs if not np.isnan(p.values).any()]


def test_a_silent_foot_is_waited_for_once_and_then_the_other_goes_on_at_full_rate():
    aligner = Aligner(AlignerConfig(max_gap=0.05, max_delay=0.1))
    push_both(aligner, range(0, 100 * MS, 10 * MS))
    alone = [aligner.push("left", k * 10 * MS, SAMPLE) for k in range(10, 100)]
    assert [len(pairs) for pairs in alone] == [0] * 11 + [11] + [1] * 78
    assert all(np.isnan(p.values[6:]).all() for pairs in alone for p in pairs)
    assert aligner.present == {"left": True, "right": False}
    back = push_both(aligner, range(1000 * MS, 1100 * MS, 10 * MS))
    assert both_there(back) == list(range(1000 * MS, 1100 * MS, 10 * MS))
    assert aligner.present == {"left": True, "right": True}


@pytest.mark.parametrize("foot", FEET)
@pytest.mark.parametrize("reference", FEET)
def test_a_foot_that_is_silent_gives_the_pairs_of_the_whole_walk_without_its_values(
    foot, reference
):
    """So what a silent foot costs is the same behind the aligner as in the tracker alone."""
    stamps = 10**18 + 10 * MS * np.arange(900)
    feet = dict(zip(FEET, (noisy(stamps, 1), noisy(stamps, 2)), strict=True))
    feet = {f: ImuSeries(stamps, *np.nan_to_num((s.specific_force, s.angular_rate)))
            for f, s in feet.items()}  # fmt: skip
    whole = stack_pairs(*feet.values())
    away = slice(200, 700)
    column = 6 * FEET.index(foot)
    whole[away, column : column + 6] = np.nan
    feet[foot] = feet[foot][np.r_[:200, 700:900]]
    _, pairs = stream(AlignerConfig(reference=reference), arrivals(**feet))
    assert [pair.stamp_ns for pair in pairs] == stamps.tolist()
    assert np.array_equal([pair.values for pair in pairs], whole, equal_nan=True)


def test_a_foot_that_comes_back_as_late_as_its_link_is_waited_for_again():
    aligner = Aligner()
    late = 20  # samples
    pairs = []
    for k in range(1000):
        pairs += aligner.push("left", k * 10 * MS, SAMPLE)
        if k >= late and not 300 <= k < 500:
            pairs += aligner.push("right", (k - late) * 10 * MS, SAMPLE)
    back = [t for t in both_there(pairs) if t > 4800 * MS]
    assert back[0] <= 5010 * MS
    assert np.diff(back).max() == 10 * MS


def test_a_foot_that_is_hopelessly_late_is_not_waited_for():
    aligner = Aligner()
    pairs = []
    for k in range(1000):
        pairs += aligner.push("left", k * 10 * MS, SAMPLE)
        if k >= 70:
            pairs += aligner.push("right", (k - 70) * 10 * MS, SAMPLE)
    assert not both_there(pairs)
    assert pairs[-1].stamp_ns == 9980 * MS
    assert np.diff([p.stamp_ns for p in pairs]).max() == 10 * MS


@pytest.mark.parametrize("alone", ["left", "right"])
def test_one_foot_alone_is_paired_with_nothing_from_the_start(alone):
    for aligner in (Aligner(), Aligner(feet=[alone])):
        pairs = [p for k in range(200) for p in aligner.push(alone, k * 10 * MS, SAMPLE)]
        assert [p.stamp_ns for p in pairs][:190] == list(range(0, 1900 * MS, 10 * MS))
    assert len(pairs) == 200  # and none waits where it is known that there is one foot only


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


def test_by_default_a_foot_that_is_held_up_for_half_a_second_loses_nothing():
    aligner = Aligner()
    push_both(aligner, range(0, 100 * MS, 10 * MS))
    for k in range(10, 60):
        assert aligner.push("left", k * 10 * MS, SAMPLE) == []
    for k in range(10, 60):
        assert len(aligner.push("right", k * 10 * MS, SAMPLE)) == 1
    assert aligner.counters["late"] == 0 and aligner.counters["pairs"] == 60


def test_the_memory_of_an_aligner_does_not_grow_while_one_foot_is_silent():
    aligner = Aligner(AlignerConfig(max_delay=0.25))
    for k in range(5000):
        aligner.push("right", k * 5 * MS, SAMPLE)
    assert len(aligner._buffers["right"].samples) < 80


def test_a_stream_that_begins_anew_is_taken_up_again_and_counted():
    aligner = Aligner(AlignerConfig(restart_after=10))
    for _ in range(2):
        pairs = push_both(aligner, range(0, 1000 * MS, 10 * MS))
    assert aligner.counters["restarts"] >= 1
    assert pairs[-1].stamp_ns == 99 * 10 * MS


def test_one_stamp_far_in_the_future_does_not_silence_a_foot_for_good():
    aligner, pairs = Aligner(AlignerConfig()), []
    for k in range(200):
        pairs += aligner.push("left", k * 10 * MS, SAMPLE)
        pairs += aligner.push("right", 10**18 if k == 50 else k * 10 * MS, SAMPLE)
    assert pairs[-1].stamp_ns == 1990 * MS
    assert len(both_there(pairs)) == 200 - 1 - 20
    assert len(pairs) == 200
    assert aligner.counters["right_out_of_order"] == 20
    assert aligner.counters["restarts"] == 0


JUMPS_S = [-3600, -2, -1, 1, 5, 30 * 86400, 10 * 365 * 86400]


@pytest.mark.parametrize("jump", JUMPS_S)
@pytest.mark.parametrize("rate", [0.0, 100.0])
@pytest.mark.parametrize("reference", ["left", "right"])
def test_clocks_that_are_set_together_cost_less_than_half_a_second(jump, rate, reference):
    aligner = Aligner(AlignerConfig(rate=rate, reference=reference))
    start = 10**18
    push_both(aligner, range(start, start + 3000 * MS, 10 * MS))
    after = start + 3000 * MS + jump * 10**9
    stamps = range(after, after + 3000 * MS, 10 * MS)
    pairs = both_there(push_both(aligner, stamps))
    assert len([t for t in pairs if t >= after]) > 260
    assert pairs[-1] == stamps[-1]


@pytest.mark.parametrize("jump", JUMPS_S)
@pytest.mark.parametrize("foot", ["left", "right"])
@pytest.mark.parametrize("bunch", [1, 5, 10])
def test_a_clock_of_one_foot_that_is_set_is_learnt_again_and_counted(jump, foot, bunch):
    aligner, pairs, start = Aligner(), [], 10**18
    for k in range(0, 1000, bunch):
        for each, apart in (("left", 0), ("right", 3 * MS)):
            for i in range(k, k + bunch):
                set_by = jump * 10**9 if each == foot and k >= 500 else 0
                stamp = start + i * 10 * MS + apart + set_by
                pairs += aligner.push(each, stamp, SAMPLE)
    assert aligner.counters[f"{foot}_clock_set"] == 1
    stamps = [t - start for t in both_there(pairs)]
    assert np.diff(stamps).max() < 1000 * MS
    assert abs(stamps[-1] - 9990 * MS) < 200 * MS
    assert np.ptp([p.stamp_ns for p in pairs]) < 11_000 * MS


def test_a_foot_that_sends_what_it_had_held_back_has_no_clock_set():
    aligner, pairs, waiting = Aligner(), [], []
    for k in range(1000):
        pairs += aligner.push("left", k * 10 * MS, SAMPLE)
        waiting.append(k * 10 * MS)
        for _ in range(0 if 300 <= k < 500 else 2):  # it catches up at twice its rate
            if waiting:
                pairs += aligner.push("right", waiting.pop(0), SAMPLE)
    assert aligner.counters["right_clock_set"] == 0
    assert both_there(pairs)[-1] == 9990 * MS


@pytest.mark.parametrize("block", [50, 100, 150])
def test_a_replay_that_comes_in_blocks_has_no_clock_set(block):
    aligner = Aligner()
    for k in range(0, 1800, block):
        for foot in ("right", "left"):
            for i in range(k, k + block):
                if foot == "left" or not 600 <= i < 900:
                    aligner.push(foot, i * 10 * MS, SAMPLE)
    assert aligner.counters["left_clock_set"] == aligner.counters["right_clock_set"] == 0


@pytest.mark.parametrize("jump", [0, -3600, -2, 1, 3600])
@pytest.mark.parametrize("queued", [0, 100])
def test_times_of_arrival_tell_a_clock_that_is_set_from_a_queue_that_is_worked_off(jump, queued):
    """After a silence of the right foot the left one has samples queued."""
    aligner, left = Aligner(), []
    for k in range(2000):
        now = 10**18 + k * 10 * MS
        left.append(now)
        if not 500 <= k < 500 + queued:
            for at in left[: 1 if k < 900 else 2]:
                aligner.push("left", at, SAMPLE, at + 2 * MS)
            del left[: 1 if k < 900 else 2]
        if not 400 <= k < 700:
            set_by = jump * 10**9 if k >= 1200 else 0
            aligner.push("right", now + set_by, SAMPLE, now + 3 * MS)
    assert aligner.counters["left_clock_set"] == 0
    assert aligner.counters["right_clock_set"] == (jump != 0)


def test_a_hole_of_hours_on_a_uniform_grid_is_jumped_at_once():
    aligner = Aligner(AlignerConfig(rate=200.0))
    hours = 10 * 3600 * 10**9
    for start in (0, hours):
        pairs = push_both(aligner, range(start, start + 500 * MS, 5 * MS))
    assert pairs[-1].stamp_ns == hours + 99 * 5 * MS
    assert aligner.counters["in_gap"] == 36000 * 200 - 100
