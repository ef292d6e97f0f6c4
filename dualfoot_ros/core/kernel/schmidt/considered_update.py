"""Updates with a gain that takes some states as known: a Schmidt-Kalman filter of a special kind.

A measurement may be blind to a quantity in truth and see it in the model.  A zero-velocity update
is: what the model cannot say of a stance looks like heading and gyro bias, and the filter would
learn them from it.  So the gain is that of a filter which *knows* the considered states c, and
their covariance goes on being carried.  With G = P H', S = H G + R,

    X = P_cc^-1 G_c,   G' = G - P_.c X,   S' = S - G_c' X,   K = G' S'^-1,   K_c = 0,
    P <- P - M K' - K M',   M = G - K S / 2,

which is Joseph's form for any gain K: P stays consistent whatever is left out of K.  Rows that a
measurement does not have are zero, as are states beyond the considered ones.  Loops over the
states have no branch and much to do, so that a compiler takes several states at once.
"""

from ..layout import (
    JOINT,
    PLACE,
    ROW_CC,
    ROW_GC,
    ROWS_MOST,
    S_CC,
    S_DX,
    S_G,
    S_GC,
    S_K,
    S_L,
    S_PC,
    S_S,
    S_Y,
    SIDE,
    X_CC,
    lanes,
)
from .known_states import TOGETHER, inverse_root, solve_known


def clear_rest(w, rows):
    """Set what belongs to no row of a measurement with fewer than three to zero."""
    for k in range(rows, ROWS_MOST):
        w[S_Y + k] = 0.0
        for j in lanes(JOINT):
            w[S_G + JOINT * k + j] = 0.0
        for m in range(ROWS_MOST):
            w[S_S + ROWS_MOST * k + m] = 0.0
            w[S_S + ROWS_MOST * m + k] = 0.0


def factor_rest(w, size):
    """Write L of S' = S - P_c H' X = L L' to S_L and z = L^-1 y to S_DX; return the NIS z' z.

    The diagonal of L is left as what it divides by, inverted.
    """
    nis = 0.0
    for k in range(ROWS_MOST):
        for m in range(k + 1):
            total = w[S_S + ROWS_MOST * k + m]
            for c in range(size):
                total -= w[S_GC + ROW_GC * c + k] * w[S_CC + ROW_CC * c + X_CC + m]
            for i in range(m):
                total -= w[S_L + ROWS_MOST * k + i] * w[S_L + ROWS_MOST * m + i]
            if m == k:
                w[S_L + ROWS_MOST * k + k] = inverse_root(total, 0.0)
            else:
                w[S_L + ROWS_MOST * k + m] = total * w[S_L + ROWS_MOST * m + m]
        z = w[S_Y + k]
        for m in range(k):
            z -= w[S_L + ROWS_MOST * k + m] * w[S_DX + m]
        z = z * w[S_L + ROWS_MOST * k + k]
        w[S_DX + k] = z
        nis += z * z
    return nis


def gain_of(w, size, side):
    """Write the gain K = (G - P_.c X) S'^-1 of the foot at ``side`` to S_K, with P_.c at S_PC."""
    begin_gain(w, side)
    for c in range(0, size, TOGETHER):
        take_known(w, c, S_PC + JOINT * c + side, JOINT, side)
    divide_by_factor(w, side)


def begin_gain(w, side):
    """Write G of the foot at ``side`` to the place of its gain."""
    side &= PLACE
    for k in range(ROWS_MOST):
        for j in lanes(SIDE):
            w[S_K + JOINT * k + side + j] = w[S_G + JOINT * k + side + j]


def take_known(w, c, column, stride, side):
    """Subtract P_.c X of four considered states, from ``c`` on, from the gain at ``side``.

    P_.c of them is at ``column``, ``column + stride``, ...
    """
    x = S_CC + ROW_CC * c + X_CC
    a0, a1, a2 = w[x], w[x + 1], w[x + 2]
    b0, b1, b2 = w[x + ROW_CC], w[x + ROW_CC + 1], w[x + ROW_CC + 2]
    x += 2 * ROW_CC
    c0, c1, c2 = w[x], w[x + 1], w[x + 2]
    d0, d1, d2 = w[x + ROW_CC], w[x + ROW_CC + 1], w[x + ROW_CC + 2]
    column &= PLACE
    stride &= PLACE
    gain = (S_K + side) & PLACE
    for j in lanes(SIDE):
        p = column + j
        k = gain + j
        a = w[p]
        b = w[p + stride]
        g = w[p + 2 * stride]
        d = w[p + 3 * stride]
        w[k] = w[k] - a * a0 - b * b0 - g * c0 - d * d0
        w[k + JOINT] = w[k + JOINT] - a * a1 - b * b1 - g * c1 - d * d1
        w[k + 2 * JOINT] = w[k + 2 * JOINT] - a * a2 - b * b2 - g * c2 - d * d2


def divide_by_factor(w, side):
    """Write the gain in the place of G' of the foot at ``side``."""
    gain = (S_K + side) & PLACE
    for j in lanes(SIDE):
        k = gain + j
        put_gain(w, k, w[k], w[k + JOINT], w[k + 2 * JOINT])


def put_gain(w, k, g0, g1, g2):
    """Write K of a state to ``k``: K L L' = G'; a pivot that is none gives zero."""
    l10 = w[S_L + ROWS_MOST]
    l20 = w[S_L + 2 * ROWS_MOST]
    l21 = w[S_L + 2 * ROWS_MOST + 1]
    d0 = w[S_L]
    d1 = w[S_L + ROWS_MOST + 1]
    d2 = w[S_L + 2 * ROWS_MOST + 2]
    z0 = g0 * d0
    z1 = (g1 - l10 * z0) * d1
    z2 = (g2 - l20 * z0 - l21 * z1) * d2
    k2 = z2 * d2
    k1 = (z1 - l21 * k2) * d1
    w[k] = (z0 - l10 * k1 - l20 * k2) * d0
    w[k + JOINT] = k1
    w[k + 2 * JOINT] = k2


def considering_gain(w, size):
    """Write the gain K, a column of JOINT a row, to S_K; return the NIS of the known states.

    Needs G (S_G), S (S_S, noise included), the innovation (S_Y) and what `considered_states`
    prepared.
    """
    solve_known(w, size)
    nis = factor_rest(w, size)
    gain_of(w, size, 0)
    gain_of(w, size, SIDE)
    return nis
