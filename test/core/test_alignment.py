"""Alignment: a checked standstill gives tilt and bias; motion starts it again."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import (
    AlignmentError,
    DualFootTracker,
    EventKind,
    TrackerConfig,
)
from dualfoot_ros.core.alignment import (
    Alignment,
    FootStand,
    FootStandstill,
    Window,
    WindowSlider,
    stillness,
)
from dualfoot_ros.core.groups import AlignmentConfig

from .harness import (
    GRAVITY,
    Pairs,
    cross_matrix,
    open_session,
    quick_engine,
    simulated,
    standing_samples,
    walk,
)

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
    for foot, still in enumerate(session._start.feet):
        rotation = still.levelling()
        assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(rotation) == pytest.approx(1.0)
        assert np.allclose(rotation @ up, [0.0, 0.0, 1.0], atol=5e-4)
        assert np.allclose(still.angular_rate, bias_of(foot), atol=3e-4)


@pytest.mark.parametrize(("roll", "pitch"), TILTS[:3])
def test_a_tilt_has_the_heading_of_the_body_x_axis_zero(roll, pitch):
    session, _ = open_session(TrackerConfig(), tilted(roll, pitch))
    x_axis = session._walk.estimate.rotation(0)[:, 0]
    assert np.arctan2(x_axis[1], x_axis[0]) == pytest.approx(0.0, abs=1e-12)


def test_the_feet_start_side_by_side_about_the_origin_left_foot_to_the_left():
    session, _ = open_session(TrackerConfig.from_mapping({"initial.spacing": 0.2}), tilted(0, 0))
    assert np.allclose(session._walk.estimate.position(0), [0.0, 0.1, 0.0])
    assert np.allclose(session._walk.estimate.position(1), [0.0, -0.1, 0.0])


def test_after_levelling_a_foot_at_rest_feels_no_acceleration():
    """A wrong gravity is taken for accelerometer bias along the vertical, and nothing remains."""
    pairs = tilted(0.4, -0.2)
    pairs.values[:, [0, 1, 2, 6, 7, 8]] *= 1.01
    session, _ = open_session(TrackerConfig(), pairs)
    still = session._start.feet[0]
    rotation = session._walk.estimate.rotation(0)
    bias = session.space.w[18:21]
    assert np.allclose(rotation @ (still.specific_force - bias), [0.0, 0.0, GRAVITY], atol=1e-9)


@pytest.mark.parametrize(("roll", "pitch"), TILTS)
def test_tilt_and_accelerometer_bias_are_known_to_cancel_from_the_start(roll, pitch):
    """P0 is that of unrelated errors after a measurement that the levelled foot feels only g."""
    config = TrackerConfig()
    session, _ = open_session(config, tilted(roll, pitch))
    p0, still = config.initial, session._start.feet
    for foot in range(2):
        rotation = session._walk.estimate.rotation(foot)
        h = np.hstack(
            [np.zeros((3, 6)), cross_matrix([0.0, 0.0, GRAVITY]), np.zeros((3, 3)), rotation]
        )
        stds = [p0.position] * 3 + [p0.velocity] * 3 + [p0.tilt, p0.tilt, p0.yaw]
        stds += [max(p0.gyro_bias, still[foot].rate_std)] * 3 + [p0.accelerometer_bias] * 3
        p = np.diag(np.square(stds))
        s = h @ p @ h.T + max(1e-3, still[foot].force_std) ** 2 * np.eye(3)
        expected = p - p @ h.T @ np.linalg.solve(s, h @ p)
        found = session.space.covariance()[15 * foot : 15 * foot + 15, 15 * foot : 15 * foot + 15]
        assert np.allclose(found, expected, rtol=1e-9, atol=1e-15)
        assert np.array_equal(found, found.T)
        assert np.linalg.eigvalsh(found).min() > 0.0


def test_motion_during_the_alignment_starts_it_again_and_is_counted():
    pairs = standing_samples(round(8.0 * RATE), RATE)
    moved = slice(round(1.6 * RATE), round(2.0 * RATE))
    pairs.values[moved, 5] += np.linspace(0.0, 2.0, moved.stop - moved.start)
    tracker = DualFootTracker(engine=quick_engine().name)
    phases, complaints = [], set()
    for pair in pairs:
        phases.append(tracker.add(pair).phase)
        complaints.add(tracker.complaint)
    assert phases.index("standing") > moved.stop + 2.0 * RATE - 1
    assert tracker.counters["alignment_restarts"] == 1
    assert any(c and "left foot: angular rate scatter" in c for c in complaints)


def stood(
    values: np.ndarray, rate: float = RATE, config: AlignmentConfig | None = None
) -> tuple[FootStandstill, FootStandstill]:
    """Return what a stand of pairs ``values`` (N, 12) gives, whatever moves in it left out."""
    config = config or AlignmentConfig()
    return tuple(stood_on(values[:, 6 * foot : 6 * foot + 6], rate, config) for foot in range(2))


def stood_on(values: np.ndarray, rate: float, config: AlignmentConfig) -> FootStandstill:
    slider, stand = WindowSlider(config.window), FootStand(config)
    for k, row in enumerate(values):
        window = slider.add(round(k * 1e9 / rate), row)
        if window is not None and window.motion(config, GRAVITY) is None:
            stand.add(window)
    return stand.result()


def test_the_stiller_part_of_the_stand_decides():
    """Half of the stand sways with a mean rate; the bias must come from the other half."""
    rng = np.random.default_rng(0)
    values = standing_samples(600, RATE).values
    for start in (100, 350):
        values[start : start + 150, 3:6] += 0.01 + 0.008 * rng.normal(size=(150, 3))
    left, right = stood(values)
    assert np.abs(left.angular_rate).max() < 3e-4
    assert np.abs(right.angular_rate).max() < 3e-4


@pytest.mark.parametrize("rate", [60.0, 100.0, 400.0])
def test_a_foot_that_turns_evenly_without_noise_gives_its_rate_exactly(rate):
    values = np.tile(np.r_[LEVEL, bias_of(0), LEVEL, bias_of(1)], (round(5.0 * rate), 1))
    for foot, still in enumerate(stood(values, rate)):
        assert np.allclose(still.angular_rate, bias_of(foot), rtol=0.0, atol=1e-15)
        assert np.allclose(still.specific_force, LEVEL, rtol=0.0, atol=1e-13)
        assert still.rate_std < 1e-15


def test_a_window_counts_by_the_fourth_power_of_its_scatter_and_alike_below_the_floor():
    scatters = np.array([1e-7, 1e-6, 1e-2, 2e-2])
    lowest, low, high, higher = stillness(scatters, 1e-4)
    assert lowest == pytest.approx(low, rel=1e-3)
    assert high == pytest.approx(16.0 * higher, rel=1e-3)
    assert low == pytest.approx(1e8 * high, rel=1e-3)


def test_the_mean_is_that_of_weights_that_fade():
    rng, config = np.random.default_rng(3), AlignmentConfig(still_rate_std=1e-3)
    windows = [
        Window(rng.normal(size=6).tolist(), rng.uniform(5e-3, 1e-2, 6).tolist(), 10**9 * k, 1.0)
        for k in range(40)
    ]
    stand, keep = FootStand(config), np.exp(-1.0 / 30.0)
    for window in windows:
        stand.add(window)
    scatters = np.array([max(window.std[3:]) for window in windows])
    weights = stillness(scatters, 1e-3) * keep ** np.arange(39.0, -1.0, -1.0)
    means = np.array([window.mean for window in windows])
    mean = np.average(means, axis=0, weights=weights)
    variance = np.average((means - mean) ** 2, axis=0, weights=weights)
    found = stand.result()
    independent = weights.sum() ** 2 / (weights**2).sum()
    assert independent > 4.0  # enough windows: their scatter alone decides
    assert np.allclose(found.specific_force, mean[:3], rtol=1e-12, atol=0.0)
    assert np.allclose(found.angular_rate, mean[3:], rtol=1e-12, atol=0.0)
    expected = np.sqrt(variance[3:].max() / (independent - 1.0))
    assert found.rate_std == pytest.approx(expected, rel=1e-9)
    assert found.force_std == pytest.approx(np.sqrt(0.5 * variance[:3].sum()), rel=1e-9)


def test_still_rate_std_decides_from_where_on_windows_count_alike():
    """A quarter of the stand turns by 0.01 rad/s and shakes."""
    values, rng = standing_samples(800, RATE).values, np.random.default_rng(0)
    values[300:500, 3:6] += 0.01 + 0.008 * rng.normal(size=(200, 3))
    found = []
    for floor in (1e-3, 1.0):
        left, _ = stood(values, config=AlignmentConfig(still_rate_std=floor))
        found.append(left.angular_rate.max())
    assert found[0] < 5e-4 and found[1] == pytest.approx(0.0025, rel=0.3)


@cache
def swaying(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return 20 s of pairs of swaying feet (N, 12), and how far they really turned (N, 6), rad."""
    stand = {"route": "standing", "rate": RATE, "standing": 20.0, "final_standing": 0.5}
    made = simulated(**stand, seed=seed)
    truths = [Rotation.from_quat(t.quaternion) for t in (made.left_truth, made.right_truth)]
    turned = [(truth[0].inv() * truth).as_rotvec() for truth in truths]
    return walk(**stand, seed=seed).values, np.hstack(turned)


@cache
def errors_and_scatters(seconds: float, seeds: range) -> tuple[np.ndarray, np.ndarray]:
    """Return the errors (M, 3) of the bias of a stand, and what it says they are (M,), rad/s."""
    count, errors, scatters = round(seconds * RATE), [], []
    for seed in seeds:
        values, turned = swaying(seed)
        for foot, still in enumerate(stood(values[:count])):
            mean = values[1:count, 6 * foot + 3 : 6 * foot + 6].mean(axis=0)
            sway = turned[count - 1, 3 * foot : 3 * foot + 3] / seconds
            errors.append(still.angular_rate - (mean - sway))
            scatters.append(still.rate_std)
    return np.array(errors), np.array(scatters)


@pytest.mark.parametrize(("seconds", "limit_deg"), [(5.0, 0.07), (10.0, 0.04), (20.0, 0.022)])
def test_sway_does_not_pull_the_bias_and_less_the_longer_the_stand(seconds, limit_deg):
    """Standing feet turn by 0.1 deg/s here, and there and back again."""
    errors, _ = errors_and_scatters(seconds, range(20))
    assert np.degrees(np.sqrt(np.mean(errors**2))) < limit_deg


@pytest.mark.parametrize(("seconds", "most"), [(3.0, 3.0), (5.0, 2.2), (10.0, 1.0), (20.0, 1.0)])
def test_the_scatter_is_honest_about_the_error(seconds, most):
    """Sway does not show itself within seconds; a long stand is better than it says."""
    errors, scatters = errors_and_scatters(seconds, range(20))
    squares = np.mean((errors / scatters[:, None]) ** 2)
    assert 0.15 < squares < most


@pytest.mark.parametrize("seed", range(10))
def test_a_sample_more_or_less_changes_the_bias_by_next_to_nothing(seed):
    """0.001 deg/s is 0.2 degrees of heading in three minutes of walking."""
    values, _ = swaying(seed)
    whole = stood(values[:800])
    for span in (slice(1, 800), slice(0, 799), slice(1, 799)):
        for one, other in zip(whole, stood(values[span]), strict=True):
            change = np.degrees(np.abs(one.angular_rate - other.angular_rate).max())
            assert change < 1e-3


@pytest.mark.parametrize("seed", range(5))
def test_a_foot_that_is_turned_while_standing_pulls_little(seed):
    """Weight is shifted for 1.5 s: a foot turns by 1.1 degrees, up to 1.5 deg/s, and stays so."""
    values = swaying(seed)[0][:1000].copy()
    plain = stood(values)[0].angular_rate
    pulse = np.radians(0.75) * (1.0 - np.cos(2.0 * np.pi * np.arange(150) / 150.0))
    values[400:550, 5] += pulse
    pulled = stood(values)[0].angular_rate
    assert abs(pulled - plain)[2] < 0.4 * pulse.sum() / len(values)


def test_a_lifted_foot_is_no_part_of_the_stand():
    values = swaying(0)[0][:1000].copy()
    plain = stood(values)[0].angular_rate
    values[400:440, 3:6] += np.sin(2.0 * np.pi * np.arange(40) / 40.0)[:, None]
    alignment, seen, began = Alignment(TrackerConfig()), [], False
    for k, row in enumerate(values):
        if began:
            alignment.refine(k * 10**7, row)
        else:
            began = alignment.add(k * 10**7, row) is not None
        seen.append(alignment.complaint)
    assert began and seen[-1] is None
    assert all(c and "left foot: angular rate scatter" in c for c in seen[410:440])
    assert np.degrees(np.abs(alignment.result()[0].angular_rate - plain)).max() < 0.04


def test_a_bias_that_drifts_is_followed():
    """After five minutes of standing the bias of the last half minute counts, not the mean."""
    values = standing_samples(round(300.0 * RATE)).values
    values[:, 5] += np.linspace(0.0, 0.01, len(values))
    assert stood(values)[0].angular_rate[2] == pytest.approx(0.01, abs=0.0012)


def test_the_longer_the_stand_the_better_the_bias():
    errors = []
    for seconds in (3.0, 40.0):
        squares = []
        for seed in range(12):
            left, _ = stood(standing_samples(round(seconds * RATE), RATE, seed).values)
            squares.append(left.angular_rate**2)
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
    with pytest.raises(AlignmentError, match=r"recording is 1\.0 s long and ends .* stand"):
        DualFootTracker(engine="interpreted").run(*standing_samples(100).series())


def test_the_alignment_is_announced_with_what_it_found():
    tracker = DualFootTracker(engine=quick_engine().name)
    events = [e for pair in tilted(0.1, 0.2) for e in tracker.add(pair).events]
    aligned = [e for e in events if e.kind is EventKind.ALIGNED]
    assert len(aligned) == 1
    assert np.allclose(aligned[0].detail["left_gyro_bias"], bias_of(0), atol=5e-4)
    assert aligned[0].detail["right_gravity"] == pytest.approx(GRAVITY, abs=0.01)
