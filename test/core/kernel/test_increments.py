"""Each kind of sample under its own mechanization gives the exact motion, another kind's does not.

Coning and sculling have closed forms: a body whose axis runs round a cone, and one that rocks
about x while it is shaken along y.  All motions take whole periods, so that only what accumulates
is left.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.spatial.transform import Rotation
from scipy.special import j1

from dualfoot_ros.core import Increments
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.strapdown import mechanize
from dualfoot_ros.core.session.initial_state import KINDS

GRAVITY = 9.80665
SAMPLE = lay.RINGS + 1
TILT, ROCK, SHAKE = 0.1, 0.1, 20.0  # rad, rad, m/s^2
TURN = 2.0 * math.pi  # rad/s, one period a second
LEAD = 2  # samples before the motion counts, which the two-sample terms look back at
COMPENSATED, AVERAGED, SAMPLED = Increments
WRONG = [(made, taken) for made in Increments for taken in Increments if made is not taken]


def held(turn: Rotation, velocity: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the force and rate (N, 3) that, held for ``dt``, turn and push as much (N, 3).

    By the series of the integral of exp([alpha x] s) over s, which is inverted as a matrix.
    """
    alpha = turn.as_rotvec()
    gamma = []
    for a, v in zip(alpha, velocity, strict=True):
        cross = np.cross(a, np.eye(3)).T
        power, total, factorial = np.eye(3), np.eye(3), 1.0
        for n in range(2, 14):
            power, factorial = power @ cross, factorial * n
            total = total + power / factorial
        gamma.append(np.linalg.solve(total, v))
    return np.array(gamma) / dt, alpha / dt


def run(kind: Increments, attitude: Rotation, dt: float, forces, rates) -> np.ndarray:
    """Mechanize the left foot as ``kind``; ``attitude`` is that after ``LEAD`` samples."""
    w = np.zeros(lay.workspace_size(4))
    w[lay.C_GRAVITY] = GRAVITY
    w[lay.C_FOOT + lay.C_INCREMENTS] = KINDS[kind]
    for at, (force, rate) in enumerate(zip(forces, rates, strict=True)):
        w[SAMPLE : SAMPLE + 3], w[SAMPLE + 3 : SAMPLE + 6] = force, rate
        mechanize(w, 0, dt, SAMPLE)
        if at == LEAD - 1:
            w[lay.POS : lay.ROT] = 0.0
            w[lay.ROT : lay.ROT + 9] = attitude.as_matrix().ravel()
    return w


def coning_error(made: Increments, taken: Increments, rate_hz: float, periods: int = 1) -> float:
    """Return the error (rad) after coning, R(t) = Rz(W t) Ry(tilt) Rz(-W t), sampled as ``made``.

    The body rate is W (-sin(tilt) cos(W t), -sin(tilt) sin(W t), cos(tilt) - 1).
    """
    dt, count = 1.0 / rate_hz, round(periods * rate_hz)
    t = TURN * dt * np.arange(-LEAD, count + 1)
    s, down = math.sin(TILT), math.cos(TILT) - 1.0
    attitude = Rotation.from_euler("ZYZ", np.column_stack([t, np.full(len(t), TILT), -t]))
    if made is COMPENSATED:
        rates = (attitude[:-1].inv() * attitude[1:]).as_rotvec() / dt
    elif made is AVERAGED:
        edges = np.column_stack([-s * np.sin(t), s * np.cos(t), down * t])
        rates = np.diff(edges, axis=0) / dt
    else:
        here = np.column_stack([-s * np.cos(t), -s * np.sin(t), np.full(len(t), down)])
        rates = TURN * here[1:]
    w = run(taken, attitude[LEAD], dt, np.zeros_like(rates), rates)
    made_attitude = Rotation.from_matrix(w[lay.ROT : lay.ROT + 9].reshape(3, 3))
    return float((made_attitude * attitude[-1].inv()).magnitude())


def sculling_error(made: Increments, taken: Increments, rate_hz: float, periods: int = 1) -> float:
    """Return the error of velocity (m/s) after rocking about x, shaken along y in phase.

    The attitude is Rx(A sin W t) and the specific force (0, B sin W t, 0): the mean acceleration
    along z is B J1(A), and that along y vanishes over a period.
    """
    dt, count = 1.0 / rate_hz, round(periods * rate_hz)
    t = dt * np.arange(-LEAD, count + 1)
    rock = ROCK * np.sin(TURN * t)
    attitude = Rotation.from_euler("X", rock[:, None])
    zero = np.zeros(len(t) - 1)
    if made is COMPENSATED:
        pushes = [_push(a, b) for a, b in pairwise(t)]
        body = attitude[:-1].inv().apply(pushes)
        forces, rates = held(attitude[:-1].inv() * attitude[1:], body, dt)
    elif made is AVERAGED:
        forces = np.column_stack([zero, -SHAKE / TURN * np.diff(np.cos(TURN * t)) / dt, zero])
        rates = np.column_stack([np.diff(rock) / dt, zero, zero])
    else:
        forces = np.column_stack([zero, SHAKE * np.sin(TURN * t[1:]), zero])
        rates = np.column_stack([ROCK * TURN * np.cos(TURN * t[1:]), zero, zero])
    w = run(taken, attitude[LEAD], dt, forces, rates)
    truth = [0.0, 0.0, (SHAKE * j1(ROCK) - GRAVITY) * periods]
    return float(np.abs(w[lay.VEL : lay.VEL + 3] - truth).max())


def _push(start: float, end: float) -> np.ndarray:
    """Return the change of velocity (3,) m/s without gravity from ``start`` to ``end`` s."""

    def force(t: float) -> np.ndarray:
        angle, size = ROCK * math.sin(TURN * t), SHAKE * math.sin(TURN * t)
        return np.array([0.0, math.cos(angle), math.sin(angle)]) * size

    return quad_vec(force, start, end, epsabs=1e-15, epsrel=1e-14)[0]


def test_compensated_increments_of_a_cone_give_the_attitude_to_the_last_digits():
    assert coning_error(COMPENSATED, COMPENSATED, 60.0, periods=10) < 1e-13


def test_compensated_increments_of_sculling_give_the_velocity_to_the_last_digits():
    assert sculling_error(COMPENSATED, COMPENSATED, 60.0, periods=2) < 1e-12


@pytest.mark.parametrize("kind", [AVERAGED, SAMPLED])
def test_the_two_sample_terms_give_attitude_and_velocity_to_a_millionth(kind):
    assert coning_error(kind, kind, 200.0) < 1e-6
    assert sculling_error(kind, kind, 200.0) < 1e-6


@pytest.mark.parametrize("kind", [AVERAGED, SAMPLED])
def test_what_the_two_sample_terms_leave_of_a_cone_is_of_fourth_order(kind):
    assert coning_error(kind, kind, 100.0) > 15.0 * coning_error(kind, kind, 200.0)


@pytest.mark.parametrize(("made", "taken"), WRONG)
@pytest.mark.parametrize("error", [coning_error, sculling_error])
def test_samples_taken_for_another_kind_leave_an_error_far_beyond_that_of_their_own(
    error, made, taken
):
    right, wrong = error(made, made, 200.0), error(made, taken, 200.0)
    assert wrong > 2e-6
    assert wrong > 100.0 * right


def test_compensated_increments_taken_for_means_turn_by_the_coning_term_once_more():
    """Each sample adds alpha x alpha' / 12, of size (W dt tilt)^2 sin(W dt), about the cone."""
    rate_hz = 60.0
    step = TURN / rate_hz
    once_more = rate_hz * (step * math.sin(TILT)) ** 2 * math.sin(step) / 12.0
    assert coning_error(COMPENSATED, AVERAGED, rate_hz) == pytest.approx(once_more, rel=0.02)


def test_a_gap_begins_sampled_values_anew_without_a_trapezoid_across_it():
    w = run(SAMPLED, Rotation.identity(), 0.01, np.zeros((3, 3)), np.tile([0.0, 0.0, 5.0], (3, 1)))
    w[lay.FOLLOWS] = 0.0
    before = Rotation.from_matrix(w[lay.ROT : lay.ROT + 9].reshape(3, 3))
    w[SAMPLE + 3 : SAMPLE + 6] = [0.0, 0.0, 1.0]
    mechanize(w, 0, 0.01, SAMPLE)
    after = Rotation.from_matrix(w[lay.ROT : lay.ROT + 9].reshape(3, 3))
    assert (before.inv() * after).as_rotvec() == pytest.approx([0.0, 0.0, 0.01])
