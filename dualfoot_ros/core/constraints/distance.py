"""Bringing the separation of the feet to a given distance: the solvers behind the methods.

Liu et al. 2023, eqs (13)-(23).  The constraint sees only r, left minus right position, so every
solution is a direction and an innovation along it: the caller updates with that one row.
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


def exact(r: Vector, p: Matrix, c0: float, std: float) -> tuple[Vector, float, float]:
    """Return (direction, innovation, noise) that move the state to the minimiser of eq. (14).

    ``r`` (3,) m with |r| > c0 is the estimated separation, ``p`` (3, 3) m^2 its covariance.
    """
    mu, at = solve_multiplier(r, p, c0, std)
    length = norm(at)
    direction = [x / length for x in at]
    s = quadratic(direction, p) + std * std
    return direction, mu * length * s, std * std


def solve_multiplier(r: Vector, p: Matrix, c0: float, std: float) -> tuple[float, Vector]:
    """Solve |(I + mu P)^-1 r| (1 - mu s^2) = c0 for mu >= 0; return mu and the separation.

    The left side falls monotonically from |r| > c0, so a bracket and Newton steps kept inside it
    always end.
    """
    variance = std * std
    low, high = 0.0, 1.0 / variance if variance > 0.0 else math.inf
    mu = min((norm(r) - c0) / (c0 * max(quadratic(r, p) / dot(r, r), 1e-15)), 0.5 * high)
    for _ in range(200):
        at = damped(r, p, mu)
        length = norm(at)
        value = length * (1.0 - mu * variance) - c0
        if abs(value) <= 1e-14 * c0:
            break
        if value > 0.0:
            low = mu
        else:
            high = mu
        slope = -dot(at, damped(times(p, at), p, mu)) / length * (1.0 - mu * variance)
        slope -= length * variance
        step = mu - value / slope if slope < 0.0 else math.inf
        inside = low < step < high
        previous = mu
        mu = step if inside else (2.0 * mu if high == math.inf else 0.5 * (low + high))
        if mu == previous:
            break
    return mu, damped(r, p, mu)


def damped(r: Vector, p: Matrix, mu: float) -> Vector:
    """Return (I + mu P)^-1 r by the adjugate of the symmetric 3x3 matrix."""
    a, b, c = 1.0 + mu * p[0][0], mu * p[0][1], mu * p[0][2]
    d, e, f = 1.0 + mu * p[1][1], mu * p[1][2], 1.0 + mu * p[2][2]
    m00, m01, m02 = d * f - e * e, c * e - b * f, b * e - c * d
    m11, m12, m22 = a * f - c * c, b * c - a * e, a * d - b * b
    det = a * m00 + b * m01 + c * m02
    return [
        (m00 * r[0] + m01 * r[1] + m02 * r[2]) / det,
        (m01 * r[0] + m11 * r[1] + m12 * r[2]) / det,
        (m02 * r[0] + m12 * r[1] + m22 * r[2]) / det,
    ]


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
