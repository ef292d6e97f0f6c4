"""Zero-velocity updates of a foot in stance, eq. (12) of Liu et al. 2023.

They hold at the point about which the foot pivots.  With the pivot at ``l`` from the sensor
(navigation axes), the sensor moves with v = -P omega x l while the foot rolls over:
h(x) = v + P omega x l is zero.  P keeps the horizontal part of the angular rate: a foot that turns
about the vertical turns under its ball, not about ``l``.  The rows of H are
[0, I, [P omega x][l x] - [l x] P [omega x], -[l x] P R_nb, 0]; a lever arm of zero is the paper's
eq. (12).

While the feet are uncorrelated (``coupled`` is False) the other foot stays as it is and nothing is
computed for it; the bits are the same.
"""

from .layout import (
    C_FOOT,
    C_LEVER,
    C_STRIDE,
    C_ZUPT_CONSIDERS,
    C_ZUPT_RATE_VAR,
    C_ZUPT_STILL_VAR,
    C_ZUPT_VAR,
    E_ATT,
    E_BA,
    E_BG,
    E_VEL,
    FOOT,
    JOINT,
    PLACE,
    PLL,
    PLR,
    PRR,
    RATE,
    ROT,
    ROW,
    ROWS_ATT,
    ROWS_BG,
    ROWS_MOST,
    ROWS_VEL,
    S_A,
    S_G,
    S_H,
    S_S,
    S_Y,
    SIDE,
    VEL,
    Z_LEFT,
    Z_NIS,
    Z_S,
    ZUPT_INFO,
    lanes,
)
from .measurement_update import correct
from .stance_correction import bias_known, correct_alone, correct_stance, correct_standing
from .tiles import turn_over
from .turn import HEADING, keeps_gauge


def zupt(w, foot, still=False, coupled=True):
    """Update with the zero velocity of one foot.

    ``still`` takes the noise of a standstill, in which nothing moves, for that of a stance.
    """
    squared_rate = put_rows(w, foot)
    if foot == 0:
        collect_own(w, PLL, 0)
        if coupled:
            collect_other(w, PLR, 0, SIDE)
    else:
        collect_own(w, PRR, SIDE)
        if coupled:
            turn_over(w, PLR, 0, E_BA)
            collect_other(w, S_A, SIDE, 0)
    if not coupled:
        clear_side(w, SIDE * (1 - foot))
    noise = w[C_ZUPT_STILL_VAR] if still else w[C_ZUPT_VAR]
    noise += w[C_ZUPT_RATE_VAR] * squared_rate
    info = Z_LEFT + foot * ZUPT_INFO
    for i in range(3):
        w[S_S + (ROWS_MOST + 1) * i] += noise
        w[S_Y + i] += w[foot * FOOT + VEL + i]
        w[info + i] = w[S_Y + i]
    for i in range(ROWS_MOST * ROWS_MOST):
        w[info + Z_S + i] = w[S_S + i]
    if w[C_ZUPT_CONSIDERS] == 1.0 and bias_known(w, foot):
        if coupled:
            w[info + Z_NIS] = correct_stance(w, foot, still)
        elif foot == 0:
            w[info + Z_NIS] = correct_alone(w, 0, PLL, 0, still)
        else:
            w[info + Z_NIS] = correct_alone(w, 1, PRR, SIDE, still)
    elif still:
        w[info + Z_NIS] = correct_standing(w, foot)
    else:
        w[info + Z_NIS] = correct(w, 3)


def put_rows(w, foot):
    """Write H to S_H and P omega x l to S_Y; return the squared angular rate, (rad/s)^2."""
    o = foot * FOOT
    r = o + ROT
    lever = C_FOOT + foot * C_STRIDE + C_LEVER
    # angular rate and lever arm in navigation axes
    bx = w[o + RATE]
    by = w[o + RATE + 1]
    bz = w[o + RATE + 2]
    wx = w[r] * bx + w[r + 1] * by + w[r + 2] * bz
    wy = w[r + 3] * bx + w[r + 4] * by + w[r + 5] * bz
    wz = w[r + 6] * bx + w[r + 7] * by + w[r + 8] * bz
    lx = w[r] * w[lever] + w[r + 1] * w[lever + 1] + w[r + 2] * w[lever + 2]
    ly = w[r + 3] * w[lever] + w[r + 4] * w[lever + 1] + w[r + 5] * w[lever + 2]
    lz = w[r + 6] * w[lever] + w[r + 7] * w[lever + 1] + w[r + 8] * w[lever + 2]
    # velocity I, gyro bias -[l x] P R_nb
    for k in range(ROWS_MOST * JOINT):
        w[S_H + k] = 0.0
    h = S_H + SIDE * foot
    for i in range(3):
        w[h + (JOINT + 1) * i + E_VEL] = 1.0
        w[h + E_BG + i] = lz * w[r + 3 + i]
        w[h + JOINT + E_BG + i] = -lz * w[r + i]
        w[h + 2 * JOINT + E_BG + i] = ly * w[r + i] - lx * w[r + 3 + i]
    # attitude [P omega x][l x] - [l x] P [omega x]
    w[h + E_ATT] = lz * wz - wy * ly
    w[h + E_ATT + 1] = wy * lx
    w[h + E_ATT + 2] = -lz * wx
    w[h + JOINT + E_ATT] = wx * ly
    w[h + JOINT + E_ATT + 1] = lz * wz - wx * lx
    w[h + JOINT + E_ATT + 2] = -lz * wy
    w[h + 2 * JOINT + E_ATT] = wx * lz - lx * wz
    w[h + 2 * JOINT + E_ATT + 1] = wy * lz - ly * wz
    if keeps_gauge(w, foot):  # a turn of the whole track shows no velocity
        w[h + HEADING] = -w[o + VEL + 1]
        w[h + JOINT + HEADING] = w[o + VEL]
        w[h + 2 * JOINT + HEADING] = 0.0
    # innovation v + P omega x l, estimate minus zero; the velocity is added later
    w[S_Y] = wy * lz
    w[S_Y + 1] = -wx * lz
    w[S_Y + 2] = wx * ly - wy * lx
    return wx * wx + wy * wy + wz * wz


def collect_own(w, block, side):
    """Write P H' of the foot itself to S_G and H P H' to S_S.

    Row k of H has a one at velocity k and, besides, only attitude and gyro bias of the own foot.
    """
    collect_other(w, block, side, side)
    for k in range(3):
        for m in range(k, 3):
            g = S_G + JOINT * m + side
            h = S_H + JOINT * k + side
            total = w[g + E_VEL + k]
            for i in range(E_ATT, E_BA):
                total += w[h + i] * w[g + i]
            w[S_S + ROWS_MOST * k + m] = total
            w[S_S + ROWS_MOST * m + k] = total


def collect_other(w, block, side, to):
    """Write the part of P H' at ``to``: ``block`` has rows of the foot at ``side``."""
    block &= PLACE
    side &= PLACE
    to &= PLACE
    for k in range(3):
        h = S_H + JOINT * k + side
        a0 = w[h + E_ATT]
        a1 = w[h + E_ATT + 1]
        a2 = w[h + E_ATT + 2]
        b0 = w[h + E_BG]
        b1 = w[h + E_BG + 1]
        b2 = w[h + E_BG + 2]
        for j in lanes(ROW):
            p = block + j
            w[S_G + JOINT * k + to + j] = (
                w[p + ROWS_VEL + ROW * k]
                + a0 * w[p + ROWS_ATT]
                + a1 * w[p + ROWS_ATT + ROW]
                + a2 * w[p + ROWS_ATT + 2 * ROW]
                + b0 * w[p + ROWS_BG]
                + b1 * w[p + ROWS_BG + ROW]
                + b2 * w[p + ROWS_BG + 2 * ROW]
            )


def clear_side(w, side):
    """Set P H' of the foot at ``side`` to zero."""
    side &= PLACE
    for k in range(ROWS_MOST):
        for j in lanes(SIDE):
            w[S_G + JOINT * k + side + j] = 0.0
