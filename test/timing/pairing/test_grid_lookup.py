"""The samples around the stamps of a grid, where the grid is the stamps themselves."""

import numpy as np
import pytest

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.timing import AlignerConfig
from dualfoot_ros.timing.pairing.grid_lookup import GridLookup

CONFIG = AlignerConfig()
STAMPS = np.cumsum(np.random.default_rng(0).integers(4_000_000, 6_000_000, 50))
KEPT = np.ones(len(STAMPS), dtype=bool)


def samples(stamps):
    force, rate, field = np.random.default_rng(1).normal(size=(3, len(stamps), 3))
    return ImuSeries(stamps, force, rate, field)


def same_values(one, other):
    names = "specific_force", "angular_rate", "magnetic_field"
    return all(np.array_equal(getattr(one, n), getattr(other, n), equal_nan=True) for n in names)


@pytest.mark.parametrize("lost", [None, np.arange(len(STAMPS)) % 7 == 2])
def test_a_grid_of_the_own_stamps_is_looked_up_as_any_other(lost):
    quick = GridLookup.of(STAMPS, STAMPS, CONFIG, lost)
    searched = GridLookup._of_some(STAMPS, STAMPS, CONFIG, lost)
    for name in GridLookup.__annotations__:
        values = getattr(searched, name)
        assert np.array_equal(getattr(quick, name), values), name
        assert getattr(quick, name).dtype == values.dtype


def test_a_foot_with_a_sample_at_each_stamp_is_taken_without_a_copy():
    series = samples(STAMPS)
    near = STAMPS + 1000  # within the tolerance
    for grid in (STAMPS, near):
        found = GridLookup.of(STAMPS, grid, CONFIG).take(series, grid, KEPT)
        assert found.specific_force is series.specific_force
        assert found.angular_rate is series.angular_rate
        assert np.array_equal(found.stamp_ns, grid) and same_values(found, series)


@pytest.mark.parametrize("grid", [STAMPS[1:], np.append(STAMPS, STAMPS[-1] + 10**9)])
def test_a_foot_with_other_samples_is_taken_sample_by_sample(grid):
    kept = np.ones(len(grid), dtype=bool)
    found = GridLookup.of(STAMPS, grid, CONFIG).take(samples(STAMPS), grid, kept)
    there = np.isin(grid, STAMPS)
    assert same_values(found[there], samples(STAMPS)[np.isin(STAMPS, grid)])
    assert np.isnan(found.specific_force[~there]).all()


def test_of_two_samples_within_the_tolerance_of_a_stamp_each_stamp_has_its_own():
    """Some sample is taken twice then, so there is something to copy."""
    stamps = 400_000 * np.arange(50)
    grid, series = stamps + 500_000, samples(stamps)
    lookup = GridLookup.of(stamps, grid, AlignerConfig(tolerance=0.001))
    found = lookup.take(series, grid, KEPT)
    assert lookup.exact.all() and not np.array_equal(lookup.before, np.arange(50))
    assert np.array_equal(found.specific_force, series.specific_force[lookup.before])
