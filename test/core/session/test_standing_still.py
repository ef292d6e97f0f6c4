"""Standing still: the track stays put, and its covariance tells no fairy tale."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, TrackerConfig
from dualfoot_ros.core.results.row_store import RowStore
from dualfoot_ros.core.samples.pair_series import PairSeries

from ..harness import Pairs, open_session, quick_engine, simulated, walk


def standing(seed: int, seconds: float) -> Pairs:
    return walk(route="standing", standing=seconds, final_standing=0.5, rate=100.0, seed=seed)


def stood(seed, seconds):
    """Return the session of a stand, and both tracks from the first tracked sample on."""
    pairs = standing(seed, seconds)
    session, start = open_session(TrackerConfig(), pairs)
    rows = RowStore(len(pairs))
    for _ in session.steps(PairSeries.of(*pairs.series()), (start, len(pairs)), rows):
        pass
    return session, [nominal[start:] for nominal in rows.arrays[:2]]


@pytest.mark.parametrize("seed", range(3))
def test_standing_still_drifts_less_than_a_centimetre_in_a_minute(seed):
    """Without the refinement that a tracker does while it stands: the filter alone must hold."""
    _, tracks = stood(seed, 64.0)
    for track in tracks:
        assert np.linalg.norm(track[:, :3] - track[0, :3], axis=1).max() < 0.01


@pytest.mark.parametrize("method", ("zupt", "idc"))
@pytest.mark.parametrize("seed", range(3))
def test_standing_for_a_minute_after_a_walk_moves_the_track_by_less_than_a_centimetre(
    method, seed
):
    pairs = walk(route="straight", final_standing=63.0, rate=100.0, seed=seed)
    tracker = DualFootTracker(TrackerConfig(method=method), engine=quick_engine().name)
    result = tracker.run(*pairs.series())
    for foot in (result.left, result.right):
        track = foot.position[-6000:]
        assert np.linalg.norm(track - track[0], axis=1).max() < 0.01


def test_the_covariance_of_a_standing_foot_covers_its_drift():
    """Over many stands, squared drift against its variance: not more than chi-square allows."""
    nees = []
    for seed in range(12):
        session, tracks = stood(seed, 34.0)
        for foot in range(2):
            drift = session._walk.estimate.position(foot) - tracks[foot][0, :3]
            P = session.space.covariance()[15 * foot : 15 * foot + 3, 15 * foot : 15 * foot + 3]
            nees.append(float(drift @ np.linalg.solve(P, drift)))
    assert np.mean(nees) < 3.0 * 1.7  # chi-square of 72 degrees of freedom, one in 10^5


def test_a_tracker_that_stands_keeps_refining_and_says_so():
    pairs = standing(1, 8.0)
    tracker = DualFootTracker(engine=quick_engine().name)
    phases = [tracker.add(pair).phase for pair in pairs]
    assert phases[-1] == "standing"
    assert tracker.counters["alignment_restarts"] == 0


def test_the_bias_found_while_standing_is_the_sensors_own():
    made = simulated(route="standing", standing=20.0, final_standing=0.5, rate=100.0, seed=1)
    session, _ = open_session(TrackerConfig(), standing(1, 20.0), seconds=20.0)
    for still, series in zip(session._start.feet, (made.left, made.right), strict=True):
        assert np.abs(still.angular_rate - series.angular_rate.mean(axis=0)).max() < 1e-3
