"""A floor that was none is taken back when the feet do not land as on it.

Stamps that are an interval early for a while after each lost sample, as those that are evened out
are, make some landings fast; two that were alike by chance were a walkway to the end of the walk.
"""

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig

from ..harness import Pairs, quick_engine, walk

LOST, EARLY = 0.02, 25  # share of the samples, and samples with early stamps behind each


def with_early_stamps(whole, seed):
    """Return the pairs without some samples, whose absence the stamps show too late."""
    count = len(whole.stamps)
    lost = np.flatnonzero(np.random.default_rng(seed).random(count) < LOST)
    lost = lost[(lost > 300) & (lost < count - 60)]
    early = np.zeros(count, dtype=np.int64)
    for k in lost:
        early[k + 1 : k + 1 + EARLY] += 1
    stamps = whole.stamps - early * int(np.median(np.diff(whole.stamps)))
    kept = np.setdiff1d(np.arange(count), lost)
    kept = kept[np.diff(np.maximum.accumulate(stamps[kept]), prepend=0) > 0]
    return Pairs(stamps[kept], whole.values[kept])


@pytest.mark.parametrize("seed", [1, 13, 21])
def test_a_walkway_on_which_the_feet_land_as_on_none_is_over_within_six_steps(seed):
    pairs = with_early_stamps(walk(30.0, seed=seed), seed)
    result = DualFootTracker(TrackerConfig(), engine=quick_engine().name).run(*pairs.series())
    rides = [event for event in result.events if event.kind is EventKind.CARRIED]
    assert [ride.payload.over for ride in rides] == [False, True]
    began, over = (ride.detected_ns for ride in rides)
    assert over - began < 3.5e9
    k = int(np.searchsorted(result.left.stamp_ns, over))
    for foot in (result.left, result.right):
        before, after = (np.sqrt(foot.position_covariance[row, 0, 0]) for row in (k - 1, k + 1))
        assert after > before + 0.1  # by how far the floor has moved the feet is unknown
