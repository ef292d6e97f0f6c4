"""A lap of 400 m has one heading, whatever the samples are, if taken for what they are."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from dualfoot_ros.core import FEET, DualFootTracker, Increments
from dualfoot_ros.inspection import unconstrained_config
from dualfoot_ros.simulation import ClockConfig, WalkConfig, grade, simulate, walk
from dualfoot_ros.timing import align

COMPENSATED, AVERAGED, SAMPLED = Increments
RATES_HZ = (60.0, 100.0)  # the lower, the more the samples hide; beyond it is less still
# degrees; from one seed to the next the heading at the end of such a lap scatters by 4 to 5
ALIKE, ALIKE_FOR_SAMPLED, ALIKE_AT_60_HZ = 1.0, 1.5, 3.0


@cache
def lap(rate_hz):
    return walk(WalkConfig(route="track", speed=1.6, rate=rate_hz), seed=2)


@cache
def measured(rate_hz, made):
    """Return the lap as consumer sensors give it whose samples are ``made`` of one kind."""
    sensor = replace(grade("consumer"), increments=made.value)
    return simulate(lap(rate_hz), sensor, seed=2)


@cache
def turned(rate_hz, made, taken):
    """Return the heading error (2,) in degrees that the left and the right foot gain on the lap.

    The samples of consumer sensors are ``made`` of one kind and ``taken`` for another.
    """
    simulation = measured(rate_hz, made)
    left, right = (replace(getattr(simulation, foot), increments=taken) for foot in FEET)
    tracks = DualFootTracker(unconstrained_config()).run(left, right)
    return np.array([_gained(tracks, simulation, foot) for foot in FEET])


def _gained(tracks, simulation, foot):
    track, truth = getattr(tracks, foot), getattr(simulation, f"{foot}_truth")
    _, ours, theirs = np.intersect1d(track.stamp_ns, truth.stamp_ns, return_indices=True)
    error = (
        Rotation.from_quat(track.quaternion[ours])
        * Rotation.from_quat(truth.quaternion[theirs]).inv()
    ).as_rotvec()[:, 2]
    return np.degrees(np.unwrap(error)[-1] - error[0])


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_compensated_increments_and_means_have_the_same_heading_after_a_lap(rate_hz):
    apart = turned(rate_hz, COMPENSATED, COMPENSATED) - turned(rate_hz, AVERAGED, AVERAGED)
    assert np.abs(apart).max() < ALIKE


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_sampled_values_have_it_as_far_as_a_sample_in_17_ms_can_tell(rate_hz):
    apart = turned(rate_hz, SAMPLED, SAMPLED) - turned(rate_hz, AVERAGED, AVERAGED)
    assert np.abs(apart).max() < (ALIKE_AT_60_HZ if rate_hz < 80.0 else ALIKE_FOR_SAMPLED)


@pytest.mark.parametrize("phase", [0.5])
def test_a_foot_that_is_sampled_beside_the_other_keeps_the_heading_too(phase):
    assert abs(_gained_beside(phase) - _gained_beside(0.0)) < ALIKE


@cache
def _gained_beside(phase):
    """Return the heading error that an ideal right foot gains, ``phase`` after the left one."""
    sensor = replace(grade("ideal"), increments="compensated")
    clocks = ClockConfig(), ClockConfig(phase=phase)
    simulation = simulate(lap(60.0), sensor, clocks, seed=2)
    tracks = DualFootTracker(unconstrained_config()).run(*align(simulation.left, simulation.right))
    return _gained_between(tracks.right, simulation.right_truth)


def _gained_between(track, truth):
    """Return the heading error gained by a track whose stamps lie between those of the truth."""
    there = Slerp(truth.stamp_ns * 1e-9, Rotation.from_quat(truth.quaternion))
    inside = track.stamp_ns < truth.stamp_ns[-1]
    error = (
        Rotation.from_quat(track.quaternion)
        * there(np.minimum(track.stamp_ns, truth.stamp_ns[-1]) * 1e-9).inv()
    )
    turns = np.unwrap(error.as_rotvec()[inside, 2])
    return np.degrees(turns[-1] - turns[0])


@pytest.mark.parametrize(
    ("made", "taken", "least"),
    [
        (COMPENSATED, AVERAGED, 14.0),
        (COMPENSATED, SAMPLED, 5.0),
        (AVERAGED, COMPENSATED, 14.0),
        (AVERAGED, SAMPLED, 7.0),
        (SAMPLED, COMPENSATED, 5.0),
        (SAMPLED, AVERAGED, 7.0),
    ],
)
def test_the_wrong_kind_turns_both_feet_by_many_degrees_and_mirrored(made, taken, least):
    apart = turned(60.0, made, taken) - turned(60.0, made, made)
    assert np.abs(apart).min() > least
    assert apart[0] * apart[1] < 0.0
