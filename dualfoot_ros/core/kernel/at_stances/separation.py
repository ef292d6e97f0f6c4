"""The separation of the feet, left minus right, its covariance, and rows that measure it."""

import math

from ..layout import E_POS, FOOT, JOINT, M_P, PLL, PLR, POS, PRR, ROW, S_H, SIDE


def separation(w, x, at):
    """Write left minus right position (3,) m to ``at`` of ``x``; return its length."""
    for i in range(3):
        x[at + i] = w[POS + i] - w[FOOT + POS + i]
    return length(x, at)


def length(x, at):
    """Return the length of the vector (3,) at ``at`` of ``x``."""
    return math.sqrt(x[at] * x[at] + x[at + 1] * x[at + 1] + x[at + 2] * x[at + 2])


def separation_covariance(w, x):
    """Write the covariance (3, 3) m^2 of the separation to M_P of ``x``."""
    for i in range(3):
        for j in range(3):
            a = ROW * i + j
            x[M_P + 3 * i + j] = w[PLL + a] + w[PRR + a] - w[PLR + a] - w[PLR + ROW * j + i]


def put_relative_row(w, k, a, b, c):
    """Write the row that measures the separation along (a, b, c) as row ``k`` of H."""
    h = S_H + JOINT * k
    for j in range(JOINT):
        w[h + j] = 0.0
    w[h + E_POS] = a
    w[h + E_POS + 1] = b
    w[h + E_POS + 2] = c
    w[h + SIDE + E_POS] = -a
    w[h + SIDE + E_POS + 1] = -b
    w[h + SIDE + E_POS + 2] = -c
