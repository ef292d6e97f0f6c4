"""P_cc X = P_c H' of the considered states, solved in groups of four of them.

A group is eliminated within itself number by number, and from everything else four columns at
once.  Elements take the same operations in the same order as in a plain elimination row by row.
"""

import math

from ..layout import ROW_CC, S_CC, X_CC, lanes

TOGETHER = 4  # considered states that are taken at once
LEAST_PIVOT = 1e-18  # a variance below it is none: the state is known already


def solve_known(w, size):
    """Solve P_cc X = P_c H' in place of the rows [P_cc, P_c H'] at S_CC, by P_cc = U' U.

    A pivot that is none gives zeros.  The diagonal of U is left as what it divides by, inverted.
    ``size`` is a multiple of TOGETHER.
    """
    for g in range(0, size, TOGETHER):
        row = S_CC + ROW_CC * g
        factor_group(w, row + g)
        divide_columns(w, row + g, X_CC - g)
        for h in range(g + TOGETHER, size, TOGETHER):
            divide_columns(w, row + g, h - g)
        for h in range(g + TOGETHER, size, TOGETHER):
            below = S_CC + ROW_CC * h
            subtract_group(w, row + h, row + X_CC, below + X_CC)
            for j in range(h, size, TOGETHER):
                subtract_group(w, row + h, row + j, below + j)
    for i in range(size):
        solve_row(w, size, size - 1 - i)


def inverse_root(variance, least):
    """Return one over the root of a variance; zero where it is none: not above ``least``."""
    return 1.0 / math.sqrt(variance) if variance > least else 0.0


def factor_group(w, p):
    """Factor the symmetric 4x4 at ``p``, of which the upper triangle counts, into U' U."""
    s0 = inverse_root(w[p], LEAST_PIVOT)
    a1, a2, a3 = w[p + 1] * s0, w[p + 2] * s0, w[p + 3] * s0
    q = p + ROW_CC
    s1 = inverse_root(w[q + 1] - a1 * a1, LEAST_PIVOT)
    b2, b3 = (w[q + 2] - a1 * a2) * s1, (w[q + 3] - a1 * a3) * s1
    q += ROW_CC
    s2 = inverse_root(w[q + 2] - a2 * a2 - b2 * b2, LEAST_PIVOT)
    c3 = (w[q + 3] - a2 * a3 - b2 * b3) * s2
    q += ROW_CC
    s3 = inverse_root(w[q + 3] - a3 * a3 - b3 * b3 - c3 * c3, LEAST_PIVOT)
    w[p], w[p + 1], w[p + 2], w[p + 3] = s0, a1, a2, a3
    p += ROW_CC
    w[p + 1], w[p + 2], w[p + 3] = s1, b2, b3
    p += ROW_CC
    w[p + 2], w[p + 3] = s2, c3
    w[p + ROW_CC + 3] = s3


def divide_columns(w, p, ahead):
    """Divide four columns, ``ahead`` of the factored group at ``p``, by its U'."""
    s0, a1, a2, a3 = w[p], w[p + 1], w[p + 2], w[p + 3]
    q = p + ROW_CC
    s1, b2, b3 = w[q + 1], w[q + 2], w[q + 3]
    q += ROW_CC
    s2, c3 = w[q + 2], w[q + 3]
    s3 = w[q + ROW_CC + 3]
    for j in lanes(TOGETHER):
        q = p + ahead + j
        x0 = w[q] * s0
        x1 = (w[q + ROW_CC] - a1 * x0) * s1
        x2 = (w[q + 2 * ROW_CC] - a2 * x0 - b2 * x1) * s2
        w[q + 3 * ROW_CC] = (w[q + 3 * ROW_CC] - a3 * x0 - b3 * x1 - c3 * x2) * s3
        w[q] = x0
        w[q + ROW_CC] = x1
        w[q + 2 * ROW_CC] = x2


def subtract_group(w, u, p, q):
    """Subtract from 4x4 numbers at ``q`` those at ``u``, transposed, times those at ``p``."""
    for i in range(TOGETHER):
        c0 = w[u + i]
        c1 = w[u + ROW_CC + i]
        c2 = w[u + 2 * ROW_CC + i]
        c3 = w[u + 3 * ROW_CC + i]
        for j in lanes(TOGETHER):
            k = q + ROW_CC * i + j
            m = p + j
            w[k] = (
                w[k]
                - c0 * w[m]
                - c1 * w[m + ROW_CC]
                - c2 * w[m + 2 * ROW_CC]
                - c3 * w[m + 3 * ROW_CC]
            )


def solve_row(w, size, k):
    """Solve row ``k`` of U X = U'^-1 P_c H', those after it being solved."""
    row = S_CC + ROW_CC * k
    x0 = w[row + X_CC]
    x1 = w[row + X_CC + 1]
    x2 = w[row + X_CC + 2]
    for m in range(k + 1, size):
        u = w[row + m]
        x = S_CC + ROW_CC * m + X_CC
        x0 -= u * w[x]
        x1 -= u * w[x + 1]
        x2 -= u * w[x + 2]
    scale = w[row + k]
    w[row + X_CC] = x0 * scale
    w[row + X_CC + 1] = x1 * scale
    w[row + X_CC + 2] = x2 * scale
