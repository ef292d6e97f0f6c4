"""Steps: one a landing, with the lengths, widths, times and turns of the true footprints."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, ImuPair, PersonTracker, StepTracker, TrackerConfig
from dualfoot_ros.core.samples.series import stack_pairs

from ..harness import quick_engine, simulated


@pytest.fixture(scope="module")
def steps():
    made = simulated("L", rate=100.0)
    tracker = DualFootTracker(TrackerConfig(), engine=quick_engine().name)
    person, stepping, found = PersonTracker(), StepTracker(), []
    values = stack_pairs(made.left, made.right)
    for stamp, row in zip(made.left.stamp_ns.tolist(), values, strict=True):
        update = tracker.add(ImuPair(stamp, row))
        estimate = person.add(update)
        if estimate is not None:
            found += stepping.add(update, estimate)
    return made, found


def test_every_landing_after_the_first_strides_is_a_step_and_the_sides_take_turns(steps):
    made, found = steps
    landings = len(made.walk.footprints.side) - 2
    assert landings - 8 <= len(found) <= landings
    sides = [step.side for step in found]
    assert all(a != b for a, b in pairwise(sides))
    assert all(0 < step.detected_ns - step.stamp_ns < 10**9 for step in found)


def test_lengths_and_times_are_those_of_the_walk(steps):
    made, found = steps
    config = made.walk.config
    straight = found[2:30]
    assert np.mean([s.length for s in straight]) == pytest.approx(config.step_length, rel=0.06)
    assert np.mean([s.stride for s in straight]) == pytest.approx(2 * config.step_length, rel=0.06)
    times = [s.duration_s for s in straight]
    assert np.mean(times) == pytest.approx(0.5 * config.cycle_s, rel=0.03)
    assert 0.0 < np.mean([s.width for s in straight]) < 0.3
    assert np.abs([s.height for s in straight]).max() < 0.2


def test_the_turns_of_the_steps_make_up_the_corner(steps):
    _, found = steps
    assert sum(s.turn for s in found if s.turn is not None) == pytest.approx(math.pi / 2, abs=0.2)


def test_confidence_is_a_probability(steps):
    _, found = steps
    assert all(0.0 < s.confidence <= 1.0 for s in found)
