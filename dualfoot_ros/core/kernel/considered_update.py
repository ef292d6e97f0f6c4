"""Updates with a gain that takes some states as known: a Schmidt-Kalman filter of a special kind.

A measurement may be blind to a quantity in truth and see it in the model.  A zero-velocity update
is: what the model cannot say of a stance looks like heading and gyro bias, and the filter would
learn them from it.  So the gain is that of a filter which *knows* the considered states c, and
their covariance goes on being carried.  With G = P H', S = H G + R,

    X = P_cc^-1 G_c,   G' = G - P_.c X,   S' = S - G_c' X,   K = G' S'^-1,   K_c = 0,
    P <- P - M K' - K M',   M = G - K S / 2,

which is Joseph's form for any gain K: P stays consistent whatever is left out of K.  All loops
over the columns of G have a fixed length, which is what a compiler needs to take several at once;
rows that a measurement does not have are zero.
"""

import math

from .layout import (
    JOINT,
    ROW,
    ROW_CC,
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
)

LEAST_PIVOT = 1e-18  # a variance below it is none: the state is known already


def clear_rest(w, rows):
    """Set what belongs to no row of a measurement with fewer than three to zero."""
    for k in range(rows, ROWS_MOST):
        w[S_Y + k] = 0.0
        for j in range(JOINT):
            w[S_G + JOINT * k + j] = 0.0
        for m in range(ROWS_MOST):
            w[S_S + ROWS_MOST * k + m] = 0.0
            w[S_S + ROWS_MOST * m + k] = 0.0


def solve_known(w, size):
    """Solve P_cc X = P_c H' in place of the rows [P_cc, P_c H'] at S_CC, by P_cc = U' U.

    A pivot that is none gives zeros.
    """
    for k in range(size):
        row = S_CC + ROW_CC * k
        total = w[row + k]
        pivot = math.sqrt(total) if total > LEAST_PIVOT else 0.0
        divide(w, row, ROW_CC, pivot)
        w[row + k] = pivot
        for i in range(k + 1, size):
            x = w[row + i]
            for j in range(ROW_CC):
                w[S_CC + ROW_CC * i + j] -= x * w[row + j]
    for i in range(size):
        k = size - 1 - i
        row = S_CC + ROW_CC * k
        x0 = w[row + X_CC]
        x1 = w[row + X_CC + 1]
        x2 = w[row + X_CC + 2]
        for m in range(k + 1, size):
            u = w[row + m]
            x0 -= u * w[S_CC + ROW_CC * m + X_CC]
            x1 -= u * w[S_CC + ROW_CC * m + X_CC + 1]
            x2 -= u * w[S_CC + ROW_CC * m + X_CC + 2]
        pivot = w[row + k]
        w[row + X_CC] = x0 / pivot if pivot > 0.0 else 0.0
        w[row + X_CC + 1] = x1 / pivot if pivot > 0.0 else 0.0
        w[row + X_CC + 2] = x2 / pivot if pivot > 0.0 else 0.0


def divide(w, start, count, pivot):
    """Divide ``count`` numbers by ``pivot``; a pivot that is none gives zeros."""
    if pivot > 0.0:
        for j in range(count):
            w[start + j] /= pivot
    else:
        for j in range(count):
            w[start + j] = 0.0


def factor_rest(w, size):
    """Write L of S' = S - P_c H' X = L L' to S_L and z = L^-1 y to S_DX; return the NIS z' z."""
    nis = 0.0
    for k in range(ROWS_MOST):
        for m in range(k + 1):
            total = w[S_S + ROWS_MOST * k + m]
            for c in range(size):
                total -= w[S_GC + ROWS_MOST * c + k] * w[S_CC + ROW_CC * c + X_CC + m]
            for i in range(m):
                total -= w[S_L + ROWS_MOST * k + i] * w[S_L + ROWS_MOST * m + i]
            if m == k:
                w[S_L + ROWS_MOST * k + k] = math.sqrt(total) if total > 0.0 else 0.0
            else:
                pivot = w[S_L + ROWS_MOST * m + m]
                w[S_L + ROWS_MOST * k + m] = total / pivot if pivot > 0.0 else 0.0
        z = w[S_Y + k]
        for m in range(k):
            z -= w[S_L + ROWS_MOST * k + m] * w[S_DX + m]
        pivot = w[S_L + ROWS_MOST * k + k]
        z = z / pivot if pivot > 0.0 else 0.0
        w[S_DX + k] = z
        nis += z * z
    return nis


def gain_of(w, size, side):
    """Write the gain K = (G - P_.c X) S'^-1 of the foot at ``side`` to S_K."""
    for m in range(ROWS_MOST):
        k = S_K + JOINT * m + side
        for j in range(SIDE):
            w[k + j] = w[S_G + JOINT * m + side + j]
        for c in range(size):
            x = w[S_CC + ROW_CC * c + X_CC + m]
            for j in range(SIDE):
                w[k + j] -= w[S_PC + JOINT * c + side + j] * x
    for k in range(ROWS_MOST):
        for m in range(k):
            take_off(w, S_K + JOINT * k + side, w[S_L + ROWS_MOST * k + m], S_K + JOINT * m + side)
        divide(w, S_K + JOINT * k + side, SIDE, w[S_L + ROWS_MOST * k + k])
    for i in range(ROWS_MOST):
        k = ROWS_MOST - 1 - i
        for m in range(k + 1, ROWS_MOST):
            take_off(w, S_K + JOINT * k + side, w[S_L + ROWS_MOST * m + k], S_K + JOINT * m + side)
        divide(w, S_K + JOINT * k + side, SIDE, w[S_L + ROWS_MOST * k + k])


def take_off(w, target, factor, source):
    """Subtract ``factor`` times the vector (SIDE,) at ``source`` from that at ``target``."""
    for j in range(SIDE):
        w[target + j] -= factor * w[source + j]


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


def weigh(w, side):
    """Write M = G - K S / 2 in the place of G, and K y to S_DX, for the foot at ``side``."""
    for k in range(ROWS_MOST):
        s0 = w[S_S + k]
        s1 = w[S_S + ROWS_MOST + k]
        s2 = w[S_S + 2 * ROWS_MOST + k]
        for j in range(SIDE):
            x = S_K + side + j
            total = w[x] * s0 + w[x + JOINT] * s1 + w[x + 2 * JOINT] * s2
            w[S_G + JOINT * k + side + j] -= 0.5 * total
    y0 = w[S_Y]
    y1 = w[S_Y + 1]
    y2 = w[S_Y + 2]
    for j in range(SIDE):
        x = S_K + side + j
        w[S_DX + side + j] = w[x] * y0 + w[x + JOINT] * y1 + w[x + 2 * JOINT] * y2


def take_products(w, block, a, b):
    """Subtract M K' + K M' from a block, with the rows of the foot at ``a``, columns at ``b``."""
    for i in range(15):
        m0 = w[S_G + a + i]
        m1 = w[S_G + JOINT + a + i]
        m2 = w[S_G + 2 * JOINT + a + i]
        k0 = w[S_K + a + i]
        k1 = w[S_K + JOINT + a + i]
        k2 = w[S_K + 2 * JOINT + a + i]
        for j in range(ROW):
            m = S_G + b + j
            k = S_K + b + j
            # the two products of a pair stay the same when i and j change places
            w[block + ROW * i + j] -= (
                (m0 * w[k] + k0 * w[m])
                + (m1 * w[k + JOINT] + k1 * w[m + JOINT])
                + (m2 * w[k + 2 * JOINT] + k2 * w[m + 2 * JOINT])
            )
