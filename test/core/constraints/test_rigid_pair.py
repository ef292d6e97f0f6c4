"""Two sensors on one shoe: the linear Kalman filter of Chen et al. 2022, and its use."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig
from dualfoot_ros.core.constraints.rigid_pair import RigidPair, RigidPairConfig
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import (
    SensorConfig,
    WalkConfig,
    grade,
    rigid_pair,
    simulate,
    walk,
)

from ..dense import DenseFoot
from ..harness import Pairs, follow, open_session
from ..kernel.states import nominal, put_error, random_workspace, set_covariance
from .joint import JointEstimate, MadeUpGait, error_taken, interpreted, states

APART = 0.014
QUIET = {"route": "rectangle", "rate": 60.0, "standing": 4.0, "final_standing": 1.0}
NO_TREMOR = {**QUIET, "gait": {"tremor": 0.0, "sway": 0.0}}
KNOWN_ATTITUDE = {
    "noise": {"gyro": 0.0, "gyro_bias": 0.0, "accelerometer_bias": 0.0, "bias_time": 1e9},
    "initial": {"tilt": 0.0, "yaw": 0.0, "gyro_bias": 0.0, "accelerometer_bias": 0.0},
}


@cache
def board(seed: int, apart: float = APART):
    """Return a walk with both sensors on the right shoe, and the arm in the first one's axes."""
    walked = rigid_pair(walk(WalkConfig.from_mapping(NO_TREMOR), seed), apart)
    return walked, walked.mountings[0].T @ np.array([apart, 0.0, 0.0])


def white_noise() -> SensorConfig:
    """Return a sensor with white noise and no other error."""
    zero = {s.name: 0.0 for s in SensorConfig.specs() if s.minimum == 0.0}
    return SensorConfig.from_mapping({**zero, "gyro_noise": 1e-3, "accelerometer_noise": 0.01})


# --- the filter of the paper, from eqs (14)-(22) alone ---

I3, O3 = np.eye(3), np.zeros((3, 3))


class LinearFilter:
    """x = (r1, r2, v1, v2), eq. (16); P, Q and R in full; attitude is none of its states."""

    def __init__(self, x, P, config: TrackerConfig) -> None:
        pair, self.zupt_std = config.constraint, config.zupt.std
        self.x, self.P = x, P
        self.force_variance = config.noise.accelerometer**2
        self.stds = [pair.velocity_std] * 3 + [pair.position_std] * 3

    def predict(self, u1, u2, dt: float) -> None:
        """Predict x = F x + B u, eqs (14), (17), and P^- of eq. (21); ``u`` (3,) m/s^2."""
        F = np.eye(12)
        F[:6, 6:] = dt * np.eye(6)
        B = np.vstack([0.5 * dt**2 * np.eye(6), dt * np.eye(6)])
        Q = np.diag([0.0] * 6 + [self.force_variance] * 6) * dt
        self.x = F @ self.x + B @ np.concatenate([u1, u2])
        self.P = F @ (self.P + 0.5 * Q) @ F.T + 0.5 * Q

    def correct(self, R1, omega, m, still: tuple[bool, bool]) -> None:
        """Eqs (18)-(20), (22), and eq. (21) with the inverse that is missing in print."""
        H = [np.hstack([O3, O3, -I3, I3]), np.hstack([-I3, I3, O3, O3])]
        Z = [np.cross(R1 @ omega, R1 @ m), R1 @ m]
        stds = list(self.stds)
        for sensor in range(2):
            if still[sensor]:
                H.append(np.hstack([O3, O3, I3 * (sensor == 0), I3 * (sensor == 1)]))
                Z.append(np.zeros(3))
                stds += [self.zupt_std] * 3
        H, Z, R = np.vstack(H), np.concatenate(Z), np.diag(np.square(stds))
        K = self.P @ H.T @ np.linalg.inv(H @ self.P @ H.T + R)
        self.x = self.x + K @ (Z - H @ self.x)
        self.P = (np.eye(12) - K @ H) @ self.P


def accelerations(feet, x, dt, values):
    """Propagate both feet from the velocities of ``x``; return what ``values`` do to them."""
    u = []
    for i, foot in enumerate(feet):
        before = x[6 + 3 * i : 9 + 3 * i]
        foot.v = before
        foot.propagate(dt, values[6 * i : 6 * i + 6])
        u.append((foot.v - before) / dt)
    return u


def test_with_known_attitude_it_is_the_papers_linear_filter():
    walked, arm = board(1)
    made = simulate(walked, grade("consumer"), seed=1)
    pairs = Pairs(made.left.stamp_ns, stack_pairs(made.left, made.right))[:750]
    config = TrackerConfig.from_mapping(
        {
            **KNOWN_ATTITUDE,
            "method": "rigid_pair",
            "rigid_pair.lever_arm": arm.tolist(),
            "heading.source": "sensor",
            "zupt": {
                "lever_arm": 0.0,
                "lever_back": 0.0,
                "rate_std": 0.0,
                "still_after": 1e6,
                "std_rate": 0.0,
            },
            "stance": {"min_stance": 0.0, "min_swing": 0.0},
        }
    )
    session, start = open_session(config, pairs)
    session._walk.phase = "walking"
    P = np.diag(np.tile(np.repeat([4e-4, 1e-4, 0.0, 0.0, 0.0], 3), 2))
    set_covariance(session.space, P)
    w = session.space.w
    feet = [DenseFoot.start(config, w, foot) for foot in range(2)]
    order = np.concatenate([s + np.arange(3) for s in (0, 15, 3, 18)])
    x = np.concatenate([feet[0].r, feet[1].r, feet[0].v, feet[1].v])
    ours = LinearFilter(x, P[np.ix_(order, order)], config)
    rates = [np.zeros(3), np.zeros(3)]
    moved = swings = 0
    for epoch, _ in follow(session, pairs, start):
        k, dt = start + epoch, pairs.dts[start + epoch]
        ours.predict(*accelerations(feet, ours.x, dt, pairs.values[k]), dt)
        flags = int(session.space.n[lay.N_FLAGS + epoch % session.space.ring])
        ends = [
            f.rate + 0.5 * (f.rate - r) * (epoch > 0) for f, r in zip(feet, rates, strict=True)
        ]
        rates = [f.rate for f in feet]
        ours.correct(feet[0].C, np.mean(ends, axis=0), arm, (bool(flags & 1), bool(flags & 2)))
        swings += flags == 0
        found = np.concatenate([nominal(w, f)[s] for s in (0, 1) for f in (0, 1)])
        assert np.abs(found - ours.x).max() < 1e-8
        moved = max(moved, float(np.abs(found[:3] - x[:3]).max()))
    assert swings > 100 and moved > 2.0
    stds = np.sqrt(np.diag(ours.P))
    found = session.space.covariance()[np.ix_(order, order)]
    assert np.abs((found - ours.P) / np.outer(stds, stds)).max() < 1e-6


# --- the rows, where attitude and bias are uncertain ---


def innovations(space, gait, method) -> np.ndarray:
    """Return both innovations (6,) in the state of ``space``, which is left as it was."""
    kept = space.w.copy()
    set_covariance(space, np.zeros((30, 30)))
    outcome = method.apply(JointEstimate(space, interpreted()), gait, 1, [np.zeros(3)] * 2)
    space.w[:] = kept
    return np.concatenate([outcome.detail["velocity_innovation"], outcome.innovation])


@pytest.mark.parametrize("same_axes", (True, False))
def test_the_rows_are_the_derivatives_of_the_innovations(same_axes):
    """Numerically; one error state at a time has variance, so that the gain shows its row."""
    method = RigidPair(RigidPairConfig(lever_arm=(0.3, -0.2, 0.1)))
    rng, step = np.random.default_rng(2), 1e-6
    space = random_workspace(2)
    if same_axes:
        space.w[lay.FOOT + lay.ROT :][:9] = space.w[lay.ROT :][:9]
    raw = rng.normal(size=(2, 2, 6))

    class Gait(MadeUpGait):
        def sample(self, foot, epoch):
            values = self.samples[foot, epoch].copy()
            values[3:] -= space.w[foot * lay.FOOT + lay.BG :][:3]
            return values

    gait = Gait(np.zeros((2, 2), dtype=bool), samples=raw)
    base = innovations(space, gait, method)
    for state in range(30):
        kept = space.w.copy()
        error = np.zeros(15)
        error[state % 15] = step
        put_error(space.w, state // 15, error)
        slope = (innovations(space, gait, method) - base) / step
        space.w[:] = kept
        P = np.zeros((30, 30))
        P[state, state] = 1e-10
        set_covariance(space, P)
        before = states(space)
        method.apply(JointEstimate(space, interpreted()), gait, 1, [np.zeros(3)] * 2)
        # two sequential updates of one state: the information form of a scalar Kalman update
        noise = np.repeat([method.config.velocity_std**2, method.config.position_std**2], 3)
        information = slope**2 / noise
        expected = float(slope / noise @ base) / (1e10 + information.sum())
        taken = error_taken(before, space)
        assert taken[state] == pytest.approx(expected, rel=1e-4, abs=1e-13), state
        space.w[:] = kept


def test_sensors_with_other_axes_are_told_apart():
    """Their rates are in different axes and cannot be averaged; the first one's are used."""
    space = random_workspace(3)
    estimate = JointEstimate(space, interpreted())
    space.w[lay.FOOT + lay.ROT :][:9] = space.w[lay.ROT :][:9]
    assert RigidPair(RigidPairConfig())._same_axes(estimate)
    turned = Rotation.from_rotvec([0.0, 0.0, 0.3]).as_matrix()
    space.w[lay.FOOT + lay.ROT :][:9] = (estimate.rotation(0) @ turned).ravel()
    assert not RigidPair(RigidPairConfig())._same_axes(estimate)


# --- recordings ---


def run(made, arm, method: str):
    config = {"method": method, "rigid_pair.lever_arm": arm.tolist()}
    return DualFootTracker(TrackerConfig.from_mapping(config)).run(made.left, made.right)


@cache
def noisy_and_clean(seed: int):
    """Return a walk with white noise only and without any, and the arm."""
    walked, arm = board(seed)
    sensors = white_noise(), grade("ideal")
    return [simulate(walked, sensor, seed=seed) for sensor in sensors], arm


def deviations(seed: int, method: str) -> list[float]:
    """Return what white noise does to each sensor's track: RMS (m) against the same without."""
    made, arm = noisy_and_clean(seed)
    noisy, clean = (run(each, arm, method) for each in made)
    stamps = np.intersect1d(noisy.left.stamp_ns, clean.left.stamp_ns)
    found = []
    for a, b in ((noisy.left, clean.left), (noisy.right, clean.right)):
        rows = [np.searchsorted(foot.stamp_ns, stamps) for foot in (a, b)]
        apart = np.linalg.norm(a.position[rows[0]] - b.position[rows[1]], axis=1)
        found.append(float(np.sqrt(np.mean(apart**2))))
    return found


def test_two_sensors_suffer_less_from_noise_than_one():
    single = np.concatenate([deviations(seed, "zupt") for seed in range(2)])
    paired = np.concatenate([deviations(seed, "rigid_pair") for seed in range(2)])
    assert np.sqrt(np.mean(paired**2)) < 0.95 * np.sqrt(np.mean(single**2))


@pytest.mark.parametrize("apart", (APART, 0.10))
def test_the_sensors_stay_the_lever_arm_apart_on_a_walk_and_share_one_heading(apart):
    walked, arm = board(2, apart)
    made = simulate(walked, grade("consumer"), seed=2)
    found = run(made, arm, "rigid_pair")
    walking = found.left.stamp_ns > found.of_kind(EventKind.HEADING)[-1].stamp_ns
    r = (found.left.position - found.right.position)[walking]
    assert np.abs(np.linalg.norm(r, axis=1) - apart).max() < 0.03
    free = run(made, arm, "zupt")
    end = [np.linalg.norm(f.left.position[-1] - f.right.position[-1]) for f in (found, free)]
    assert abs(end[0] - apart) < 0.01 < 0.2 * end[1]
