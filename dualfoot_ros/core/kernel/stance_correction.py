"""What a zero-velocity update corrects: all, or no heading and bias, or no place besides."""

from .layout import (
    C_BIAS_KNOWN_VAR,
    DIAGONAL,
    E_ATT,
    E_BA,
    E_BG,
    E_VEL,
    JOINT,
    PLL,
    PLR,
    PRR,
    ROW,
    ROWS_MOST,
    S_DX,
    S_G,
    S_K,
    SIDE,
    lanes,
)
from .measurement_update import factor, feed_back, feed_back_foot, take_products, weigh
from .schmidt.considered_states import KNOWN, consider_all, consider_foot
from .schmidt.stance_gain import knowing_all, knowing_foot
from .tiles import turn_over


def bias_known(w, foot):
    """Return whether the gyro bias of ``foot`` is known better than a stance could tell it."""
    block = PLL if foot == 0 else PRR
    largest = 0.0
    for i in range(3):
        largest = max(largest, w[block + DIAGONAL * (E_BG + i)])
    return largest <= w[C_BIAS_KNOWN_VAR]


def correct_stance(w, foot, still):
    """Update with a gain that takes heading and gyro bias as known; return the NIS.

    ``still`` leaves the position of the standing ``foot`` and all of the other foot alone as well.
    """
    consider_all(w)
    if foot == 0:  # for the right one they are there already
        turn_over(w, PLR, KNOWN, E_BA)
    nis = knowing_all(w)
    if still:
        for k in range(ROWS_MOST):
            for j in lanes(SIDE):
                w[S_K + JOINT * k + SIDE * (1 - foot) + j] = 0.0
        clear_place(w, SIDE * foot)
    weigh(w, 0, JOINT)
    take_products(w, PLR, 0, SIDE)
    if foot == 0 or not still:
        take_products(w, PLL, 0, 0)
        feed_back_foot(w, 0)
    if foot == 1 or not still:
        take_products(w, PRR, SIDE, SIDE)
        feed_back_foot(w, 1)
    return nis


def correct_alone(w, foot, block, side, still):
    """Do what `correct_stance` does for a foot that is uncorrelated with the other."""
    consider_foot(w, block, side)
    nis = knowing_foot(w, block, side)
    if still:
        clear_place(w, side)
    weigh(w, side, SIDE)
    take_products(w, block, side, side)
    feed_back_foot(w, foot)
    return nis


def clear_place(w, side):
    """Let the gain leave the position of the foot at ``side`` alone."""
    for k in range(ROWS_MOST):
        for j in range(E_VEL):
            w[S_K + JOINT * k + side + j] = 0.0


def correct_standing(w, foot):
    """Do what `correct` does, but leave position and heading of the standing ``foot`` alone.

    A Schmidt update: the other foot's states, and position and heading of this one, are considered
    and not estimated.  A minute of standing says much about tilt and biases, and through what the
    model leaves out (scale factor, misalignment) nothing true about the way that lies behind.
    """
    nis = factor(w, ROWS_MOST)
    own = SIDE * foot
    other = SIDE * (1 - foot)
    for j in lanes(SIDE):
        w[S_DX + other + j] = 0.0
    for j in range(15):
        if considered_standing(j):
            w[S_DX + own + j] = 0.0
    block = PLL if foot == 0 else PRR
    for i in range(15):
        estimated = not considered_standing(i)
        a0 = w[S_G + own + i]
        a1 = w[S_G + JOINT + own + i]
        a2 = w[S_G + 2 * JOINT + own + i]
        for j in range(15):
            # P of two considered states stays: nothing is learnt about either
            if estimated or not considered_standing(j):
                o = S_G + own + j
                w[block + ROW * i + j] -= a0 * w[o] + a1 * w[o + JOINT] + a2 * w[o + 2 * JOINT]
            if estimated:
                o = S_G + other + j
                cross = PLR + ROW * i + j if foot == 0 else PLR + ROW * j + i
                w[cross] -= a0 * w[o] + a1 * w[o + JOINT] + a2 * w[o + 2 * JOINT]
    feed_back(w)
    return nis


def considered_standing(state):
    """Return whether an error state of a standing foot is its position or heading."""
    return state < E_VEL or state == E_ATT + 2
