"""The output of an ideal sensor: specific force and angular rate of each interval, by kind.

A sample is stamped at the *end* of its interval.  Means are taken by Gauss-Legendre quadrature on
the exact motion.  A compensating device integrates such means of a faster clock of its own, coning
and sculling included, and gives what would turn and push as much if it were held constant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core import FloatArray, Increments
from .shoe import ShoeMotion

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

PANEL_S = 0.006
CHUNK = 20_000
SMALL_RAD = 1e-2  # below which a series is exact
INNER_HZ = 800.0  # least rate of the clock inside a compensating device, as in the Xsens DOT


def sensed(
    motion: ShoeMotion,
    lever: FloatArray,
    mounting: FloatArray,
    edges_s: FloatArray,
    kind: Increments,
) -> tuple[FloatArray, FloatArray]:
    """Return force (N, 3) m/s^2 and rate (N, 3) rad/s of ``kind`` between N + 1 ``edges_s``."""
    if kind is Increments.AVERAGED:
        return interval_means(motion, lever, mounting, edges_s)
    if kind is Increments.SAMPLED:
        return motion.sensed(edges_s[1:], lever, mounting)
    return compensated_values(motion, lever, mounting, edges_s)


def compensated_values(
    motion: ShoeMotion, lever: FloatArray, mounting: FloatArray, edges_s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return force and rate (N, 3) that, held over each interval, give its compensated increments.

    Strapdown integration at the inner clock with the two-sample terms, then its inverse.
    """
    from scipy.spatial.transform import Rotation

    interval = np.diff(edges_s)
    parts = int(np.ceil(float(interval.max()) * INNER_HZ))
    inner = edges_s[:-1, None] + interval[:, None] * np.arange(parts) / parts
    inner_edges = np.append(inner.ravel(), edges_s[-1])
    force, rate = interval_means(motion, lever, mounting, inner_edges)
    alpha, gamma = _two_sample(force, rate, np.diff(inner_edges)[:, None])
    shape = len(interval), parts, 3
    alpha, gamma = alpha.reshape(shape), gamma.reshape(shape)
    turn, push = Rotation.identity(len(interval)), np.zeros((len(interval), 3))
    for part in range(parts):
        push = push + turn.apply(gamma[:, part])
        turn = _composed(turn, Rotation.from_rotvec(alpha[:, part]))
    held = turn.as_rotvec()
    return _held_force(held, push) / interval[:, None], held / interval[:, None]


def _composed(first: Rotation, second: Rotation) -> Rotation:
    """Return ``first * second`` of SciPy to the bit, in a sixth of its time."""
    px, py, pz, pw = np.ascontiguousarray(first.as_quat().T)
    qx, qy, qz, qw = np.ascontiguousarray(second.as_quat().T)
    x = pw * qx + qw * px + (py * qz - pz * qy)
    y = pw * qy + qw * py + (pz * qx - px * qz)
    z = pw * qz + qw * pz + (px * qy - py * qx)
    w = pw * qw - px * qx - py * qy - pz * qz
    return type(first).from_quat(np.column_stack([x, y, z, w]))


def _two_sample(
    force: FloatArray, rate: FloatArray, dt: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return rotation (N, 3) rad and push (N, 3) m/s of each inner interval, eqs (1) and (2)."""
    alpha, gamma = rate * dt, force * dt
    alpha_before, gamma_before = (np.vstack([x[:1], x[:-1]]) for x in (alpha, gamma))
    rotation = alpha + np.cross(alpha_before, alpha) / 12.0
    across = np.cross(alpha_before, gamma) + np.cross(gamma_before, alpha)
    return rotation, gamma + 0.5 * np.cross(alpha, gamma) + across / 12.0


def _held_force(alpha: FloatArray, push: FloatArray) -> FloatArray:
    """Return (N, 3) m/s of force that pushes by ``push`` while the body turns by ``alpha`` rad.

    The inverse of v = gamma + b alpha x gamma + c alpha x (alpha x gamma), which is
    gamma = v - alpha x v / 2 + e alpha x (alpha x v), e = (1 - (a / 2) cot(a / 2)) / a^2.
    """
    half = 0.5 * np.linalg.norm(alpha, axis=1, keepdims=True)
    safe = np.maximum(half, 1e-3)
    near = (1.0 + half**2 / 15.0) / 12.0
    e = np.where(half < SMALL_RAD, near, (1.0 - safe / np.tan(safe)) / (4.0 * safe**2))
    across = np.cross(alpha, push)
    force: FloatArray = push - 0.5 * across + e * np.cross(alpha, across)
    return force


def interval_means(
    motion: ShoeMotion, lever: FloatArray, mounting: FloatArray, edges_s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return mean specific force (N, 3) m/s^2 and rate (N, 3) rad/s between N + 1 ``edges_s``."""
    widest = float(np.diff(edges_s).max())
    offsets, weights = _panels(max(1, int(np.ceil(widest / PANEL_S))))
    force: list[FloatArray] = []
    rate: list[FloatArray] = []
    for first in range(0, len(edges_s) - 1, CHUNK):
        edges = edges_s[first : first + CHUNK + 1]
        nodes = edges[:-1, None] + np.diff(edges)[:, None] * offsets
        values = motion.sensed(nodes.ravel(), lever, mounting)
        for means, value in zip((force, rate), values, strict=True):
            means.append(np.einsum("k,nki->ni", weights, value.reshape(*nodes.shape, 3)))
    return np.concatenate(force), np.concatenate(rate)


def _panels(count: int) -> tuple[FloatArray, FloatArray]:
    """Return nodes in [0, 1] and weights (sum 1) of ``count`` three-point Gauss panels."""
    node, weight = np.polynomial.legendre.leggauss(3)
    starts = np.arange(count)[:, None]
    nodes = (starts + 0.5 * (node + 1.0)) / count
    return nodes.ravel(), np.tile(0.5 * weight / count, count)
