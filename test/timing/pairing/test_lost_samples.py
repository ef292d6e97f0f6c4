"""Lost samples: on a curve through those around them, live one sample later than the line."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.timing import Aligner, AlignerConfig, align, align_with_report
from dualfoot_ros.timing.pairing.lost_samples import cubic

MS = 1_000_000
STEP = 10 * MS
STAND = 40  # samples that are always there, so that the spacing is known
numbers = st.floats(-5.0, 5.0)


@given(
    st.tuples(numbers, numbers, numbers, numbers),
    st.lists(st.integers(1, 40), min_size=3, max_size=3),
)
def test_a_cubic_is_found_again_whatever_the_stamps(coefficients, steps):
    stamps = np.cumsum([0, *steps]) - steps[0] - 0.4 * steps[1]
    values = [[float(np.polyval(coefficients, t / 40.0))] for t in stamps]
    (found,) = cubic(stamps.tolist(), values)
    assert found == pytest.approx(coefficients[-1], abs=1e-9)


def swinging(count=2000, seed=0):
    """Return a foot that swings at 1 Hz and its overtones, at 100 Hz."""
    stamps = 10**9 + STEP * np.arange(count)
    rng = np.random.default_rng(seed)
    phase = 2.0 * np.pi * (stamps * 1e-9)[:, None]
    parts = [np.sin(n * phase + rng.uniform(0.0, 6.0, 6)) / n for n in (1, 2, 3, 4, 5)]
    values = 5.0 * np.sum(parts, axis=0)
    return ImuSeries(stamps, values[:, :3], values[:, 3:])


def losing(series, share, seed):
    """Return the series without a share of its samples, and which were kept."""
    keep = np.random.default_rng(seed).random(len(series)) >= share
    keep[:STAND] = True
    return series[keep], keep


def fed(aligner, left, right):
    """Yield how many samples of both feet were pushed, and the pairs that came of them."""
    feet = {"left": left, "right": right}
    order = sorted((int(s.stamp_ns[k]), f, k) for f, s in feet.items() for k in range(len(s)))
    for count, (stamp, foot, k) in enumerate(order, 1):
        series = feet[foot]
        sample = np.concatenate([series.specific_force[k], series.angular_rate[k]])
        yield count, stamp, aligner.push(foot, stamp, sample)


def test_lost_samples_are_much_nearer_to_the_truth_than_the_line_is():
    whole = swinging()
    lossy, keep = losing(whole, 0.05, 1)
    made, _ = align(lossy, whole)
    lost = np.flatnonzero(~keep[: len(made)])
    line = np.column_stack(
        [np.interp(whole.stamp_ns[lost], lossy.stamp_ns, r) for r in lossy.angular_rate.T]
    )
    cubic_error = np.sqrt(np.mean((made.angular_rate[lost] - whole.angular_rate[lost]) ** 2))
    line_error = np.sqrt(np.mean((line - whole.angular_rate[lost]) ** 2))
    assert cubic_error < 0.2 * line_error


@pytest.mark.parametrize("rate", [0.0, 100.0, 83.0])
@pytest.mark.parametrize("reference", ["left", "right"])
def test_live_gives_the_pairs_of_the_batch_to_the_bit(rate, reference):
    feet = []
    for k in range(2):
        foot, _ = losing(swinging(seed=k), 0.15, k)
        since_s = (foot.stamp_ns - foot.stamp_ns[0]) * 1e-9
        silent = (since_s > 7.03 + 3.0 * k) & (since_s < 9.5 + 3.0 * k)
        foot = foot[~silent]
        feet.append(ImuSeries(foot.stamp_ns + 3 * MS * k, foot.specific_force, foot.angular_rate))
    config = AlignerConfig(rate=rate, reference=reference)
    aligner = Aligner(config)
    pairs = [pair for *_, found in fed(aligner, *feet) for pair in found] + aligner.finish()
    left, right, report = align_with_report(*feet, config)
    assert [p.stamp_ns for p in pairs] == left.stamp_ns.tolist()
    values = np.array([p.values for p in pairs])
    assert np.array_equal(values, stack_pairs(left, right), equal_nan=True)
    for name in ("interpolated", "left_missing", "right_missing", "pairs"):
        assert aligner.counters[name] == report.counters[name]


def test_a_pair_of_a_lost_sample_waits_for_the_second_sample_after_it_and_no_other_pair_does():
    whole = swinging(200)
    gone = whole[np.arange(200) != 100]
    waits = {}
    for _, now, found in fed(Aligner(), gone, whole):
        waits.update({pair.stamp_ns: (now - pair.stamp_ns) // STEP for pair in found})
    hole = int(whole.stamp_ns[100])
    assert waits[hole] == 2
    assert waits[hole + STEP] == 1
    assert {wait for stamp, wait in waits.items() if stamp not in (hole, hole + STEP)} == {0}


@pytest.mark.parametrize("after", [0, 1])
def test_a_foot_that_falls_silent_right_after_a_lost_sample_has_the_line_there(after):
    """At its end and before a long hole there is no second sample to wait for."""
    whole = swinging(400)
    gone = whole[[k for k in range(400) if k != 100 and (k < 102 or k >= 300 + 100 * after)]]
    left, _ = align(gone, whole)
    neighbours = whole.angular_rate[[99, 101]]
    assert np.allclose(left.angular_rate[100], neighbours.mean(axis=0), atol=0.3)
    aligner = Aligner()
    pairs = [pair for *_, found in fed(aligner, gone, whole) for pair in found] + aligner.finish()
    assert pairs[100].values[3:6].tolist() == left.angular_rate[100].tolist()


@pytest.mark.parametrize(("lost", "line"), [(3, False), (4, True)])
def test_a_hole_of_more_than_40_ms_is_left_to_the_line(lost, line):
    whole = swinging(200)
    whole.angular_rate[:] = [1.0, 0.0, 0.0] * np.sin(np.arange(200) / 3.0)[:, None]
    whole.specific_force[:] = 0.0
    gone = whole[[k for k in range(200) if not 100 <= k < 100 + lost]]
    left, _ = align(gone, whole)
    ends = whole.angular_rate[[99, 100 + lost], 0]
    straight = np.interp(100.0, [99.0, 100.0 + lost], ends)
    assert (abs(left.angular_rate[100, 0] - straight) < 1e-12) == line


def arriving(series, seed):
    """Return the series with stamps as of arrivals up to 12 ms late, many soon after another."""
    late = np.random.default_rng(seed).uniform(0.0, 12e6, len(series)).astype(np.int64)
    late[:STAND] = 0
    stamps = np.maximum.accumulate(series.stamp_ns + late) + np.arange(len(series))
    return ImuSeries(stamps, series.specific_force, series.angular_rate)


def test_a_neighbour_that_is_too_near_to_the_next_one_guides_no_cubic():
    """The cubic overshot to 10^6 times the values, which were used as samples."""
    whole = swinging()
    feet = [arriving(whole, seed) for seed in range(2)]
    left, right = align(*feet)
    assert len(left) > 1.05 * len(whole)  # long intervals are taken for holes
    for series in (left, right):
        assert np.abs(series.angular_rate).max() < 1.5 * np.abs(whole.angular_rate).max()
    aligner = Aligner()
    pairs = [pair for *_, found in fed(aligner, *feet) for pair in found] + aligner.finish()
    values = np.array([pair.values for pair in pairs])
    assert np.array_equal(values, stack_pairs(left, right), equal_nan=True)


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize(("nearer_ms", "line"), [(4, False), (6, True)])
def test_so_it_is_from_half_an_interval_on(side, nearer_ms, line):
    whole = swinging(200)
    gone = whole[np.arange(200) != 100]
    second = 98 if side < 0 else 101  # beside the edge of the hole
    gone.stamp_ns[second] -= side * nearer_ms * MS
    gone.angular_rate[second] += 20.0
    left, _ = align(gone, whole)
    straight = gone.angular_rate[[99, 100]].mean(axis=0)
    lost = np.searchsorted(left.stamp_ns, whole.stamp_ns[100])
    assert np.allclose(left.angular_rate[lost], straight, atol=0.3) == line


def test_what_is_held_is_held_in_a_hole_too():
    whole = swinging(200)
    gone = whole[np.arange(200) != 100]
    left, _ = align(gone, whole, AlignerConfig(between="hold"))
    assert np.array_equal(left.angular_rate[100], whole.angular_rate[99])


def test_the_magnetic_field_of_a_lost_sample_is_on_the_line():
    whole = swinging(200)
    field = np.outer(np.arange(200.0) ** 2, [1e-9, 0.0, -1e-9])
    whole = ImuSeries(whole.stamp_ns, whole.specific_force, whole.angular_rate, field)
    left, _ = align(whole[np.arange(200) != 100], whole)
    assert left.magnetic_field[100] == pytest.approx(field[[99, 101]].mean(axis=0), abs=1e-15)
