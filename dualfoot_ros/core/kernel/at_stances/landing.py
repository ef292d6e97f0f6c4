"""With what velocity a foot has landed, and how far that is from one that a landing has."""

import math

from ..layout import (
    E_VEL,
    FOOT,
    N_EPOCH,
    N_FOOT,
    N_OLDEST,
    N_RING,
    N_START,
    N_STRIDE,
    PLL,
    PRR,
    RINGS,
    ROW,
    SAMPLE,
    STATE,
    VEL,
    X_VELOCITY,
)


def landing(w, n, x, foot, std):
    """Write the velocity (3,) m/s with which ``foot`` landed to X_VELOCITY; return its NIS.

    It is that before the first zero-velocity update of the present stance, which a landing has to
    ``std`` m/s.  -1 when the ring does not reach back so far.
    """
    first = n[N_FOOT + foot * N_STRIDE + N_START]
    if first < n[N_OLDEST] or first > n[N_EPOCH]:
        return -1.0
    o = snapshot_before(n, first)
    for i in range(3):
        x[X_VELOCITY + i] = w[o + foot * FOOT + VEL + i]
    block = PLL if foot == 0 else PRR
    return nis_at(w, x, o + block + ROW * E_VEL + E_VEL, std * std)


def snapshot_before(n, epoch):
    """Return where the state before ``epoch`` is kept."""
    return RINGS + SAMPLE * n[N_RING] + STATE * (epoch % n[N_RING])


def nis_at(w, x, p, noise):
    """Return v' (P + noise)^-1 v of the velocity at X_VELOCITY, P (3, 3) being at ``p``.

    By the adjugate: the same bits everywhere.  Infinite where P is none.
    """
    a = w[p] + noise
    b = w[p + 1]
    c = w[p + 2]
    e = w[p + ROW + 1] + noise
    f = w[p + ROW + 2]
    i = w[p + 2 * ROW + 2] + noise
    first = e * i - f * f
    second = c * f - b * i
    third = b * f - c * e
    determinant = a * first + b * second + c * third
    u = x[X_VELOCITY]
    v = x[X_VELOCITY + 1]
    z = x[X_VELOCITY + 2]
    total = first * u * u + (a * i - c * c) * v * v + (a * e - b * b) * z * z
    total += 2.0 * (second * u * v + third * u * z + (b * c - a * f) * v * z)
    return total / determinant if determinant > 0.0 else math.inf
