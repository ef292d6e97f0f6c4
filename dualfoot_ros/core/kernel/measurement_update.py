"""Measurement updates of the error-state Kalman filter and the feedback to the nominal states.

Every measurement of up to three rows goes one way: ``collect`` builds P H', S and leaves them in
scratch, ``correct`` factors S = L D L', takes P - V V' in one exactly symmetric pass and feeds the
estimated error back.  P is never inverted, so a covariance that an equality constraint has made
singular is no trouble.  Errors are estimate minus truth (Liu et al. 2023, section III-C); the
attitude error is that of C_hat = (I - [phi x]) C, and the biases of eq. (6) are what is left of
them, truth minus estimate, so they are fed back with the other sign.
"""

import math

from .layout import (
    BA,
    BG,
    CONSIDERED,
    E_ATT,
    E_BA,
    E_BG,
    E_POS,
    E_VEL,
    FOOT,
    JOINT,
    KNOW_ALL,
    KNOW_COMMON,
    PLACE,
    PLL,
    PLR,
    POS,
    PRR,
    ROW,
    ROWS_MOST,
    S_DX,
    S_G,
    S_H,
    S_K,
    S_S,
    S_Y,
    SIDE,
    VEL,
    lanes,
)
from .schmidt.considered_states import KNOWN, consider_all, consider_common
from .schmidt.considered_update import clear_rest, considering_gain
from .schmidt.stance_gain import knowing_all
from .strapdown import rotate_navigation, rotation_increment
from .tiles import turn_over
from .turn import keeps_gauge, turn_correction


def collect(w, rows):
    """Write P H' to S_G and H P H' to S_S for the ``rows`` rows at S_H (30 columns, dense)."""
    for k in range(rows):
        g = S_G + JOINT * k
        h = S_H + JOINT * k
        for j in lanes(JOINT):
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


def correct_considering(w, rows, kind):
    """Update with a gain that leaves some states alone; return the NIS.

    ``kind`` KNOW_ALL takes headings and gyro biases as known, KNOW_COMMON the biases and what the
    headings have in common, KEEP_PLACE corrects neither position nor heading.
    """
    clear_rest(w, rows)
    if kind == KNOW_ALL:
        consider_all(w)
        turn_over(w, PLR, KNOWN, E_BA)
        nis = knowing_all(w)
    elif kind == KNOW_COMMON:
        consider_common(w)
        nis = considering_gain(w, CONSIDERED)
    else:
        nis = considering_gain(w, 0)
        for k in range(ROWS_MOST):
            for side in range(2):
                w[S_K + JOINT * k + SIDE * side + E_ATT + 2] = 0.0
                for j in range(3):
                    w[S_K + JOINT * k + SIDE * side + E_POS + j] = 0.0
    weigh(w, 0, JOINT)
    take_products(w, PLL, 0, 0)
    take_products(w, PRR, SIDE, SIDE)
    take_products(w, PLR, 0, SIDE)
    feed_back(w)
    return nis


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
            for j in lanes(JOINT):
                w[g + j] -= x * w[S_G + JOINT * m + j]
        scale = 1.0 / math.sqrt(d) if d > 0.0 else 0.0
        z = z * scale
        w[S_Y + k] = z
        nis += z * z
        for j in lanes(JOINT):
            w[g + j] *= scale
        for m in range(k + 1, rows):
            x = w[S_S + ROWS_MOST * k + m]
            for i in range(k):
                x -= w[S_S + ROWS_MOST * i + k] * w[S_S + ROWS_MOST * i + m]
            w[S_S + ROWS_MOST * k + m] = x * scale
    for k in range(rows, ROWS_MOST):
        w[S_Y + k] = 0.0
        for j in lanes(JOINT):
            w[S_G + JOINT * k + j] = 0.0
    for j in lanes(JOINT):  # K y = V z
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
    """Take the estimated error S_DX off the nominal states of both feet."""
    feed_back_foot(w, 0)
    feed_back_foot(w, 1)


def feed_back_foot(w, foot):
    """Take the estimated error S_DX off the nominal state of ``foot``; the rotation is exact."""
    o = foot * FOOT
    d = S_DX + SIDE * foot
    for i in range(3):
        w[o + POS + i] -= w[d + E_POS + i]
        w[o + VEL + i] -= w[d + E_VEL + i]
        w[o + BG + i] += w[d + E_BG + i]  # the bias states are truth minus estimate
        w[o + BA + i] += w[d + E_BA + i]
    rotation_increment(w, w[d + E_ATT], w[d + E_ATT + 1], w[d + E_ATT + 2])
    rotate_navigation(w, foot)
    if keeps_gauge(w, foot):
        turn_correction(w, foot)


def weigh(w, side, count):
    """Write M = G - K S / 2 in the place of G, and K y to S_DX; ``count`` states at ``side``."""
    side &= PLACE
    for k in range(ROWS_MOST):
        s0 = w[S_S + k]
        s1 = w[S_S + ROWS_MOST + k]
        s2 = w[S_S + 2 * ROWS_MOST + k]
        for j in lanes(count):
            x = S_K + side + j
            total = w[x] * s0 + w[x + JOINT] * s1 + w[x + 2 * JOINT] * s2
            w[S_G + JOINT * k + side + j] -= 0.5 * total
    y0 = w[S_Y]
    y1 = w[S_Y + 1]
    y2 = w[S_Y + 2]
    for j in lanes(count):
        x = S_K + side + j
        w[S_DX + side + j] = w[x] * y0 + w[x + JOINT] * y1 + w[x + 2 * JOINT] * y2


def take_products(w, block, a, b):
    """Subtract M K' + K M' from a block, with the rows of the foot at ``a``, columns at ``b``."""
    block &= PLACE
    a &= PLACE
    b &= PLACE
    for i in range(15):
        m0 = w[S_G + a + i]
        m1 = w[S_G + JOINT + a + i]
        m2 = w[S_G + 2 * JOINT + a + i]
        k0 = w[S_K + a + i]
        k1 = w[S_K + JOINT + a + i]
        k2 = w[S_K + 2 * JOINT + a + i]
        for j in lanes(ROW):
            m = S_G + b + j
            k = S_K + b + j
            # the two products of a pair stay the same when i and j change places
            w[block + ROW * i + j] -= (
                (m0 * w[k] + k0 * w[m])
                + (m1 * w[k + JOINT] + k1 * w[m + JOINT])
                + (m2 * w[k + 2 * JOINT] + k2 * w[m + 2 * JOINT])
            )
