"""Bringing the separation of the feet to a given distance: the solvers behind the methods.

Liu et al. 2023, eqs (13)-(23).  The constraint sees only r, left minus right position, so every
solution is a direction and an innovation along it: the caller updates with that one row.
"""

from __future__ import annotations

import math

LEAST_VARIANCE = 1e-12  # m^2; a distance that is known better is not corrected
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

    ``r`` (3,) m with |r| > c0 is the estimated separation, ``p`` (3, 3) m^2 its covariance.  A
    hard c0 that the uncertain directions cannot reach gives a zero row: nothing is done.
    """
    variances, axes = principal_axes(p)
    along = [dot(axis, r) for axis in axes]
    mu = solve_multiplier(along, variances, c0, std)
    if mu is None:
        return [0.0, 0.0, 0.0], 0.0, 1.0
    at = damped(along, variances, mu)
    length = norm(at)
    s = sum(v * (x / length) ** 2 for v, x in zip(variances, at, strict=True)) + std * std
    direction = [sum(at[k] * axes[k][i] for k in range(3)) / length for i in range(3)]
    return direction, mu * length * s, std * std


def solve_multiplier(r: Vector, variances: Vector, c0: float, std: float) -> float | None:
    """Solve |(I + mu P)^-1 r| (1 - mu s^2) = c0 for mu >= 0, in the principal axes of P.

    The left side falls monotonically from |r| > c0, so a bracket and Newton steps kept inside it
    always end.  None when a hard c0 is out of reach: too much of r is along certain axes.
    """
    noise = std * std
    stuck = norm([x if v == 0.0 else 0.0 for x, v in zip(r, variances, strict=True)])
    if noise == 0.0 and stuck >= c0:
        return None
    low, high = 0.0, 1.0 / noise if noise > 0.0 else math.inf
    mu = min((norm(r) - c0) / (c0 * max(*variances, 1e-15)), 0.5 * high)
    for _ in range(200):
        at = damped(r, variances, mu)
        length = norm(at)
        value = length * (1.0 - mu * noise) - c0
        if abs(value) <= 1e-14 * c0:
            break
        low, high = (mu, high) if value > 0.0 else (low, mu)
        terms = zip(variances, at, strict=True)
        fall = sum(v * x * x / (1.0 + mu * v) for v, x in terms) / length
        slope = fall * (1.0 - mu * noise) + length * noise
        step = mu + value / slope if slope > 0.0 else math.inf
        previous = mu
        between = 2.0 * mu if high == math.inf else 0.5 * (low + high)
        mu = step if low < step < high else between
        if mu == previous:
            break
    return mu


def damped(r: Vector, variances: Vector, mu: float) -> Vector:
    """Return (I + mu P)^-1 r in the principal axes of P."""
    return [x / (1.0 + mu * v) for x, v in zip(r, variances, strict=True)]


def principal_axes(p: Matrix) -> tuple[Vector, Matrix]:
    """Return the variances (3,) along the principal axes of ``p`` and the axes, one a row.

    Jacobi's rotations; what is negligible against the greatest variance is zero.
    """
    a = [list(row) for row in p]
    axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    for _ in range(10):
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if abs(a[i][j]) > 1e-18 * (abs(a[i][i]) + abs(a[j][j])):
                rotate(a, axes, i, j)
    variances = [a[i][i] for i in range(3)]
    least = 1e-12 * max(variances)
    return [v if v > least else 0.0 for v in variances], axes


def rotate(a: Matrix, axes: Matrix, i: int, j: int) -> None:
    """Rotate ``a`` (3, 3) in place so that its element (i, j) vanishes, and ``axes`` with it."""
    theta = 0.5 * (a[j][j] - a[i][i]) / a[i][j]
    t = math.copysign(1.0, theta) / (abs(theta) + math.sqrt(theta * theta + 1.0))
    c = 1.0 / math.sqrt(t * t + 1.0)
    s = t * c
    for row in a:
        row[i], row[j] = c * row[i] - s * row[j], s * row[i] + c * row[j]
    for rows in (a, axes):
        first, second = rows[i], rows[j]
        rows[i] = [c * x - s * y for x, y in zip(first, second, strict=True)]
        rows[j] = [s * x + c * y for x, y in zip(first, second, strict=True)]


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
