"""The output of an ideal sensor: the means of specific force and angular rate over each interval.

Real inertial sensors integrate between two outputs; a sample is stamped at the *end* of its
interval.  The means are taken by Gauss-Legendre quadrature on the exact motion.
"""

from __future__ import annotations

import numpy as np

from ..core import FloatArray
from .motion import Kinematics, ShoeMotion

PANEL_S = 0.006
CHUNK = 20_000


def interval_means(
    motion: ShoeMotion, lever: FloatArray, mounting: FloatArray, edges_s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return mean specific force (N, 3) m/s^2 and rate (N, 3) rad/s between N + 1 ``edges_s``."""
    widest = float(np.diff(edges_s).max())
    offsets, weights = _panels(max(1, int(np.ceil(widest / PANEL_S))))
    force, rate = [], []
    for first in range(0, len(edges_s) - 1, CHUNK):
        edges = edges_s[first : first + CHUNK + 1]
        nodes = edges[:-1, None] + np.diff(edges)[:, None] * offsets
        moved = motion.kinematics(nodes.ravel(), lever, mounting)
        shape = (*nodes.shape, 3)
        force.append(np.einsum("k,nki->ni", weights, moved.specific_force.reshape(shape)))
        rate.append(np.einsum("k,nki->ni", weights, moved.angular_rate.reshape(shape)))
    return np.concatenate(force), np.concatenate(rate)


def states(
    motion: ShoeMotion, lever: FloatArray, mounting: FloatArray, time_s: FloatArray
) -> Kinematics:
    """Return the exact motion of the sensor at ``time_s`` (N,) s."""
    return motion.kinematics(time_s, lever, mounting)


def _panels(count: int) -> tuple[FloatArray, FloatArray]:
    """Return nodes in [0, 1] and weights (sum 1) of ``count`` three-point Gauss panels."""
    node, weight = np.polynomial.legendre.leggauss(3)
    starts = np.arange(count)[:, None]
    nodes = (starts + 0.5 * (node + 1.0)) / count
    return nodes.ravel(), np.tile(0.5 * weight / count, count)
