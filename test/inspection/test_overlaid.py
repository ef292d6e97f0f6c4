"""Samples of two times between each other are found, and nothing else is taken for them."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.inspection.overlaid import find_overlaid
from dualfoot_ros.simulation import WalkConfig, simulate

RATE_HZ = 60.0
AT_S = 20.0


@pytest.fixture(scope="module")
def walked():
    return simulate(WalkConfig(route="L", rate=RATE_HZ, standing=4.0), seed=3).left


def sorted_by_the_clock(series, by_s):
    """Return the samples in the order of a clock that was set back, with its stamps."""
    stamps = series.stamp_ns.copy()
    stamps[round(AT_S * RATE_HZ) :] -= round(by_s * 1e9)
    order = np.argsort(stamps, kind="stable")
    return replace(series[order], stamp_ns=stamps[order])


@pytest.mark.parametrize("by_s", [0.307, 1.0, 1.0071, 5.0127])
def test_the_time_that_is_there_twice_is_found(walked, by_s):
    found = find_overlaid(sorted_by_the_clock(walked, by_s))
    assert found.start_s == pytest.approx(AT_S - by_s, abs=2 / RATE_HZ)
    assert found.duration_s == pytest.approx(by_s, abs=2 / RATE_HZ)


def test_it_may_be_the_most_of_a_recording(walked):
    assert find_overlaid(sorted_by_the_clock(walked, 20.507)).duration_s > 15.0


def arriving(series):
    """Return stamps as of arrivals, some of them soon after each other."""
    late = np.random.default_rng(1).exponential(8e6, len(series)).astype(np.int64)
    return replace(series, stamp_ns=np.maximum.accumulate(series.stamp_ns + late))


def faster(series):
    """Return a walk whose second half comes at twice the rate."""
    middle = len(series) // 2
    return series[np.concatenate([np.arange(0, middle, 2), np.arange(middle, len(series))])]


OTHERS = {
    "as it is": lambda walk: walk,
    "sorted and a minute apart": lambda walk: sorted_by_the_clock(walk, 60.0),
    "arrivals": arriving,
    "at twice the rate": faster,
    "lossy": lambda walk: walk[np.random.default_rng(1).random(len(walk)) > 0.2],
    "standing": lambda walk: sorted_by_the_clock(walk[: round(4.0 * RATE_HZ)], 1.0071),
    "few": lambda walk: walk[:10],
}


@pytest.mark.parametrize("change", OTHERS.values(), ids=OTHERS.keys())
def test_nothing_else_is_taken_for_it(walked, change):
    assert find_overlaid(change(walked)) is None
