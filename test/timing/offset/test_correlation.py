"""Correlation near a lag is the whole correlation there, also where the signals hardly overlap."""

import numpy as np
import pytest

from dualfoot_ros.timing.offset.correlation import Signal, correlate, correlate_near

WITHIN_S = 0.4


def signal(seed, count, start_s):
    values = np.abs(np.random.default_rng(seed).standard_normal(count))
    return Signal(round(start_s * 1e9), values)


@pytest.mark.parametrize("counts", [(300, 500), (500, 300), (300, 40)])
@pytest.mark.parametrize("lag_s", [-1.9, 0.0, 0.35, 1.4, 2.4])
def test_near_a_lag_it_is_that_at_every_lag(counts, lag_s):
    one, two = signal(1, counts[0], 7.0), signal(2, counts[1], 7.35)
    whole, near = correlate(one, two), correlate_near(one, two, lag_s, WITHIN_S)
    wanted = np.abs(whole.lag_s - lag_s) <= WITHIN_S
    there = np.searchsorted(near.lag_s, whole.lag_s[wanted] - 1e-6)
    assert np.allclose(near.lag_s[there], whole.lag_s[wanted], rtol=0, atol=1e-12)
    assert np.allclose(near.value[there], whole.value[wanted], rtol=0, atol=1e-12)
    assert near.maximum_near(lag_s, WITHIN_S) == pytest.approx(whole.maximum_near(lag_s, WITHIN_S))


def test_beyond_all_lags_there_is_none():
    one, two = signal(1, 300, 7.0), signal(2, 500, 7.35)
    near = correlate_near(one, two, 99.0, WITHIN_S)
    assert len(near.value) == 0
    assert near.maximum_near(99.0, WITHIN_S) is None
