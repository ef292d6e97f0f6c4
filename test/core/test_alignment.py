"""Alignment: a checked standstill gives tilt and bias; motion starts it again."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import (
    AlignmentError,
    DualFootTracker,
    EventKind,
    TrackerConfig,
)
from dualfoot_ros.core.alignment import Standstill
from dualfoot_ros.core.config import Alignment

from .harness import GRAVITY, Pairs, open_session, standing_samples, walk

RATE = 100.0
LEVEL = np.array([0.0, 0.0, GRAVITY])
TILTS = [(0.0, 0.0), (0.5, -0.3), (-0.2, 0.9), (3.0, 0.1), (0.0, 1.5), (0.1, -1.55)]


def tilted(roll: float, pitch: float, seconds: float = 3.0, seed: int = 0) -> Pairs:
    """Return a standstill of two sensors with roll, pitch and a known gyro bias."""
    pairs = standing_samples(round(seconds * RATE), RATE, seed)
    turn = Rotation.from_euler("ZYX", [0.0, pitch, roll]).as_matrix()
    for foot in range(2):
        pairs.values[:, 6 * foot : 6 * foot + 3] += turn.T @ LEVEL - LEVEL
        pairs.values[:, 6 * foot + 3 : 6 * foot + 6] += bias_of(foot)
    return pairs


def bias_of(foot: int) -> np.ndarray:
    return np.array([0.02, -0.01, 0.04]) * (1.0 - 3.0 * foot)


@pytest.mark.parametrize(("roll", "pitch"), TILTS)
def test_a_known_tilt_and_bias_are_recovered(roll, pitch):
    session, _ = open_session(TrackerConfig(), tilted(roll, pitch))
    up = Rotation.from_euler("ZYX", [0.0, pitch, roll]).as_matrix().T @ [0.0, 0.0, 1.0]
    for foot, still in enumerate(session._still.result()):
        rotation = still.levelling()
        assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(rotation) == pytest.approx(1.0)
        assert np.allclose(rotation @ up, [0.0, 0.0, 1.0], atol=5e-4)
        assert np.allclose(still.angular_rate, bias_of(foot), atol=3e-4)


@pytest.mark.parametrize(("roll", "pitch"), TILTS[:3])
def test_a_tilt_has_the_heading_of_the_body_x_axis_zero(roll, pitch):
    session, _ = open_session(TrackerConfig(), tilted(roll, pitch))
    x_axis = session._estimate.rotation(0)[:, 0]
    assert np.arctan2(x_axis[1], x_axis[0]) == pytest.approx(0.0, abs=1e-12)


def test_the_feet_start_side_by_side_about_the_origin_left_foot_to_the_left():
    session, _ = open_session(TrackerConfig.from_mapping({"initial.spacing": 0.2}), tilted(0, 0))
    assert np.allclose(session._estimate.position(0), [0.0, 0.1, 0.0])
    assert np.allclose(session._estimate.position(1), [0.0, -0.1, 0.0])


def test_after_levelling_a_foot_at_rest_feels_no_acceleration():
    """A wrong gravity is taken for accelerometer bias along the vertical, and nothing remains."""
    pairs = tilted(0.4, -0.2)
    pairs.values[:, [0, 1, 2, 6, 7, 8]] *= 1.01
    session, _ = open_session(TrackerConfig(), pairs)
    still = session._still.result()[0]
    rotation = session._estimate.rotation(0)
    bias = session.space.w[18:21]
    assert np.allclose(rotation @ (still.specific_force - bias), [0.0, 0.0, GRAVITY], atol=1e-9)


def test_motion_during_the_alignment_starts_it_again_and_is_counted():
    pairs = standing_samples(round(8.0 * RATE), RATE)
    moved = slice(round(1.6 * RATE), round(2.0 * RATE))
    pairs.values[moved, 5] += np.linspace(0.0, 2.0, moved.stop - moved.start)
    tracker = DualFootTracker(engine="interpreted")
    phases, complaints = [], set()
    for pair in pairs:
        phases.append(tracker.add(pair).phase)
        complaints.add(tracker.complaint)
    assert phases.index("standing") > moved.stop + 2.0 * RATE - 1
    assert tracker.counters["alignment_restarts"] == 1
    assert any(c and "left foot: angular rate scatter" in c for c in complaints)


def test_the_stillest_windows_are_chosen():
    """Half of the stand sways with a mean rate; the bias must come from the other half."""
    config, rng = Alignment(duration=6.0), np.random.default_rng(0)
    still = Standstill(config, GRAVITY, RATE)
    size = round(config.window * RATE)
    for k in range(8):
        window = standing_samples(size, RATE, seed=k).values
        if k % 2:
            window[:, 3:6] += 0.01 + 0.008 * rng.normal(size=(size, 3))
        for row in window:
            still.add(row)
    left, right = still.result()
    assert np.abs(left.angular_rate).max() < 3e-4
    assert np.abs(right.angular_rate).max() < 3e-4


def test_the_longer_the_stand_the_better_the_bias():
    errors = []
    for seconds in (3.0, 40.0):
        squares = []
        for seed in range(12):
            still = Standstill(Alignment(still_fraction=1.0), GRAVITY, RATE)
            for row in standing_samples(round(seconds * RATE), RATE, seed).values:
                still.add(row)
            squares.append(still.result()[0].angular_rate ** 2)
        errors.append(np.sqrt(np.mean(squares)))
    assert errors[1] < 0.5 * errors[0]


@pytest.mark.parametrize(
    ("spoil", "what"),
    [
        (lambda v: v[:, 3:6].__imul__(57.3), "left foot"),
        (lambda v: v[:, 6:9].__imul__(1 / GRAVITY), "right foot: gravity error"),
    ],
    ids=["degrees per second", "g"],
)
def test_a_wrong_unit_is_no_standstill_and_the_error_says_what_it_saw(spoil, what):
    pairs = walk(3.5)
    values = pairs.values.copy()
    spoil(values)
    with pytest.raises(AlignmentError, match=what):
        DualFootTracker(engine="interpreted").run(*Pairs(pairs.stamps, values).series())


def test_a_recording_too_short_to_align_is_refused_with_what_is_needed():
    with pytest.raises(AlignmentError, match=r"no standstill of 2 s .* 1\.0 s long"):
        DualFootTracker(engine="interpreted").run(*standing_samples(100).series())


def test_the_alignment_is_announced_with_what_it_found():
    tracker = DualFootTracker(engine="interpreted")
    events = [e for pair in tilted(0.1, 0.2) for e in tracker.add(pair).events]
    aligned = [e for e in events if e.kind is EventKind.ALIGNED]
    assert len(aligned) == 1
    assert np.allclose(aligned[0].detail["left_gyro_bias"], bias_of(0), atol=5e-4)
    assert aligned[0].detail["right_gravity"] == pytest.approx(GRAVITY, abs=0.01)
