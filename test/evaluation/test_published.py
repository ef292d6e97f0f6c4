"""What was published live, put together afterwards, is what an offline run gives."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, FootTrajectory, ImuPair, TrackerConfig
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.evaluation import EvaluationError, evaluate, published_trajectory
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import align


@pytest.fixture(scope="module")
def made():
    """Return a simulated straight walk."""
    return simulate(WalkConfig(route="straight"), seed=6)


@pytest.fixture(scope="module")
def pairs(made):
    """Return the samples of its first half minute on one grid."""
    return align(made.left[:3000], made.right[:3000])


@pytest.fixture(scope="module")
def heard(pairs):
    """Return a function that gives what is published of them with a method."""
    return cache(lambda method: live(pairs, TrackerConfig.from_mapping({"method": method})))


def live(pairs, config):
    """Return both feet and the covariance between them as add() gave them, and the events."""
    tracker = DualFootTracker(config, engine="compiled")
    heard = {"left": [], "right": []}
    events, relative = [], []
    for stamp, values in zip(pairs[0].stamp_ns, stack_pairs(*pairs), strict=True):
        update = tracker.add(ImuPair(int(stamp), values))
        events += update.announced
        if update.left is not None:
            for foot, messages in heard.items():
                messages.append(message(update.stamp_ns, getattr(update, foot)))
            relative.append(between(update))
    return [rows(messages) for messages in heard.values()], np.array(relative), events


def between(update):
    """Return the covariance (3, 3) of left minus right position: the person is their mean."""
    feet = update.left.pose_covariance() + update.right.pose_covariance()
    return (2.0 * feet - 4.0 * update.pedestrian().pose_covariance)[:3, :3]


def message(stamp_ns, estimate):
    """Return the values of a published estimate; covariances hold only until the next pair."""
    pose = estimate.pose_covariance()
    motion = estimate.position, estimate.velocity, estimate.quaternion, estimate.stance
    return (
        stamp_ns,
        *motion,
        pose[:3, :3],
        estimate.twist_covariance(),
        pose[3:, 3:],
    )


def rows(messages) -> FootTrajectory:
    """Return one row a message, as a listener to the topic would collect them."""
    return FootTrajectory(*(np.array(column) for column in zip(*messages, strict=True)))


@pytest.mark.parametrize("method", ["zupt", "idc", "spacing_vector"])
def test_it_is_the_trajectory_of_an_offline_run_to_the_bit(pairs, heard, method):
    config = TrackerConfig.from_mapping({"method": method})
    feet, relative, events = heard(method)
    put_together = published_trajectory(*feet, events, method=method, relative_covariance=relative)
    offline = DualFootTracker(config, engine="compiled").run(*pairs)
    for foot in ("left", "right"):
        one, other = getattr(put_together, foot), getattr(offline, foot)
        np.testing.assert_array_equal(one.stamp_ns, other.stamp_ns)
        np.testing.assert_array_equal(one.stance, other.stance)
        for name in ("position", "velocity", "quaternion"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
        for name in ("position_covariance", "velocity_covariance", "attitude_covariance"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    np.testing.assert_allclose(
        put_together.relative_covariance, offline.relative_covariance, atol=1e-9
    )


def test_an_unknown_covariance_between_the_feet_leaves_its_nees_out(made, heard):
    feet, _, events = heard("zupt")
    found = published_trajectory(*feet, events, method="zupt")
    metrics = evaluate(found, truth=(made.left_truth, made.right_truth)).to_dict()
    assert metrics["truth"]["nees"]["relative_position"] is None
    assert metrics["truth"]["nees"]["left_position"] > 0


def test_feet_of_different_stamps_are_refused(heard):
    feet, _, events = heard("zupt")
    late = replace(feet[1], stamp_ns=feet[1].stamp_ns + 1)
    with pytest.raises(EvaluationError, match="different stamps"):
        published_trajectory(feet[0], late, events, method="zupt")
