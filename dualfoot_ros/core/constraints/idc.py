"""``idc``: minimum-distance moment detection and iterative distance constraint.

Liu et al. 2023, sections III-D and IV-C, Algorithm 1 ("Our_04").  When a stance has ended, the
minimum-distance moment is t_min = (1 - kappa) t_fst + kappa t_end, eq. (31).  If the estimated
distance at that moment exceeds c0, the state is projected onto |r| = c0, r = left minus right.

Two solvers:

``iterative``  eq. (22), at most five linearisations, the iterate with the least cost eq. (14)
    wins.  With r as the only part of the state the constraint sees, A_l = 2 r_l', b_l =
    |r_l|^2 + c0^2, and eq. (14) is (A_l x - b_l)^2 / (A_l P A_l').  It is a fixed-point
    iteration that need not converge.
``exact``  the minimiser itself.  Stationarity of eqs (14), (15) gives r = (I + mu P_r)^-1 r_0
    with |r| = c0, one monotone equation in mu; the state moves by -mu P_xr r.

With ``distance_std`` s > 0 the distance is a measurement, not a truth: the exact solver then
minimises eq. (14) plus (|r| - c0)^2 / s^2, which changes the equation to |r| (1 - mu s^2) = c0.
The covariance is eq. (23), a rank-1 downdate along the final r.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..estimate import JointEstimate, Outcome, relative_row
from ..parameters import Parameters, parameter
from .method import Gait, Request, StancePhase

Vector = list[float]
Matrix = list[list[float]]


@dataclass(frozen=True)
class Config(Parameters):
    """Parameters of the minimum-distance constraint."""

    distance: float = parameter(
        0.15, "minimum distance c0 of the two sensors", unit="m", minimum=0.01, maximum=1.0
    )
    distance_std: float = parameter(
        0.1,
        "scatter of that distance (0: the paper's hard constraint)",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    kappa: float = parameter(
        0.55, "minimum-distance moment as a share of the stance", minimum=0.0, maximum=1.0
    )
    solver: str = parameter(
        "exact", "the minimiser or the paper's iteration", choices=("exact", "iterative")
    )
    iterations: int = parameter(5, "iterations of the iterative solver", minimum=1, maximum=50)
    apply_at: str = parameter(
        "moment",
        "at the moment itself (roll back, apply, re-run) or when it is detected",
        choices=("moment", "detection"),
    )
    max_stance: float = parameter(
        1.2, "a longer stance is no step", unit="s", minimum=0.2, maximum=3.0
    )


class Method:
    """Asks for one distance constraint after each stance of a walking person."""

    def __init__(self, config: Config) -> None:
        """Use ``config``."""
        self._config = config

    @property
    def memory_s(self) -> float:
        """How far back a constraint may reach from the end of a stance, s."""
        return (1.0 - self._config.kappa) * self._config.max_stance

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Request | None:
        """Return the constraint at the minimum-distance moment of ``stance``, if it is a step."""
        moment = stance.moment(self._config.kappa)
        is_step = stance.duration_s <= self._config.max_stance
        if not (is_step and gait.remembers(moment)) or gait.in_stance(1 - stance.foot, moment):
            return None
        if self._config.apply_at == "moment":
            return Request(moment, True, self._apply)
        left, right = gait.positions_after(moment)
        separation = [float(x) for x in left - right]
        return Request(moment, False, lambda estimate: self._apply(estimate, separation))

    def _apply(self, estimate: JointEstimate, separation: Vector | None = None) -> Outcome:
        """Constrain ``estimate``; ``separation`` is r at the moment when it is applied later."""
        config = self._config
        r = separation or estimate.relative_position()
        p = estimate.relative_covariance()
        distance = norm(r)
        variance = quadratic(r, p) / distance**2 if distance > 0.0 else 0.0
        s = variance + config.distance_std**2
        error = distance - config.distance
        measured = (np.array([error]), np.array([[s]]), error * error / s if s > 0.0 else math.nan)
        detail = {"distance": distance, "target": config.distance}
        if error <= 0.0 or variance <= 1e-12:
            reason = "distance within c0" if error <= 0.0 else "no uncertainty"
            return Outcome(*measured, accepted=False, detail={**detail, "reason": reason})
        solve = exact if config.solver == "exact" else self._iterate
        direction, push, noise = solve(r, p, config.distance, config.distance_std)
        estimate.update([relative_row(direction)], [push], [noise])
        after = norm(estimate.relative_position())
        return Outcome(*measured, detail={**detail, "distance_after": after})

    def _iterate(self, r: Vector, p: Matrix, c0: float, std: float) -> tuple[Vector, float, float]:
        return iterate(r, p, c0, std, self._config.iterations)


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
