"""An update is a value: what it says of an epoch does not change with the pairs that follow."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, TrackerConfig

from ..harness import quick_engine, walk


@pytest.mark.parametrize("method", ["zupt", "spacing_vector"])
def test_covariances_asked_for_late_are_those_of_their_own_epoch(method):
    tracker = DualFootTracker(
        TrackerConfig.from_mapping({"method": method}), engine=quick_engine().name
    )
    kept, at_once = [], []
    for pair in walk(14.0):
        update = tracker.add(pair)
        if update.row is not None:
            kept.append(update)
            at_once.append(answers(update))
    for update, first in zip(kept, at_once, strict=True):
        for late, early in zip(answers(update), first, strict=True):
            assert late.tobytes() == early.tobytes()
    grown = [first[0][0, 0] for first in at_once]
    assert max(grown) > 1.5 * min(grown)  # or the test would show nothing


def test_what_a_covariance_is_asked_for_twice_is_the_askers_to_change():
    tracker = DualFootTracker(engine=quick_engine().name)
    update = [tracker.add(pair) for pair in walk(6.0)][-1]
    update.left.pose_covariance()[:] = 0.0
    assert np.linalg.eigvalsh(update.left.pose_covariance())[-1] > 0.0


def answers(update) -> list[np.ndarray]:
    """Return every covariance that an update gives."""
    person = update.pedestrian()
    return [
        update.left.pose_covariance(),
        update.right.pose_covariance(),
        person.pose_covariance,
        person.velocity_covariance,
    ]
