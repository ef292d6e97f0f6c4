"""Samples that are lost at random cost a track little."""

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.evaluation import evaluate, track, truth_of
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import simulate

STAND = 800  # samples at the start, 8 s


def error_m(walk, lost, seed):
    feet = []
    for k, series in enumerate((walk.left, walk.right)):
        keep = np.random.default_rng([seed, k]).random(len(series)) >= lost
        keep[:STAND] = True
        feet.append(series[keep])
    recording = Recording(*feet, walk.left_truth, walk.right_truth)
    found = evaluate(track(recording, TrackerConfig()), truth=truth_of(recording))
    return found.truth_report.midpoint.rmse_m


@pytest.fixture(scope="module")
def cost():
    """Return by which factor 5 % of lost samples of each foot enlarge the median error."""
    walks = [simulate(seed=seed) for seed in range(8)]
    errors = [[error_m(walk, lost, k) for lost in (0.0, 0.05)] for k, walk in enumerate(walks)]
    whole, lossy = np.median(errors, axis=0)
    return lossy / whole


def test_five_percent_of_lost_samples_make_the_error_at_most_half_as_large_again(cost):
    assert cost <= 1.5
