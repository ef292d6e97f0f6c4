"""The strapdown mechanization against closed forms, without noise."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.strapdown import mechanize, rotation_increment
from dualfoot_ros.core.results.row_store import RowStore

from ..harness import GRAVITY, quick_engine
from .states import configured

SAMPLE = lay.RINGS


def workspace() -> np.ndarray:
    w = np.zeros(lay.workspace_size(4))
    w[lay.C_GRAVITY] = GRAVITY
    w[lay.ROT : lay.ROT + 9] = np.eye(3).ravel()
    return w


def run(w: np.ndarray, dt: float, forces, rates) -> None:
    """Mechanize the left foot over (N, 3) mean specific forces and angular rates."""
    for force, rate in zip(forces, rates, strict=True):
        w[SAMPLE + 1 : SAMPLE + 4], w[SAMPLE + 4 : SAMPLE + 7] = force, rate
        mechanize(w, 0, dt, SAMPLE + 1)


def rotation(w: np.ndarray) -> np.ndarray:
    return w[lay.ROT : lay.ROT + 9].reshape(3, 3)


def increment(vector) -> np.ndarray:
    w = workspace()
    rotation_increment(w, *(float(v) for v in vector))
    return w[lay.S_ROTATION : lay.S_ROTATION + 9].reshape(3, 3)


def directions():
    part = st.floats(-1.0, 1.0)
    return st.tuples(part, part, part).filter(lambda v: math.hypot(*v) > 0.1)


@given(directions(), st.floats(0.0, 6.0))
def test_a_rotation_increment_is_the_exponential_map(direction, angle):
    vector = np.array(direction) / np.linalg.norm(direction) * angle
    expected = Rotation.from_rotvec(vector).as_matrix()
    assert np.allclose(increment(vector), expected, rtol=0.0, atol=4e-15)


@given(directions(), st.floats(-1e-12, 1e-12))
def test_series_and_closed_form_meet_where_one_takes_over_from_the_other(direction, beyond):
    unit = np.array(direction) / np.linalg.norm(direction)
    below, above = increment(unit * (0.7 - 1e-12)), increment(unit * (0.7 + 1e-12 + beyond))
    assert np.allclose(below, above, rtol=0.0, atol=5e-12)
    expected = Rotation.from_rotvec(unit * (0.7 - 1e-12)).as_matrix()
    assert np.allclose(below, expected, rtol=0.0, atol=1e-15)


def test_a_constant_rate_turns_by_rate_times_time():
    w, rate, dt, count = workspace(), np.array([0.3, -1.1, 2.0]), 0.005, 2000
    run(w, dt, np.zeros((count, 3)), np.tile(rate, (count, 1)))
    expected = Rotation.from_rotvec(rate * dt * count).as_matrix()
    assert np.allclose(rotation(w), expected, atol=1e-12)


def test_a_sensor_at_rest_stays_where_it_is_to_the_bit():
    w = workspace()
    w[lay.POS : lay.POS + 3] = [1.0, -2.0, 0.5]
    run(w, 0.005, np.tile([0.0, 0.0, GRAVITY], (1000, 1)), np.zeros((1000, 3)))
    assert w[lay.VEL : lay.VEL + 3].tolist() == [0.0, 0.0, 0.0]
    assert w[lay.POS : lay.POS + 3].tolist() == [1.0, -2.0, 0.5]


def test_free_fall_is_half_g_t_squared_whatever_the_attitude_does():
    w, dt, count = workspace(), 0.01, 300
    run(w, dt, np.zeros((count, 3)), np.tile([1.0, 2.0, -3.0], (count, 1)))
    t = dt * count
    assert np.allclose(w[lay.VEL : lay.VEL + 3], [0.0, 0.0, -GRAVITY * t], rtol=1e-13)
    assert np.allclose(w[lay.POS : lay.POS + 3], [0.0, 0.0, -0.5 * GRAVITY * t * t], rtol=1e-12)


def test_bias_is_taken_off_before_anything_else():
    plain, biased = workspace(), workspace()
    rng = np.random.default_rng(1)
    forces, rates = rng.normal(size=(50, 3)) * 5.0, rng.normal(size=(50, 3))
    bg, ba = np.array([0.01, -0.02, 0.03]), np.array([0.1, 0.2, -0.3])
    biased[lay.BG : lay.BG + 3], biased[lay.BA : lay.BA + 3] = bg, ba
    run(plain, 0.005, forces, rates)
    run(biased, 0.005, forces + ba, rates + bg)
    assert np.allclose(plain[: lay.BG], biased[: lay.BG], rtol=0.0, atol=1e-12)


def circle_error(steps: int) -> float:
    """Return the greatest position error over one circle of 2 m radius at 1.5 rad/s."""
    rate, radius = 1.5, 2.0
    dt = 2.0 * math.pi / rate / steps
    w = workspace()
    w[lay.VEL] = rate * radius
    worst = 0.0
    for k in range(1, steps + 1):
        run(w, dt, [[0.0, rate * rate * radius, GRAVITY]], [[0.0, 0.0, rate]])
        angle = rate * dt * k
        truth = [radius * math.sin(angle), radius * (1.0 - math.cos(angle)), 0.0]
        worst = max(worst, float(np.linalg.norm(w[lay.POS : lay.POS + 3] - truth)))
    return worst


def test_a_centripetal_force_keeps_a_turning_body_on_its_circle_to_second_order():
    coarse, fine = circle_error(400), circle_error(800)
    assert coarse < 1e-3
    assert coarse / fine == pytest.approx(4.0, rel=0.1)


def coning(tilt: float, frequency: float, dt: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return rotation increments (N, 3) of a coning body and its true final attitude.

    R(t) = Rz(W t) Ry(tilt) Rz(-W t), whose body rate is
    W (-sin(tilt) cos(W t), -sin(tilt) sin(W t), cos(tilt) - 1).
    """
    edges = np.arange(count + 1) * dt * frequency
    s = math.sin(tilt)
    alpha = np.stack(
        [
            -s * np.diff(np.sin(edges)),
            s * np.diff(np.cos(edges)),
            (math.cos(tilt) - 1.0) * np.diff(edges),
        ],
        axis=1,
    )
    last = Rotation.from_euler("ZYZ", [edges[-1], tilt, -edges[-1]]).as_matrix()
    return alpha, last


def test_coning_drifts_a_hundredth_of_what_it_would_without_the_coning_term():
    tilt, frequency, dt, count = 0.05, 2.0 * math.pi * 5.0, 0.005, 4000
    alpha, truth = coning(tilt, frequency, dt, count)
    w = workspace()
    w[lay.ROT : lay.ROT + 9] = Rotation.from_euler("Y", tilt).as_matrix().ravel()
    w[lay.ALPHA : lay.ALPHA + 3] = coning(tilt, -frequency, dt, 1)[0][0] * [-1, -1, -1]
    run(w, dt, np.zeros((count, 3)), alpha / dt)
    plain = Rotation.from_euler("Y", tilt)
    for a in alpha:
        plain = plain * Rotation.from_rotvec(a)
    drift = Rotation.from_matrix(rotation(w) @ truth.T).magnitude()
    uncompensated = Rotation.from_matrix(plain.as_matrix() @ truth.T).magnitude()
    assert uncompensated > 0.003
    assert drift < 0.02 * uncompensated


def test_sculling_is_compensated():
    """Rock about x while shaking along y, in phase: the mean acceleration along z is half AB."""
    rock, shake, frequency, dt, count = 0.1, 20.0, 2.0 * math.pi * 4.0, 0.005, 400

    def angle(t):
        return rock * np.sin(frequency * t)

    def motion(t, _):
        c, s = math.cos(angle(t)), math.sin(angle(t))
        f = shake * math.sin(frequency * t)
        return [c * f, s * f - GRAVITY]

    truth = solve_ivp(motion, (0.0, dt * count), [0.0, 0.0], rtol=1e-10, atol=1e-12).y[:, -1]
    t = np.arange(count + 1) * dt
    forces, rates = np.zeros((count, 3)), np.zeros((count, 3))
    forces[:, 1] = -shake / frequency * np.diff(np.cos(frequency * t)) / dt
    rates[:, 0] = np.diff(angle(t)) / dt
    w = workspace()
    run(w, dt, forces, rates)
    plain, turn = np.zeros(3), Rotation.identity()
    for f, r in zip(forces, rates, strict=True):
        plain += turn.apply(f * dt) + np.array([0.0, 0.0, -GRAVITY * dt])
        turn = turn * Rotation.from_rotvec(r * dt)
    error = np.abs(w[lay.VEL + 1 : lay.VEL + 3] - truth).max()
    assert error < 0.01 * np.abs(plain[1:] - truth).max()


def test_the_attitude_is_still_a_rotation_after_a_million_steps():
    engine = quick_engine()
    if engine.name == "interpreted":
        pytest.skip("numba is not installed; a million interpreted steps take too long")
    rng, chunk = np.random.default_rng(0), 10_000
    space = configured(
        TrackerConfig.from_mapping({"method": "zupt", "stance.detector": "fixed"}), 200.0, 0.1
    )
    w, n = space.w, space.n
    for foot in range(2):
        w[foot * lay.FOOT + lay.ROT : foot * lay.FOOT + lay.ROT + 9] = np.eye(3).ravel()
    rows, stamps = RowStore(chunk), 5_000_000 * np.arange(chunk)
    for _ in range(100):
        samples = rng.uniform(-10.0, 10.0, size=(4, chunk, 3))
        given = space.stamps, stamps, *samples, 1, chunk, *rows.arrays
        assert engine.advance(w, n, *given) == chunk
    for foot in range(2):
        r = w[foot * lay.FOOT + lay.ROT : foot * lay.FOOT + lay.ROT + 9].reshape(3, 3)
        assert np.abs(r @ r.T - np.eye(3)).max() < 1e-11
        assert np.linalg.det(r) == pytest.approx(1.0, abs=1e-11)
