"""Stamps evened out: jitter, bursts and stalls go, samples that were lost leave their gap."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import TimingError
from dualfoot_ros.timing import even_stamps

START = 1_735_725_600_000_000_000


def true_times(rate, count, skew_ppm=0.0):
    """Return (N,) ns of a device that samples at ``rate`` by a clock with a skew."""
    return START + np.rint(np.arange(count) / rate * 1e9 * (1 - 1e-6 * skew_ppm)).astype(np.int64)


def errors_ms(found, truth):
    """Return the deviation from the truth beside a constant delay, ms."""
    off = (found - truth) * 1e-6
    return np.abs(off - np.median(off))


@settings(max_examples=15)
@given(st.integers(0, 10**6), st.sampled_from([60.0, 100.0, 200.0]), st.floats(0.0, 0.006))
def test_delays_of_some_milliseconds_go_and_the_rate_is_that_of_the_device(seed, rate, scale_s):
    truth = true_times(rate, 1200, skew_ppm=80.0)
    late = np.random.default_rng(seed).exponential(scale_s * 1e9, len(truth)).astype(np.int64)
    even = even_stamps("left", truth + late)
    assert even.missing == 0
    assert np.allclose(np.diff(even.stamp_ns), even.interval_ns, atol=1.0)
    assert even.interval_ns * rate == pytest.approx(1e9, rel=2e-4)
    assert errors_ms(even.stamp_ns, truth).max() < 1.5


@pytest.mark.parametrize("size", [2, 4, 10])
def test_bursts_with_one_stamp_are_spread_over_their_time(size):
    truth = true_times(60.0, 1403)
    last = (np.arange(len(truth)) // size + 1) * size - 1
    even = even_stamps("left", truth[np.minimum(last, len(truth) - 1)])
    assert even.missing == 0
    assert errors_ms(even.stamp_ns, truth).max() < 1.0


def test_a_stall_that_catches_up_is_no_loss():
    truth = true_times(100.0, 2000)
    times = truth.copy()
    times[700:740] = truth[739]
    even = even_stamps("left", times)
    assert even.missing == 0
    assert errors_ms(even.stamp_ns, truth).max() < 0.5


@pytest.mark.parametrize("lost", [1, 3, 50])
def test_samples_that_were_lost_leave_their_gap(lost):
    truth = np.delete(true_times(100.0, 3000), slice(1200, 1200 + lost))
    late = np.random.default_rng(1).exponential(2e6, len(truth)).astype(np.int64)
    even = even_stamps("left", truth + late)
    assert even.missing == lost
    assert errors_ms(even.stamp_ns, truth).max() < 1.0


def test_a_recording_too_short_for_a_clock_is_still_even():
    truth = true_times(60.0, 120)
    late = np.random.default_rng(2).exponential(3e6, len(truth)).astype(np.int64)
    even = even_stamps("left", truth + late)
    assert errors_ms(even.stamp_ns, truth).max() < 3.0
    assert np.diff(even.stamp_ns).std() < 2.0


@pytest.mark.parametrize(
    "times", [np.empty(0, dtype=np.int64), np.full(100, START), START + np.arange(5)]
)
def test_times_that_tell_nothing_are_refused(times):
    with pytest.raises(TimingError, match="the left foot has"):
        even_stamps("left", times)
