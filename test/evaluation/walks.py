"""Walks made by formula: both feet step in turn along a route, with known stances and truth."""

from __future__ import annotations

import numpy as np

from dualfoot_ros.core.results.events import Event, EventKind
from dualfoot_ros.core.results.trajectory import FootTrajectory, Trajectory
from dualfoot_ros.core.samples.series import PoseSeries

RATE = 50
STEP_S = 0.6
SPACING = 0.2


def straight(strides: int = 20, length: float = 1.2) -> tuple[PoseSeries, PoseSeries, np.ndarray]:
    """Return truth of both feet along x, left at y = +0.1, and the (2, N) stances."""
    return along(np.column_stack([np.arange(strides + 1) * length, np.zeros(strides + 1)]))


def along(points: np.ndarray) -> tuple[PoseSeries, PoseSeries, np.ndarray]:
    """Return truth and stances of two feet that walk along the (K, 2) points, left foot first.

    The right foot stands beside every point, the left foot half-way between two of them, so that
    each foot passes the other in the middle of its swing, ``SPACING`` apart.
    """
    count = len(points)
    middles = np.arange(count - 1) + 0.5
    left = np.concatenate([[0.0], middles, [count - 1.0]])
    right = np.arange(float(count))
    feet = [
        _steps(points, stops, side, first)
        for stops, side, first in ((left, SPACING / 2, 0), (right, -SPACING / 2, 1))
    ]
    return feet[0][0], feet[1][0], np.array([stance for _, stance in feet])


def _steps(points, stops, beside, first) -> tuple[PoseSeries, np.ndarray]:
    """Swing smoothly from stop to stop (in points along the route) in every second step."""
    half = int(STEP_S * RATE)
    s = np.arange(half) / half
    s = s - np.sin(2 * np.pi * s) / (2 * np.pi)
    phases, at = [np.zeros(half)], 0
    for step in range(2 * len(points) - 1):
        swings = step % 2 == first
        phases.append(at + s if swings else np.full(half, float(at)))
        at += swings
    phase = np.concatenate([*phases, np.full(half, float(at))])
    along_route = np.interp(phase, np.arange(len(stops)), stops)
    xyz, psi = _route(points, along_route, beside)
    stamps = 1_700_000_000_000_000_000 + np.arange(len(xyz)) * (1_000_000_000 // RATE)
    velocity = np.gradient(xyz, 1 / RATE, axis=0)
    return PoseSeries(stamps, xyz, yaw_quaternion(psi), velocity), phase == np.round(phase)


def _route(points, u, beside) -> tuple[np.ndarray, np.ndarray]:
    """Return (N, 3) positions beside the route and headings that turn half at each point."""
    legs = np.diff(points, axis=0)
    yaw = np.unwrap(np.arctan2(legs[:, 1], legs[:, 0]))
    psi = np.interp(u, np.arange(len(legs)) + 0.5, yaw)
    side = beside * np.column_stack([-np.sin(psi), np.cos(psi)])
    xy = np.column_stack([np.interp(u, np.arange(len(points)), c) for c in points.T]) + side
    return np.column_stack([xy, np.zeros(len(xy))]), psi


def rectangle() -> np.ndarray:
    """Return the 21 corners and stops of a closed 2.4 m x 9.6 m rectangle, 1.2 m apart."""
    up = [(0.0, 1.2 * k) for k in range(9)]
    top = [(-1.2, 9.6), (-2.4, 9.6)]
    down = [(-2.4, 9.6 - 1.2 * k) for k in range(1, 9)]
    return np.array([*up, *top, *down, (-1.2, 0.0), (0.0, 0.0)])


def yaw_quaternion(yaw: np.ndarray) -> np.ndarray:
    """Return (N, 4) quaternions that turn about z."""
    zero = np.zeros_like(yaw)
    return np.column_stack([zero, zero, np.sin(yaw / 2), np.cos(yaw / 2)])


def foot(truth: PoseSeries, stance: np.ndarray, std: float = 0.1) -> FootTrajectory:
    """Return an estimate that equals the truth, with isotropic covariances of ``std``."""
    covariance = np.repeat([np.eye(3) * std**2], len(truth), axis=0)
    return FootTrajectory(
        truth.stamp_ns,
        truth.position.copy(),
        truth.velocity.copy(),
        truth.quaternion.copy(),
        stance,
        *(covariance.copy() for _ in range(3)),
    )


def trajectory(left: FootTrajectory, right: FootTrajectory, moments: tuple = ()) -> Trajectory:
    """Return both feet as the result of a method, with constraints at the given stamps."""
    events = tuple(Event(EventKind.CONSTRAINT, int(t), "both", int(t)) for t in moments)
    relative = left.position_covariance + right.position_covariance
    start = int(left.stamp_ns[0])
    return Trajectory(left, right, relative, events, {"duplicate": 0}, start, "zupt")


def perfect(points: np.ndarray | None = None) -> tuple[Trajectory, tuple[PoseSeries, PoseSeries]]:
    """Return an estimate without error, and its truth."""
    left, right, stance = straight() if points is None else along(points)
    return trajectory(foot(left, stance[0]), foot(right, stance[1])), (left, right)
