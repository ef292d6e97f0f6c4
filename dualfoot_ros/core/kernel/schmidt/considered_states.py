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
    ROWS_MOST,
    S_CC,
    S_G,
    S_GC,
    S_K,
    S_PC,
    SIDE,
    X_CC,
)

BIASES, COMMON = 6, 4  # gyro biases of both feet; heading and position, in common
KNOWN = E_ATT + 2  # heading, which gyro bias follows: CONSIDERED_FOOT states of a foot
LEAST_VARIANCE = 1e-18  # both feet's together, below which they count alike


def gather_left(w, state, column):
    """Write P times an error state of the left foot to ``column`` (JOINT)."""
    state &= PLACE
    column &= PLACE
    for j in range(ROW):
        w[column + j] = w[PLL + ROW * state + j]
        w[column + SIDE + j] = w[PLR + ROW * state + j]


def gather_right(w, state, column):
    """Write P times an error state of the right foot to ``column`` (JOINT)."""
    state &= PLACE
    column &= PLACE
    for j in range(15):
        w[column + j] = w[PLR + ROW * j + state]
    w[column + 15] = 0.0
    for j in range(ROW):
        w[column + SIDE + j] = w[PRR + ROW * state + j]


def put_known(w, c, m, value):
    """Write element m of row c of P_c H'."""
    w[S_GC + ROWS_MOST * c + m] = value
    w[S_CC + ROW_CC * c + X_CC + m] = value


def clear_beyond(w, row, size):
    """Write zeros behind the first ``size`` columns of the ``row`` of P_cc.

    Nothing reads them, but a row is scaled as a whole: what another update has left there would
    grow from one update to the next, until it overflows.
    """
    for c in range(size, X_CC):
        w[row + c] = 0.0


def consider_all(w):
    """Prepare heading and gyro bias of both feet, without P_.c: `knowing_all` reads it from P."""
    for k in range(CONSIDERED_FOOT):
        left = S_CC + ROW_CC * k
        right = left + ROW_CC * CONSIDERED_FOOT
        row = ROW * (KNOWN + k) + KNOWN
        for c in range(CONSIDERED_FOOT):
            w[left + c] = w[PLL + row + c]
            w[left + CONSIDERED_FOOT + c] = w[PLR + row + c]
            w[right + c] = w[PLR + ROW * (KNOWN + c) + KNOWN + k]
            w[right + CONSIDERED_FOOT + c] = w[PRR + row + c]
        clear_beyond(w, left, 2 * CONSIDERED_FOOT)
        clear_beyond(w, right, 2 * CONSIDERED_FOOT)
        for m in range(ROWS_MOST):
            put_known(w, k, m, w[S_G + JOINT * m + KNOWN + k])
            put_known(w, CONSIDERED_FOOT + k, m, w[S_G + JOINT * m + SIDE + KNOWN + k])


def consider_foot(w, block, side):
    """Prepare heading and gyro bias of one foot, both being uncorrelated, without P_.c.

    ``block`` is its covariance and ``side`` its place in a vector of both.
    """
    for k in range(CONSIDERED_FOOT):
        for c in range(CONSIDERED_FOOT):
            w[S_CC + ROW_CC * k + c] = w[block + ROW * (KNOWN + k) + KNOWN + c]
        clear_beyond(w, S_CC + ROW_CC * k, CONSIDERED_FOOT)
        for m in range(ROWS_MOST):
            put_known(w, k, m, w[S_G + JOINT * m + side + KNOWN + k])


def consider_common(w):
    """Prepare the gyro biases and what the feet have in common; return how many.

    In common are heading and position: (1 - a) x_L + a x_R with a = V_L / (V_L + V_R), so that the
    foot that is known better counts more, and the correction stays between the feet.
    """
    for k in range(3):
        gather_left(w, E_BG + k, S_PC + JOINT * k)
        gather_right(w, E_BG + k, S_PC + JOINT * (3 + k))
    for k in range(BIASES):
        for m in range(ROWS_MOST):
            put_known(w, k, m, w[S_G + JOINT * m + SIDE * (k // 3) + E_BG + k % 3])
    for k in range(COMMON):
        state = common_state(k)
        a = share_of_right(w, k)
        column = S_PC + JOINT * (BIASES + k)
        gather_left(w, state, column)
        gather_right(w, state, S_K)
        for j in range(JOINT):
            w[column + j] = (1.0 - a) * w[column + j] + a * w[S_K + j]
        for m in range(ROWS_MOST):
            g = S_G + JOINT * m + state
            put_known(w, BIASES + k, m, (1.0 - a) * w[g] + a * w[g + SIDE])
    for k in range(BIASES + COMMON):  # the upper triangle is what counts
        column = S_PC + JOINT * k
        for m in range(BIASES):
            w[S_CC + ROW_CC * m + k] = w[column + SIDE * (m // 3) + E_BG + m % 3]
        for m in range(COMMON):
            a = share_of_right(w, m)
            x = column + common_state(m)
            w[S_CC + ROW_CC * (BIASES + m) + k] = (1.0 - a) * w[x] + a * w[x + SIDE]
    for k in range(BIASES + COMMON, CONSIDERED):
        for m in range(ROWS_MOST):
            put_known(w, k, m, 0.0)
    return BIASES + COMMON


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
