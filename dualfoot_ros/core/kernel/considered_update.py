"""Updates with a gain that takes some states as known: a Schmidt-Kalman filter of a special kind.

A measurement may be blind to a quantity in truth and see it in the model.  A zero-velocity update
is: what the model cannot say of a stance looks like heading and gyro bias, and the filter would
learn them from it.  So the gain is that of a filter which *knows* the considered states c, and
their covariance goes on being carried.  With G = P H', S = H G + R,

    X = P_cc^-1 G_c,   G' = G - P_.c X,   S' = S - G_c' X,   K = G' S'^-1,   K_c = 0,
    P <- P - M K' - K M',   M = G - K S / 2,

which is Joseph's form for any gain K: P stays consistent whatever is left out of K.

c is heading and gyro bias of both feet (`consider_all`), or the gyro biases and what the feet have
in common of heading and position (`consider_common`), so that a constraint between the feet
corrects the one against the other and does not move the pair.
"""

import math

from .layout import (
    CONSIDERED,
    CONSIDERED_FOOT,
    DIAGONAL,
    E_ATT,
    E_BG,
    E_POS,
    JOINT,
    PLL,
    PLR,
    PRR,
    ROW,
    ROWS_MOST,
    S_CC,
    S_D,
    S_DX,
    S_G,
    S_GC,
    S_K,
    S_PC,
    S_S,
    S_Y,
    SIDE,
)

BIASES, COMMON = 6, 4  # gyro biases of both feet; heading and position, in common
LEAST_PIVOT = 1e-18  # a variance below it is none: the state is known already


def considered_state(k):
    """Return the k-th considered error state of a foot: heading, then gyro bias."""
    if k == 0:
        return E_ATT + 2
    return E_BG + k - 1


def gather(w, foot, k, column):
    """Write P times the k-th considered state of ``foot`` to ``column`` (JOINT)."""
    gather_state(w, foot, considered_state(k), column)


def gather_state(w, foot, state, column):
    """Write P times an error state of ``foot`` to ``column`` (JOINT)."""
    for j in range(15):
        if foot == 0:
            w[column + j] = w[PLL + ROW * state + j]
            w[column + SIDE + j] = w[PLR + ROW * state + j]
        else:
            w[column + j] = w[PLR + ROW * j + state]
            w[column + SIDE + j] = w[PRR + ROW * state + j]
    w[column + 15] = 0.0
    w[column + SIDE + 15] = 0.0


def consider_all(w, rows):
    """Prepare the considered states: heading and gyro bias of both feet; return how many."""
    for foot in range(2):
        for k in range(CONSIDERED_FOOT):
            c = CONSIDERED_FOOT * foot + k
            gather(w, foot, k, S_PC + JOINT * c)
            for m in range(rows):
                w[S_GC + ROWS_MOST * c + m] = w[
                    S_G + JOINT * m + SIDE * foot + considered_state(k)
                ]
    for c in range(2 * CONSIDERED_FOOT):
        for foot in range(2):
            for k in range(CONSIDERED_FOOT):
                d = CONSIDERED_FOOT * foot + k
                w[S_CC + CONSIDERED * c + d] = w[
                    S_PC + JOINT * c + SIDE * foot + considered_state(k)
                ]
    return 2 * CONSIDERED_FOOT


def consider_common(w, rows):
    """Prepare the gyro biases and what the feet have in common; return how many.

    In common are heading and position: (1 - a) x_L + a x_R with a = V_L / (V_L + V_R), so that the
    foot that is known better counts more, and the correction stays between the feet.
    """
    for k in range(BIASES):
        gather(w, k // 3, 1 + k % 3, S_PC + JOINT * k)
        for m in range(rows):
            state = SIDE * (k // 3) + E_BG + k % 3
            w[S_GC + ROWS_MOST * k + m] = w[S_G + JOINT * m + state]
    for k in range(COMMON):
        state = common_state(k)
        ll = w[PLL + DIAGONAL * state]
        rr = w[PRR + DIAGONAL * state]
        a = ll / (ll + rr) if ll + rr > LEAST_PIVOT else 0.5
        w[S_D + k] = a
        column = S_PC + JOINT * (BIASES + k)
        gather_state(w, 0, state, column)
        gather_state(w, 1, state, S_K)
        for j in range(JOINT):
            w[column + j] = (1.0 - a) * w[column + j] + a * w[S_K + j]
        for m in range(rows):
            g = S_G + JOINT * m + state
            w[S_GC + ROWS_MOST * (BIASES + k) + m] = (1.0 - a) * w[g] + a * w[g + SIDE]
    size = BIASES + COMMON
    for k in range(size):
        column = S_PC + JOINT * k
        for m in range(BIASES):
            w[S_CC + CONSIDERED * k + m] = w[column + SIDE * (m // 3) + E_BG + m % 3]
        for m in range(COMMON):
            a = w[S_D + m]
            x = column + common_state(m)
            w[S_CC + CONSIDERED * k + BIASES + m] = (1.0 - a) * w[x] + a * w[x + SIDE]
    return size


def common_state(k):
    """Return the k-th error state that `consider_common` takes of both feet together."""
    if k == 0:
        return E_ATT + 2
    return E_POS + k - 1


def factor_considered(w, size):
    """Factor the matrix at S_CC, L L' in its lower triangle; a pivot that is none gives zeros."""
    for k in range(size):
        for i in range(k, size):
            total = w[S_CC + CONSIDERED * i + k]
            for m in range(k):
                total -= w[S_CC + CONSIDERED * i + m] * w[S_CC + CONSIDERED * k + m]
            if i == k:
                pivot = math.sqrt(total) if total > LEAST_PIVOT else 0.0
                w[S_CC + CONSIDERED * k + k] = pivot
            elif pivot > 0.0:
                w[S_CC + CONSIDERED * i + k] = total / pivot
            else:
                w[S_CC + CONSIDERED * i + k] = 0.0


def solve_considered(w, size, start, stride):
    """Solve L L' x = b in place for the vector at ``start``, ``start + stride``, ..."""
    for k in range(size):
        total = w[start + stride * k]
        for m in range(k):
            total -= w[S_CC + CONSIDERED * k + m] * w[start + stride * m]
        pivot = w[S_CC + CONSIDERED * k + k]
        w[start + stride * k] = total / pivot if pivot > 0.0 else 0.0
    for i in range(size):
        k = size - 1 - i
        total = w[start + stride * k]
        for m in range(k + 1, size):
            total -= w[S_CC + CONSIDERED * m + k] * w[start + stride * m]
        pivot = w[S_CC + CONSIDERED * k + k]
        w[start + stride * k] = total / pivot if pivot > 0.0 else 0.0


def considering_gain(w, rows, size):
    """Write the gain K, a column of JOINT a row, to S_K; return the NIS of the known states.

    Needs G (S_G), S (S_S, noise included), the innovation (S_Y) and what `consider_all` or
    `consider_common` prepared.
    """
    factor_considered(w, size)
    # X in the place of G_c; the G_c that is needed beside it is kept in S_D
    for c in range(size):
        for m in range(rows):
            w[S_D + ROWS_MOST * c + m] = w[S_GC + ROWS_MOST * c + m]
    for m in range(rows):
        solve_considered(w, size, S_GC + m, ROWS_MOST)
    for m in range(rows):  # G' in the place of K
        for j in range(JOINT):
            total = w[S_G + JOINT * m + j]
            for c in range(size):
                total -= w[S_PC + JOINT * c + j] * w[S_GC + ROWS_MOST * c + m]
            w[S_K + JOINT * m + j] = total
    # S' = L D L', then K = G' S'^-1 by a forward and a backward pass over the columns
    lower = S_CC
    for k in range(rows):
        for m in range(k + 1):
            total = w[S_S + ROWS_MOST * k + m]
            for c in range(size):
                total -= w[S_D + ROWS_MOST * c + k] * w[S_GC + ROWS_MOST * c + m]
            w[lower + ROWS_MOST * k + m] = total
    nis = 0.0
    for k in range(rows):
        for m in range(k + 1):
            total = w[lower + ROWS_MOST * k + m]
            for i in range(m):
                total -= w[lower + ROWS_MOST * k + i] * w[lower + ROWS_MOST * m + i]
            if m == k:
                w[lower + ROWS_MOST * k + k] = math.sqrt(total) if total > 0.0 else 0.0
            else:
                pivot = w[lower + ROWS_MOST * m + m]
                w[lower + ROWS_MOST * k + m] = total / pivot if pivot > 0.0 else 0.0
    for k in range(rows):
        z = w[S_Y + k]
        for m in range(k):
            z -= w[lower + ROWS_MOST * k + m] * w[S_DX + m]
        pivot = w[lower + ROWS_MOST * k + k]
        z = z / pivot if pivot > 0.0 else 0.0
        w[S_DX + k] = z
        nis += z * z
    for j in range(JOINT):
        for k in range(rows):
            total = w[S_K + JOINT * k + j]
            for m in range(k):
                total -= w[lower + ROWS_MOST * k + m] * w[S_K + JOINT * m + j]
            pivot = w[lower + ROWS_MOST * k + k]
            w[S_K + JOINT * k + j] = total / pivot if pivot > 0.0 else 0.0
        for i in range(rows):
            k = rows - 1 - i
            total = w[S_K + JOINT * k + j]
            for m in range(k + 1, rows):
                total -= w[lower + ROWS_MOST * m + k] * w[S_K + JOINT * m + j]
            pivot = w[lower + ROWS_MOST * k + k]
            w[S_K + JOINT * k + j] = total / pivot if pivot > 0.0 else 0.0
    return nis


def apply_gain(w, rows):
    """Take K (S_K) to the covariance, P - M K' - K M', and K y to S_DX; S_G is overwritten."""
    for k in range(rows, ROWS_MOST):
        w[S_Y + k] = 0.0
        for j in range(JOINT):
            w[S_K + JOINT * k + j] = 0.0
            w[S_G + JOINT * k + j] = 0.0
    for j in range(JOINT):
        for k in range(rows):  # M in the place of G
            total = 0.0
            for m in range(rows):
                total += w[S_K + JOINT * m + j] * w[S_S + ROWS_MOST * m + k]
            w[S_G + JOINT * k + j] -= 0.5 * total
        w[S_DX + j] = (
            w[S_K + j] * w[S_Y]
            + w[S_K + JOINT + j] * w[S_Y + 1]
            + w[S_K + 2 * JOINT + j] * w[S_Y + 2]
        )
    for i in range(15):
        for j in range(15):
            left = 0.0
            right = 0.0
            cross = 0.0
            for k in range(ROWS_MOST):
                m = S_G + JOINT * k
                g = S_K + JOINT * k
                # the two products of a pair stay the same when i and j change places
                left += w[m + i] * w[g + j] + w[g + i] * w[m + j]
                right += w[m + SIDE + i] * w[g + SIDE + j] + w[g + SIDE + i] * w[m + SIDE + j]
                cross += w[m + i] * w[g + SIDE + j] + w[g + i] * w[m + SIDE + j]
            w[PLL + ROW * i + j] -= left
            w[PRR + ROW * i + j] -= right
            w[PLR + ROW * i + j] -= cross
