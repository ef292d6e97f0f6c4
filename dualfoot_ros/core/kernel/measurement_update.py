"""Measurement updates of the error-state Kalman filter and the feedback to the nominal states.

Every measurement of up to three rows goes one way: ``collect`` builds P H', S and leaves them in
scratch, ``correct`` factors S = L D L', takes P - V V' in one exactly symmetric pass and feeds the
estimated error back.  P is never inverted, so a covariance that an equality constraint has made
singular is no trouble.  Errors are estimate minus truth (Liu et al. 2023, section III-C); the
attitude error is that of C_hat = (I - [phi x]) C, and the biases of eq. (6) are what is left of
them, truth minus estimate, so they are fed back with the other sign.
"""

import math

from .considered_update import (
    apply_gain,
    consider_all,
    consider_common,
    considered_state,
    considering_gain,
)
from .layout import (
    BA,
    BG,
    C_BIAS_KNOWN_VAR,
    C_FOOT,
    C_LEVER,
    C_STRIDE,
    C_ZUPT_CONSIDERS,
    C_ZUPT_RATE_VAR,
    C_ZUPT_STILL_VAR,
    C_ZUPT_VAR,
    CONSIDERED_FOOT,
    DIAGONAL,
    E_ATT,
    E_BA,
    E_BG,
    E_POS,
    E_VEL,
    FOOT,
    JOINT,
    KNOW_ALL,
    KNOW_COMMON,
    PLL,
    PLR,
    POS,
    PRR,
    RATE,
    ROT,
    ROW,
    ROWS_MOST,
    ROWS_VEL,
    S_DX,
    S_G,
    S_H,
    S_K,
    S_S,
    S_Y,
    SIDE,
    VEL,
    Z_LEFT,
    Z_NIS,
    Z_S,
    ZUPT_INFO,
)
from .strapdown import rotate_navigation, rotation_increment


def collect(w, rows):
    """Write P H' to S_G and H P H' to S_S for the ``rows`` rows at S_H (30 columns, dense)."""
    for k in range(rows):
        g = S_G + JOINT * k
        h = S_H + JOINT * k
        for j in range(JOINT):
            w[g + j] = 0.0
        for i in range(15):
            a = w[h + i]
            b = w[h + SIDE + i]
            if a != 0.0:  # most of H is zero
                for j in range(15):
                    w[g + j] += a * w[PLL + ROW * i + j]
                    w[g + SIDE + j] += a * w[PLR + ROW * i + j]
            if b != 0.0:
                for j in range(15):
                    w[g + j] += b * w[PLR + ROW * j + i]
                    w[g + SIDE + j] += b * w[PRR + ROW * i + j]
    for k in range(rows):
        for m in range(k, rows):
            total = 0.0
            for j in range(15):  # left and right in turn: the bits depend on it
                total += w[S_H + JOINT * k + j] * w[S_G + JOINT * m + j]
                total += w[S_H + JOINT * k + SIDE + j] * w[S_G + JOINT * m + SIDE + j]
            w[S_S + ROWS_MOST * k + m] = total
            w[S_S + ROWS_MOST * m + k] = total


def correct(w, rows):
    """Update with P H' (S_G), S (S_S, noise included) and the innovation (S_Y); return the NIS.

    S_G and S_Y are overwritten.
    """
    nis = factor(w, rows)
    downdate(w)
    feed_back(w)
    return nis


def correct_standing(w, rows, foot):
    """Do what `correct` does, but leave position and heading of the standing ``foot`` alone.

    A Schmidt update: the other foot's states, and position and heading of this one, are considered
    and not estimated.  A minute of standing says much about tilt and biases, and through what the
    model leaves out (scale factor, misalignment) nothing true about the way that lies behind.
    """
    nis = factor(w, rows)
    own = SIDE * foot
    other = SIDE * (1 - foot)
    for j in range(SIDE):
        w[S_DX + other + j] = 0.0
    for j in range(15):
        if considered(j):
            w[S_DX + own + j] = 0.0
    block = PLL if foot == 0 else PRR
    for i in range(15):
        estimated = not considered(i)
        a0 = w[S_G + own + i]
        a1 = w[S_G + JOINT + own + i]
        a2 = w[S_G + 2 * JOINT + own + i]
        for j in range(15):
            # P of two considered states stays: nothing is learnt about either
            if estimated or not considered(j):
                o = S_G + own + j
                w[block + ROW * i + j] -= a0 * w[o] + a1 * w[o + JOINT] + a2 * w[o + 2 * JOINT]
            if estimated:
                o = S_G + other + j
                cross = PLR + ROW * i + j if foot == 0 else PLR + ROW * j + i
                w[cross] -= a0 * w[o] + a1 * w[o + JOINT] + a2 * w[o + 2 * JOINT]
    feed_back(w)
    return nis


def bias_known(w, foot):
    """Return whether the gyro bias of ``foot`` is known better than a stance could tell it."""
    block = PLL if foot == 0 else PRR
    largest = 0.0
    for i in range(3):
        largest = max(largest, w[block + DIAGONAL * (E_BG + i)])
    return largest <= w[C_BIAS_KNOWN_VAR]


def correct_stance(w, rows, foot, still):
    """Update with a gain that takes heading and gyro bias as known; return the NIS.

    ``still`` leaves the position of the standing ``foot`` and all of the other foot alone as well.
    """
    nis = considering_gain(w, rows, consider_all(w, rows))
    for k in range(rows):
        for side in range(2):
            for c in range(CONSIDERED_FOOT):
                w[S_K + JOINT * k + SIDE * side + considered_state(c)] = 0.0
        if still:
            for j in range(SIDE):
                w[S_K + JOINT * k + SIDE * (1 - foot) + j] = 0.0
            for j in range(E_VEL):
                w[S_K + JOINT * k + SIDE * foot + j] = 0.0
    apply_gain(w, rows)
    feed_back(w)
    return nis


def correct_considering(w, rows, kind):
    """Update with a gain that leaves some states alone; return the NIS.

    ``kind`` KNOW_ALL takes headings and gyro biases as known, KNOW_COMMON the biases and what the
    headings have in common, KEEP_PLACE corrects neither position nor heading.
    """
    if kind == KNOW_ALL:
        nis = considering_gain(w, rows, consider_all(w, rows))
    elif kind == KNOW_COMMON:
        nis = considering_gain(w, rows, consider_common(w, rows))
    else:
        nis = considering_gain(w, rows, 0)
        for k in range(rows):
            for side in range(2):
                w[S_K + JOINT * k + SIDE * side + E_ATT + 2] = 0.0
                for j in range(3):
                    w[S_K + JOINT * k + SIDE * side + E_POS + j] = 0.0
    apply_gain(w, rows)
    feed_back(w)
    return nis


def considered(state):
    """Return whether an error state of a standing foot is its position or heading."""
    return state < E_VEL or state == E_ATT + 2


def factor(w, rows):
    """Write V = P H' S^-1/2 to S_G and the estimated error to S_DX; return the NIS.

    S = L D L', factored row by row with each column of P H' and the innovation carried along.  A
    row whose variance is not positive is left out: nothing can be learnt from it.
    """
    nis = 0.0
    for k in range(rows):
        g = S_G + JOINT * k
        d = w[S_S + ROWS_MOST * k + k]
        z = w[S_Y + k]
        for m in range(k):
            x = w[S_S + ROWS_MOST * m + k]  # already divided by sqrt(d_m)
            d -= x * x
            z -= x * w[S_Y + m]
            for j in range(JOINT):
                w[g + j] -= x * w[S_G + JOINT * m + j]
        scale = 1.0 / math.sqrt(d) if d > 0.0 else 0.0
        z = z * scale
        w[S_Y + k] = z
        nis += z * z
        for j in range(JOINT):
            w[g + j] *= scale
        for m in range(k + 1, rows):
            x = w[S_S + ROWS_MOST * k + m]
            for i in range(k):
                x -= w[S_S + ROWS_MOST * i + k] * w[S_S + ROWS_MOST * i + m]
            w[S_S + ROWS_MOST * k + m] = x * scale
    for k in range(rows, ROWS_MOST):
        w[S_Y + k] = 0.0
        for j in range(JOINT):
            w[S_G + JOINT * k + j] = 0.0
    for j in range(JOINT):  # K y = V z
        w[S_DX + j] = (
            w[S_G + j] * w[S_Y]
            + w[S_G + JOINT + j] * w[S_Y + 1]
            + w[S_G + 2 * JOINT + j] * w[S_Y + 2]
        )
    return nis


def downdate(w):
    """Subtract V V' from P, V the three columns at S_G.

    Element (i, j) and element (j, i) are the same sums in the same order, so P stays symmetric to
    the bit without a mirror.
    """
    for i in range(15):
        a0 = w[S_G + i]
        a1 = w[S_G + JOINT + i]
        a2 = w[S_G + 2 * JOINT + i]
        b0 = w[S_G + SIDE + i]
        b1 = w[S_G + JOINT + SIDE + i]
        b2 = w[S_G + 2 * JOINT + SIDE + i]
        for j in range(15):
            l0 = w[S_G + j]
            l1 = w[S_G + JOINT + j]
            l2 = w[S_G + 2 * JOINT + j]
            r0 = w[S_G + SIDE + j]
            r1 = w[S_G + JOINT + SIDE + j]
            r2 = w[S_G + 2 * JOINT + SIDE + j]
            w[PLL + ROW * i + j] -= a0 * l0 + a1 * l1 + a2 * l2
            w[PRR + ROW * i + j] -= b0 * r0 + b1 * r1 + b2 * r2
            w[PLR + ROW * i + j] -= a0 * r0 + a1 * r1 + a2 * r2


def feed_back(w):
    """Take the estimated error S_DX off the nominal states; the rotation is exact."""
    for foot in range(2):
        o = foot * FOOT
        d = S_DX + SIDE * foot
        for i in range(3):
            w[o + POS + i] -= w[d + E_POS + i]
            w[o + VEL + i] -= w[d + E_VEL + i]
            w[o + BG + i] += w[d + E_BG + i]  # the bias states are truth minus estimate
            w[o + BA + i] += w[d + E_BA + i]
        rotation_increment(w, w[d + E_ATT], w[d + E_ATT + 1], w[d + E_ATT + 2])
        rotate_navigation(w, foot)


def zupt(w, foot, still=False):
    """Zero-velocity update of one foot, eq. (12), at the point about which the foot pivots.

    With the pivot at ``l`` from the sensor (navigation axes), the sensor moves with
    v = -P omega x l while the foot rolls over: h(x) = v + P omega x l is zero.  P keeps the
    horizontal part of the angular rate: a foot that turns about the vertical turns under its ball,
    not about ``l``.  The rows are [0, I, [P omega x][l x] - [l x] P [omega x], -[l x] P R_nb, 0];
    a lever arm of zero is the paper's eq. (12).  ``still`` takes the noise of a standstill, in
    which nothing moves, for that of a stance.
    """
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
    # H: velocity I, gyro bias -[l x] P R_nb
    for k in range(ROWS_MOST * JOINT):
        w[S_H + k] = 0.0
    h = S_H + SIDE * foot
    for i in range(3):
        w[h + (JOINT + 1) * i + E_VEL] = 1.0
        w[h + E_BG + i] = lz * w[r + 3 + i]
        w[h + JOINT + E_BG + i] = -lz * w[r + i]
        w[h + 2 * JOINT + E_BG + i] = ly * w[r + i] - lx * w[r + 3 + i]
    # H: attitude [P omega x][l x] - [l x] P [omega x]
    w[h + E_ATT] = lz * wz - wy * ly
    w[h + E_ATT + 1] = wy * lx
    w[h + E_ATT + 2] = -lz * wx
    w[h + JOINT + E_ATT] = wx * ly
    w[h + JOINT + E_ATT + 1] = lz * wz - wx * lx
    w[h + JOINT + E_ATT + 2] = -lz * wy
    w[h + 2 * JOINT + E_ATT] = wx * lz - lx * wz
    w[h + 2 * JOINT + E_ATT + 1] = wy * lz - ly * wz
    # innovation v + P omega x l, estimate minus zero; the velocity is added below
    w[S_Y] = wy * lz
    w[S_Y + 1] = -wx * lz
    w[S_Y + 2] = wx * ly - wy * lx
    collect_zupt(w, foot)
    noise = w[C_ZUPT_STILL_VAR] if still else w[C_ZUPT_VAR]
    noise += w[C_ZUPT_RATE_VAR] * (wx * wx + wy * wy + wz * wz)
    info = Z_LEFT + foot * ZUPT_INFO
    for i in range(3):
        w[S_S + (ROWS_MOST + 1) * i] += noise
        w[S_Y + i] += w[o + VEL + i]
        w[info + i] = w[S_Y + i]
    for i in range(ROWS_MOST * ROWS_MOST):
        w[info + Z_S + i] = w[S_S + i]
    if w[C_ZUPT_CONSIDERS] == 1.0 and bias_known(w, foot):
        w[info + Z_NIS] = correct_stance(w, 3, foot, still)
    elif still:
        w[info + Z_NIS] = correct_standing(w, 3, foot)
    else:
        w[info + Z_NIS] = correct(w, 3)


def collect_zupt(w, foot):
    """Do what `collect` does for the sparse rows of a zero-velocity update.

    Row k of H has a one at velocity k and, besides, only attitude and gyro bias of the own foot.
    """
    own = PLL if foot == 0 else PRR
    for k in range(3):
        g = S_G + JOINT * k + SIDE * foot
        x = S_G + JOINT * k + SIDE * (1 - foot)
        h = S_H + JOINT * k + SIDE * foot
        for j in range(ROW):
            total = w[own + ROWS_VEL + ROW * k + j]
            for i in range(E_ATT, E_BA):
                total += w[h + i] * w[own + ROW * i + j]
            w[g + j] = total
        if foot == 0:
            for j in range(ROW):
                total = w[PLR + ROWS_VEL + ROW * k + j]
                for i in range(E_ATT, E_BA):
                    total += w[h + i] * w[PLR + ROW * i + j]
                w[x + j] = total
        else:
            for j in range(15):
                total = w[PLR + ROW * j + E_VEL + k]
                for i in range(E_ATT, E_BA):
                    total += w[h + i] * w[PLR + ROW * j + i]
                w[x + j] = total
            w[x + 15] = 0.0  # the pad, which a row of the block brings along on the other side
    for k in range(3):
        for m in range(k, 3):
            g = S_G + JOINT * m + SIDE * foot
            h = S_H + JOINT * k + SIDE * foot
            total = w[g + E_VEL + k]
            for i in range(E_ATT, E_BA):
                total += w[h + i] * w[g + i]
            w[S_S + ROWS_MOST * k + m] = total
            w[S_S + ROWS_MOST * m + k] = total
