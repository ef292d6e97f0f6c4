"""Samples that no foot gives: whatever they are, numpy has nothing to warn of on the way."""

from contextlib import suppress
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from dualfoot_ros.core import DualFootError, DualFootTracker
from dualfoot_ros.evaluation import run
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import Aligner

FEET = ("left", "right")


def times(force, rate):
    """Return a change that multiplies both triads."""
    return lambda s: replace(
        s, specific_force=force * s.specific_force, angular_rate=rate * s.angular_rate
    )


def filled_with(value):
    return lambda s: replace(
        s,
        specific_force=np.full_like(s.specific_force, value),
        angular_rate=np.full_like(s.angular_rate, value),
    )


def now_and_then(value):
    """Return a change that puts a value, and its opposite, into one sample in fifty."""

    def change(series):
        force, rate = series.specific_force.copy(), series.angular_rate.copy()
        force[53::97, 1], rate[7::97, 2] = value, -value
        return replace(series, specific_force=force, angular_rate=rate)

    return change


def flapping(series):
    """Return the ends of any range in turns."""
    sides = np.where(np.arange(len(series)) % 2, 499.0, -499.0)[:, None] * np.ones(3)
    return replace(series, specific_force=sides, angular_rate=-sides)


def set_clock(series):
    """Return a clock that is set by ten years in the middle of the walk."""
    late = np.where(np.arange(len(series)) > len(series) // 2, 3 * 10**17, 0)
    return replace(series, stamp_ns=series.stamp_ns + late)


WILD = {
    "gyro in deg/s": times(1.0, 180.0 / np.pi),
    "gyro in deg/s and no stand": lambda s: times(1.0, 180.0 / np.pi)(s)[240:],
    "force in g": times(1.0 / 9.80665, 1.0),
    "zeros": times(0.0, 0.0),
    "too small for a square": times(1e-200, 1e-200),
    "too large for a square": times(1e200, 1e200),
    "the end of the range": filled_with(499.0),
    "from end to end of the range": flapping,
    "not a number": filled_with(np.nan),
    "1e200 now and then": now_and_then(1e200),
    "infinite now and then": now_and_then(np.inf),
    "beyond the range now and then": now_and_then(501.0),
    "one sample": lambda s: s[:1],
    "no sample": lambda s: s[:0],
    "two a second": lambda s: s[::30],
    "equal stamps": lambda s: replace(s, stamp_ns=0 * s.stamp_ns),
    "a nanosecond apart": lambda s: replace(s, stamp_ns=np.arange(len(s))),
    "a clock that is set": set_clock,
}


@cache
def walk():
    """Return twelve seconds, three of which are a stand."""
    made = simulate(WalkConfig(route="L", rate=60.0, standing=3.0, final_standing=2.0), seed=1)
    return Recording(made.left[:720], made.right[:720])


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize("name", WILD)
def test_wild_samples_of_a_foot_are_refused_or_evaluated_without_a_warning(name):
    with suppress(DualFootError):
        run(Recording(WILD[name](walk().left), walk().right))


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize("name", WILD)
def test_wild_samples_of_both_feet_go_through_live_and_nothing_that_is_no_number_leaves(name):
    aligner, tracker = Aligner(), DualFootTracker(engine="compiled")
    feet = {"left": WILD[name](walk().left), "right": WILD[name](walk().right)}
    order = sorted((int(feet[f].stamp_ns[k]), f, k) for f in FEET for k in range(len(feet[f])))
    for stamp, foot, k in order:
        sample = np.concatenate([feet[foot].specific_force[k], feet[foot].angular_rate[k]])
        for pair in aligner.push(foot, stamp, sample):
            update = tracker.add(pair)
            assert update.row is None or np.isfinite(update.row).all()
