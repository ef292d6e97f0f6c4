"""Quantiles have the bits of numpy's."""

import numpy as np
import pytest

from dualfoot_ros.core import median, quantile


@pytest.mark.parametrize("count", [*range(1, 10), 1000])
def test_a_quantile_is_that_of_numpy_to_the_bit(count):
    values = np.random.default_rng(count).exponential(size=(50, count))
    for share in (0.0, 0.25, 0.5, 0.7, 0.95, 0.98, 1.0):
        assert [quantile(v, share) for v in values] == [np.quantile(v, share) for v in values]


@pytest.mark.parametrize("count", [*range(1, 10), 1000])
def test_a_median_is_that_of_numpy_to_the_bit(count):
    values = np.random.default_rng(count).normal(size=(50, count))
    assert [median(v) for v in values] == [np.median(v) for v in values]
    values[:, count // 3] = np.nan
    assert np.isnan([median(v) for v in values]).all()
