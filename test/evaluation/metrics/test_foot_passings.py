"""Crossings and the distance between the feet."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import swing_passings
from dualfoot_ros.evaluation.metrics.foot_passings import feet_report

from ..walks import SPACING, foot, straight


def test_the_distance_error_is_estimate_minus_truth_at_the_constraints():
    left, right, stance = straight()
    feet = foot(left, stance[0]), foot(right, stance[1])
    feet[0].position[:, 1] += 0.05
    moments = swing_passings(left.position, right.position, *stance).index[1:8]
    report = feet_report(*feet, moments, (left.position, right.position))
    assert report.moments == "constraint"
    assert report.distance_error_m.count == 7
    assert report.distance_error_m.mean == pytest.approx(0.05, abs=1e-3)
    assert report.distance_m.mean == pytest.approx(SPACING + 0.05, abs=1e-3)
    assert report.truth_crossed_percent == 0.0


def test_without_constraints_the_distance_is_taken_where_the_feet_pass():
    left, right, stance = straight(strides=5)
    empty = np.empty(0, dtype=np.int64)
    report = feet_report(foot(left, stance[0]), foot(right, stance[1]), empty)
    assert report.moments == "passing"
    assert report.distance_m.count == report.passings == 11
    assert report.distance_error_m is None


def test_a_foot_without_samples_passes_nobody():
    left, right, stance = straight(strides=5)
    gone = replace(foot(right, stance[1]), present=np.zeros(len(right.stamp_ns), dtype=bool))
    empty = np.empty(0, dtype=np.int64)
    report = feet_report(foot(left, stance[0]), gone, empty, (left.position, right.position))
    assert report.distance_m.count == report.passings == report.crossed == 0
    assert report.crossed_percent is report.truth_crossed_percent is None
