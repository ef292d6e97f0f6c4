"""What is said of the recent past does not depend on how it is worked out."""

import math

import numpy as np
import pytest

from dualfoot_ros.core.gait_history import UNEVEN_S, GaitHistory
from dualfoot_ros.core.kernel import Workspace
from dualfoot_ros.core.kernel.epoch import begin


@pytest.mark.parametrize("scatter", [0.0, 0.2, 0.5, 0.9, 1.0, 1.1, 2.0, 5.0])
@pytest.mark.parametrize("outliers", [0, 1, 9])
def test_stamps_are_uneven_by_the_rms_of_their_intervals_about_the_median(scatter, outliers):
    rng = np.random.default_rng(round(100 * scatter) + outliers)
    space = Workspace(100.0, 1.3)
    gait, count = GaitHistory(space), space.ring
    steps = 0.01 + scatter * UNEVEN_S * rng.normal(size=count)
    steps[:outliers] += 0.02
    for k, dt in enumerate(steps.tolist()):
        begin(space.w, space.n, space.stamps, k, dt)
    rms = math.sqrt(np.mean(np.square(steps - np.median(steps))))
    assert gait.uneven is (rms > UNEVEN_S)


def test_an_uneven_interval_counts_until_it_has_left_the_ring():
    space = Workspace(100.0, 1.3)
    gait, seen = GaitHistory(space), []
    for k in range(2 * space.ring + 2):
        begin(space.w, space.n, space.stamps, k, 0.06 if k == 20 else 0.01)
        seen.append(gait.uneven)
    assert seen.index(True) == 20 and seen[20:].index(False) == space.ring
