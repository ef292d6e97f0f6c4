"""A given pose replaces what the filter held of the person's pose, and nothing else."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dualfoot_ros.core import ConfigError, DualFootTracker, TrackerConfig

from ..harness import quick_engine, walk

GIVEN = np.diag([4.0, 1.0, 0.25, 0.01])


def tracked(seconds: float, **pose):
    """Return the last update of a walk in which a pose was given after 20 s."""
    tracker = DualFootTracker(TrackerConfig(method="idc"), engine=quick_engine().name)
    pairs = walk(seconds, route="straight", rate=60.0)
    for k, pair in enumerate(pairs):
        if k == round(pose.get("at_s", 20.0) * 60) and "covariance" in pose:
            tracker.set_pose([1.0, 2.0, 3.0], 0.5, pose["covariance"])
        update = tracker.add(pair)
    return update


def test_the_persons_covariance_is_that_of_the_given_pose():
    known = tracked(20.05, covariance=GIVEN).pedestrian().pose_covariance
    assert np.allclose(np.diag(known)[:3], [4.0, 1.0, 0.25], atol=0.02)
    assert known[5, 5] == pytest.approx(0.01, rel=0.05)


def test_what_is_known_of_the_feet_against_each_other_stays():
    given, plain = tracked(20.05, covariance=GIVEN), tracked(20.05)

    def apart(update):
        feet = update.left.pose_covariance() + update.right.pose_covariance()
        return (2.0 * feet - 4.0 * update.pedestrian().pose_covariance)[2, 2]

    assert apart(given) == pytest.approx(apart(plain), rel=0.05)


def test_a_given_heading_error_moves_the_person_sideways_as_the_walk_goes_on():
    covariance = np.diag([1e-6, 1e-6, 1e-6, 0.01])
    before = tracked(20.05, covariance=covariance)
    after = tracked(30.0, covariance=covariance)
    way = np.linalg.norm(after.pedestrian().position - before.pedestrian().position)
    sideways = math.sqrt(np.linalg.eigvalsh(after.pedestrian().pose_covariance[:2, :2])[-1])
    assert sideways == pytest.approx(0.1 * way, rel=0.2)


def test_before_the_first_step_the_given_covariance_comes_on_top_and_outlives_the_refining():
    known = tracked(3.9, covariance=GIVEN, at_s=2.5).pedestrian().pose_covariance
    assert np.all(np.diag(known)[:3] > [4.0, 1.0, 0.25])
    assert np.allclose(np.diag(known)[:3], [4.0, 1.0, 0.25], rtol=0.01)
    walked = tracked(14.0, covariance=GIVEN, at_s=2.5).pedestrian().pose_covariance
    assert walked[5, 5] > 0.01


def test_every_eigenvalue_stays_positive():
    update = tracked(25.0, covariance=np.zeros((4, 4)))
    assert np.linalg.eigvalsh(update.pedestrian().pose_covariance)[0] > -1e-12


@pytest.mark.parametrize(
    "bad", [np.eye(3), np.full((4, 4), np.nan), -np.eye(4), np.triu(np.ones((4, 4)))]
)
def test_what_is_no_covariance_is_refused(bad):
    with pytest.raises(ConfigError, match="covariance"):
        DualFootTracker().set_pose([0.0, 0.0, 0.0], 0.0, bad)
