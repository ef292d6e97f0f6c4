"""The promise of the trust on simulated walks; ``benchmark/trust.py`` does many."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, TrackerConfig
from dualfoot_ros.evaluation.metrics.position_trust import trust_report, trust_series
from dualfoot_ros.simulation import WalkConfig, grade, simulate

SEEDS = range(12)
LIMIT_M = 1.0


def walked(seed: int):
    """Return trajectory and horizontal error (N,) m of the person, from where it started."""
    made = simulate(WalkConfig(route="L", rate=60.0, standing=6.0), grade("consumer"), seed=seed)
    found = DualFootTracker(TrackerConfig()).run(made.left, made.right)
    stamps = found.left.stamp_ns
    true = 0.5 * sum(
        np.column_stack([np.interp(stamps, t.stamp_ns, t.position[:, i]) for i in range(2)])
        for t in (made.left_truth, made.right_truth)
    )
    estimate = 0.5 * (found.left.position + found.right.position)[:, :2]
    return found, np.linalg.norm(estimate - estimate[0] - true + true[0], axis=1)


@pytest.fixture(scope="module")
def walks():
    return [walked(seed) for seed in SEEDS]


def test_the_error_is_within_the_radius(walks):
    inside = []
    for found, error in walks:
        epochs, trusts = trust_series(found, LIMIT_M)
        inside.append(error[epochs[-1]] <= trusts[-1].radius_m)
    assert np.mean(inside) > 0.9


def test_where_the_limit_is_foretold_the_error_is_within_it(walks):
    kept = []
    for found, error in walks:
        epochs, trusts = trust_series(found, LIMIT_M)
        at = len(trusts) // 3
        end_s = trusts[at].time_left_s + (trusts[at].stamp_ns - trusts[0].stamp_ns) * 1e-9
        assert math.isfinite(end_s)
        last = min(round(end_s), len(epochs) - 1)
        kept.append(error[epochs[at] : epochs[last]].max() <= LIMIT_M)
    assert np.mean(kept) > 0.9


def test_a_report_tells_when_the_limit_was_passed(walks):
    found, _ = walks[0]
    tight, wide = trust_report(found, 0.2), trust_report(found, 100.0)
    assert 0.0 < tight.trusted_way_m < 40.0 and tight.trusted_s > 0.0
    assert tight.way_left_m == 0.0
    assert wide.trusted_way_m is None and wide.way_left_m > 100.0
    assert tight.radius_m == wide.radius_m
