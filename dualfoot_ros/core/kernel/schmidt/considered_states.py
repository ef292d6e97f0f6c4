"""The states that a gain takes as known, prepared for `considered_update`.

They are heading and gyro bias of both feet (`consider_all`) or of one foot (`consider_foot`), or
the gyro biases and what the feet have in common of heading and position (`consider_common`), so
that a constraint between the feet corrects the one against the other and does not move the pair.
Each writes rows [P_cc, P_c H'] to S_CC, the last one also P_.c to S_PC, a column of JOINT a state.
"""

from ..layout import (
    CONSIDERED,
    CONSIDERED_FOOT,
    DIAGONAL,
    E_ATT,
    E_BG,
    E_POS,
    JOINT,
    PLACE,
    PLL,
    PLR,
    PRR,
    ROW,
    ROW_CC,
    ROW_GC,
    S_CC,
    S_G,
    S_GC,
    S_K,
    S_PC,
    SIDE,
    X_CC,
    lanes,
)
from ..tiles import copy_row, put_row

BIASES, COMMON = 6, 4  # gyro biases of both feet; heading and position, in common
KNOWN = E_ATT + 2  # heading, which gyro bias follows: CONSIDERED_FOOT states of a foot
LEAST_VARIANCE = 1e-18  # both feet's together, below which they count alike


def gather_left(w, state, column):
    """Write P times an error state of the left foot to ``column`` (JOINT)."""
    state &= PLACE
    column &= PLACE
    for j in lanes(ROW):
        w[column + j] = w[PLL + ROW * state + j]
        w[column + SIDE + j] = w[PLR + ROW * state + j]


def gather_right(w, state, column):
    """Write P times an error state of the right foot to ``column`` (JOINT)."""
    state &= PLACE
    column &= PLACE
    for j in range(15):
        w[column + j] = w[PLR + ROW * j + state]
    w[column + 15] = 0.0
    for j in lanes(ROW):
        w[column + SIDE + j] = w[PRR + ROW * state + j]


def put_known(w, c, x, y, z):
    """Write row ``c`` of P_c H'."""
    put_row(w, S_GC + ROW_GC * c, x, y, z, 0.0)
    put_row(w, S_CC + ROW_CC * c + X_CC, x, y, z, 0.0)


def consider_all(w):
    """Prepare heading and gyro bias of both feet, without P_.c: `knowing_all` reads it from P."""
    for k in range(CONSIDERED_FOOT):
        left = S_CC + ROW_CC * k
        right = left + ROW_CC * CONSIDERED_FOOT
        row = ROW * (KNOWN + k) + KNOWN
        copy_row(w, PLL + row, left)
        copy_row(w, PLR + row, left + CONSIDERED_FOOT)
        copy_row(w, PRR + row, right + CONSIDERED_FOOT)
    put_known_foot(w, 0, S_G + KNOWN)
    put_known_foot(w, CONSIDERED_FOOT, S_G + SIDE + KNOWN)


def consider_foot(w, block, side):
    """Prepare heading and gyro bias of one foot, both being uncorrelated, without P_.c.

    ``block`` is its covariance and ``side`` its place in a vector of both.
    """
    for k in range(CONSIDERED_FOOT):
        copy_row(w, block + ROW * (KNOWN + k) + KNOWN, S_CC + ROW_CC * k)
    put_known_foot(w, 0, S_G + side + KNOWN)


def put_known_foot(w, c, g):
    """Write P_c H' of four states, which are at ``g`` of its columns, as rows from ``c`` on."""
    a0, a1, a2, a3 = w[g], w[g + 1], w[g + 2], w[g + 3]
    g += JOINT
    b0, b1, b2, b3 = w[g], w[g + 1], w[g + 2], w[g + 3]
    g += JOINT
    c0, c1, c2, c3 = w[g], w[g + 1], w[g + 2], w[g + 3]
    put_known(w, c, a0, b0, c0)
    put_known(w, c + 1, a1, b1, c1)
    put_known(w, c + 2, a2, b2, c2)
    put_known(w, c + 3, a3, b3, c3)


def consider_common(w):
    """Prepare the gyro biases and what the feet have in common, and states that are none.

    In common are heading and position: (1 - a) x_L + a x_R with a = V_L / (V_L + V_R), so that the
    foot that is known better counts more, and the correction stays between the feet.
    """
    for k in range(3):
        gather_left(w, E_BG + k, S_PC + JOINT * k)
        gather_right(w, E_BG + k, S_PC + JOINT * (3 + k))
    for k in range(BIASES):
        g = S_G + SIDE * (k // 3) + E_BG + k % 3
        put_known(w, k, w[g], w[g + JOINT], w[g + 2 * JOINT])
    for k in range(COMMON):
        state = common_state(k)
        a = share_of_right(w, k)
        column = S_PC + JOINT * (BIASES + k)
        gather_left(w, state, column)
        gather_right(w, state, S_K)
        for j in lanes(JOINT):
            w[column + j] = (1.0 - a) * w[column + j] + a * w[S_K + j]
        g0 = between(w, S_G + state, a)
        g1 = between(w, S_G + JOINT + state, a)
        g2 = between(w, S_G + 2 * JOINT + state, a)
        put_known(w, BIASES + k, g0, g1, g2)
    for k in range(BIASES + COMMON):  # the upper triangle is what counts
        column = S_PC + JOINT * k
        for m in range(BIASES):
            w[S_CC + ROW_CC * m + k] = w[column + SIDE * (m // 3) + E_BG + m % 3]
        for m in range(COMMON):
            a = share_of_right(w, m)
            x = column + common_state(m)
            w[S_CC + ROW_CC * (BIASES + m) + k] = (1.0 - a) * w[x] + a * w[x + SIDE]
        clear_beyond(w, S_CC + ROW_CC * k, BIASES + COMMON)
    for k in range(BIASES + COMMON, CONSIDERED):
        clear_beyond(w, S_CC + ROW_CC * k, 0)
        put_known(w, k, 0.0, 0.0, 0.0)


def between(w, g, a):
    """Return what the feet have in common of an element of P H', at ``g`` for the left."""
    return (1.0 - a) * w[g] + a * w[g + SIDE]


def clear_beyond(w, row, size):
    """Write zeros, for states that are none, behind ``size`` columns of the ``row`` of P_cc."""
    for c in range(size, X_CC):
        w[row + c] = 0.0


def share_of_right(w, k):
    """Return what the right foot counts in the k-th state that both have in common."""
    left = w[PLL + DIAGONAL * common_state(k)]
    right = w[PRR + DIAGONAL * common_state(k)]
    return left / (left + right) if left + right > LEAST_VARIANCE else 0.5


def common_state(k):
    """Return the k-th error state that `consider_common` takes of both feet together."""
    if k == 0:
        return E_ATT + 2
    return E_POS + k - 1
