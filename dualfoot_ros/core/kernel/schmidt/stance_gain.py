"""The gain of a stance, which takes heading and gyro bias of one foot or of both as known.

It is that of `considered_update`, four states at a time.  Those that are known follow each other
in P, at which their columns are read, and fill the third four of a foot: their gain is zero.
"""

from ..layout import (
    CONSIDERED_FOOT,
    JOINT,
    PLACE,
    PLL,
    PLR,
    PRR,
    ROW,
    ROW_CC,
    ROWS_MOST,
    S_A,
    S_CC,
    S_G,
    S_K,
    SIDE,
    X_CC,
    lanes,
)
from .considered_states import KNOWN
from .considered_update import factor_rest, put_gain
from .known_states import TOGETHER, solve_known

BEHIND = KNOWN + CONSIDERED_FOOT  # states of a foot behind those that are known


def knowing_all(w):
    """Write the gain for what `consider_all` prepared to S_K; return the NIS.

    The columns of the right foot's states in the cross block are at S_A (`turn_over`).
    """
    solve_known(w, 2 * CONSIDERED_FOOT)
    nis = factor_rest(w, 2 * CONSIDERED_FOOT)
    for j in (0, TOGETHER, BEHIND):
        gain_of_both(w, j, PLL + ROW * KNOWN + j, S_A + ROW * KNOWN + j)
        gain_of_both(w, SIDE + j, PLR + ROW * KNOWN + j, PRR + ROW * KNOWN + j)
    clear_known(w, 0)
    clear_known(w, SIDE)
    return nis


def knowing_foot(w, block, side):
    """Do the same for what `consider_foot` prepared, for the foot with that block and side."""
    solve_known(w, CONSIDERED_FOOT)
    nis = factor_rest(w, CONSIDERED_FOOT)
    for j in (0, TOGETHER, BEHIND):
        gain_of_one(w, side + j, block + ROW * KNOWN + j)
    clear_known(w, side)
    return nis


def clear_known(w, side):
    """Let the gain leave heading and gyro bias of the foot at ``side`` alone."""
    for k in range(ROWS_MOST):
        for c in range(CONSIDERED_FOOT):
            w[S_K + JOINT * k + side + KNOWN + c] = 0.0


def gain_of_one(w, at, own):
    """Write four columns of the gain, from ``at`` on, with P of four known states at ``own``."""
    x = S_CC + X_CC
    a0, a1, a2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    b0, b1, b2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    c0, c1, c2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    d0, d1, d2 = w[x], w[x + 1], w[x + 2]
    own &= PLACE
    at &= PLACE
    for j in lanes(TOGETHER):
        p = own + j
        a = w[p]
        b = w[p + ROW]
        c = w[p + 2 * ROW]
        d = w[p + 3 * ROW]
        g = S_G + at + j
        put_gain(
            w,
            S_K + at + j,
            w[g] - a * a0 - b * b0 - c * c0 - d * d0,
            w[g + JOINT] - a * a1 - b * b1 - c * c1 - d * d1,
            w[g + 2 * JOINT] - a * a2 - b * b2 - c * c2 - d * d2,
        )


def gain_of_both(w, at, left, right):
    """Do the same with P of four known states of the left foot and of the right one."""
    x = S_CC + X_CC
    a0, a1, a2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    b0, b1, b2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    c0, c1, c2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    d0, d1, d2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    e0, e1, e2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    f0, f1, f2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    g0, g1, g2 = w[x], w[x + 1], w[x + 2]
    x += ROW_CC
    h0, h1, h2 = w[x], w[x + 1], w[x + 2]
    left &= PLACE
    right &= PLACE
    at &= PLACE
    for j in lanes(TOGETHER):
        p = left + j
        a = w[p]
        b = w[p + ROW]
        c = w[p + 2 * ROW]
        d = w[p + 3 * ROW]
        q = right + j
        e = w[q]
        f = w[q + ROW]
        g = w[q + 2 * ROW]
        h = w[q + 3 * ROW]
        k = S_G + at + j
        y0 = w[k] - a * a0 - b * b0 - c * c0 - d * d0
        y1 = w[k + JOINT] - a * a1 - b * b1 - c * c1 - d * d1
        y2 = w[k + 2 * JOINT] - a * a2 - b * b2 - c * c2 - d * d2
        put_gain(
            w,
            S_K + at + j,
            y0 - e * e0 - f * f0 - g * g0 - h * h0,
            y1 - e * e1 - f * f1 - g * g1 - h * h1,
            y2 - e * e2 - f * f2 - g * g2 - h * h2,
        )
