"""A stop teaches the detector nothing: the stances after it are found as those before it."""

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.results.trajectory import stance_bounds
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import WalkConfig, simulate


@pytest.mark.parametrize("stop_s", [1.5, 4.0, 12.0])
def test_no_stance_is_missed_after_a_stop(stop_s):
    config = WalkConfig(route="rectangle", rate=60.0, stops=3, stop_duration=stop_s)
    made = simulate(config, seed=2)
    run = track(Recording(made.left, made.right), TrackerConfig(method="zupt"))
    for foot in (run.left, run.right):
        begins = stance_bounds(foot.stance)[:, 0]
        strides = np.linalg.norm(np.diff(foot.position[begins, :2], axis=0), axis=1)
        assert strides.max() < 1.5 * np.median(strides)
