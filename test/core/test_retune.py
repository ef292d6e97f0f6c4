"""A tracker that goes on with other parameters."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import ConfigError, DualFootTracker, EventKind, TrackerConfig

from .harness import quick_engine, walk


def run(at_s: float, **values):
    """Track a walk, retuned after ``at_s``; return the last update and all events."""
    tracker = DualFootTracker(TrackerConfig(), engine=quick_engine().name)
    events = []
    for k, pair in enumerate(walk(20.0, route="straight", rate=60.0)):
        if k == round(at_s * 60):
            tracker.retune(TrackerConfig.from_mapping(values))
        update = tracker.add(pair)
        events += update.announced
    return update, events


def test_the_same_parameters_change_nothing_but_what_could_be_taken_back():
    update, _ = run(2.0)
    plain = DualFootTracker(TrackerConfig(), engine=quick_engine().name)
    last = [plain.add(pair) for pair in walk(20.0, route="straight", rate=60.0)][-1]
    assert np.array_equal(update.row, last.row)


def test_the_flat_floor_can_be_switched_on_in_mid_walk():
    _, events = run(12.0, **{"aids.flat_floor": True})
    aids = [event for event in events if event.kind is EventKind.AID]
    assert aids and min(event.detected_ns for event in aids) > 0
    assert not [e for e in run(12.0)[1] if e.kind is EventKind.AID]


def test_a_given_spacing_takes_the_place_of_the_learnt_one():
    _, events = run(12.0, **{"spacing_vector.spacing": 0.31})
    targets = [e.payload.limit.target for e in events if e.kind is EventKind.CONSTRAINT]
    assert targets[-1] == 0.31 != targets[0]


def test_a_tracker_keeps_to_its_method():
    with pytest.raises(ConfigError, match="keeps to"):
        DualFootTracker().retune(TrackerConfig(method="zupt"))
