"""Bringing the separation of the feet to a given distance: the iteration of the paper.

Liu et al. 2023, eqs (13)-(23).  The constraint sees only r, left minus right position, so every
solution is a direction and an innovation along it: the caller updates with that one row.  The
minimiser itself is `JointEstimate.closest`, which the kernel solves.
"""

from __future__ import annotations

import math

Vector = list[float]
Matrix = list[list[float]]


def iterate(
    r: Vector, p: Matrix, c0: float, std: float, iterations: int
) -> tuple[Vector, float, float]:
    """Return (direction, innovation, noise) of the least-cost iterate of eq. (22).

    ``r`` (3,) m is the estimated separation, ``p`` (3, 3) m^2 its covariance.
    """
    best: tuple[float, Vector, float, float] | None = None
    at = r
    for _ in range(iterations):
        a = [2.0 * x for x in at]
        noise = (2.0 * c0 * std) ** 2
        excess = dot(a, r) - dot(at, at) - c0 * c0  # A x - b
        s = quadratic(a, p) + noise
        if s <= 0.0:
            break
        cost = excess * excess / s  # eq. (14)
        if best is None or cost < best[0]:
            best = (cost, a, excess, noise)
        pa = times(p, a)
        at = [r[i] - pa[i] * excess / s for i in range(3)]  # eq. (22)
    if best is None:
        return [0.0, 0.0, 0.0], 0.0, 1.0
    return best[1], best[2], best[3]


def dot(a: Vector, b: Vector) -> float:
    """Return the inner product of two 3-vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(a: Vector) -> float:
    """Return the length of a 3-vector."""
    return math.sqrt(dot(a, a))


def times(m: Matrix, a: Vector) -> Vector:
    """Return the product of a 3x3 matrix and a 3-vector."""
    return [dot(row, a) for row in m]


def quadratic(a: Vector, m: Matrix) -> float:
    """Return a' M a."""
    return dot(a, times(m, a))
