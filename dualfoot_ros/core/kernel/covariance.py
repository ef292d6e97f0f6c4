"""Time propagation of the 30x30 covariance, eqs (5)-(11) of Liu et al. 2023.

Phi = I + F dt is block-diagonal over the feet and sparse within a foot, so it is applied row by
row and never built.  ``Phi (P + Q dt/2) Phi' + Q dt/2`` is eq. (8).  Eq. (6) of the paper writes
diag(tau) for the biases; a first-order Markov process needs -1/tau, which is what stands here.
"""

from .layout import (
    BLOCK,
    C_BIAS_RATE,
    C_Q_ATT,
    C_Q_BA,
    C_Q_BG,
    C_Q_VEL,
    DIAGONAL,
    E_ATT,
    E_BA,
    E_BG,
    E_VEL,
    PLACE,
    PLL,
    PLR,
    PRR,
    ROW,
    ROWS_ATT,
    ROWS_BA,
    ROWS_BG,
    ROWS_POS,
    ROWS_VEL,
    S_A,
    S_CDT,
    S_SF,
    lanes,
)
from .tiles import mirror, turn_back, turn_over


def add_noise(w, block, dt):
    """Add half of the process noise of one epoch to the diagonal of a foot's block."""
    h = 0.5 * dt
    for i in range(3):
        w[block + DIAGONAL * (E_VEL + i)] += w[C_Q_VEL] * h
        w[block + DIAGONAL * (E_ATT + i)] += w[C_Q_ATT] * h
        w[block + DIAGONAL * (E_BG + i)] += w[C_Q_BG] * h
        w[block + DIAGONAL * (E_BA + i)] += w[C_Q_BA] * h


def apply_transition(w, block, dt):
    """Multiply the 15x16 block at ``block`` by Phi of eqs (6)-(8) from the left, in its place.

    Phi is given by S_CDT (R_nb dt) and S_SF (f_n dt) of the foot just mechanized.  One offset for
    what is read and written lets a compiler see that columns do not depend on each other.
    """
    # f_n dt and R_nb dt: the blocks of F, eq. (6), that are neither zero nor the identity
    fx = w[S_SF]
    fy = w[S_SF + 1]
    fz = w[S_SF + 2]
    c00 = w[S_CDT]
    c01 = w[S_CDT + 1]
    c02 = w[S_CDT + 2]
    c10 = w[S_CDT + 3]
    c11 = w[S_CDT + 4]
    c12 = w[S_CDT + 5]
    c20 = w[S_CDT + 6]
    c21 = w[S_CDT + 7]
    c22 = w[S_CDT + 8]
    m = 1.0 - dt * w[C_BIAS_RATE]  # first-order Markov biases
    block &= PLACE
    for j in lanes(ROW):
        p = block + j
        v0 = w[p + ROWS_VEL]
        v1 = w[p + ROWS_VEL + ROW]
        v2 = w[p + ROWS_VEL + 2 * ROW]
        a0 = w[p + ROWS_ATT]
        a1 = w[p + ROWS_ATT + ROW]
        a2 = w[p + ROWS_ATT + 2 * ROW]
        g0 = w[p + ROWS_BG]
        g1 = w[p + ROWS_BG + ROW]
        g2 = w[p + ROWS_BG + 2 * ROW]
        b0 = w[p + ROWS_BA]
        b1 = w[p + ROWS_BA + ROW]
        b2 = w[p + ROWS_BA + 2 * ROW]
        # position: dr' = v
        w[p + ROWS_POS] = w[p + ROWS_POS] + dt * v0
        w[p + ROWS_POS + ROW] = w[p + ROWS_POS + ROW] + dt * v1
        w[p + ROWS_POS + 2 * ROW] = w[p + ROWS_POS + 2 * ROW] + dt * v2
        # velocity: dv' = f_n x phi + R_nb b_a
        w[p + ROWS_VEL] = v0 + (fy * a2 - fz * a1) + (c00 * b0 + c01 * b1 + c02 * b2)
        w[p + ROWS_VEL + ROW] = v1 + (fz * a0 - fx * a2) + (c10 * b0 + c11 * b1 + c12 * b2)
        w[p + ROWS_VEL + 2 * ROW] = v2 + (fx * a1 - fy * a0) + (c20 * b0 + c21 * b1 + c22 * b2)
        # attitude: phi' = -R_nb b_g
        w[p + ROWS_ATT] = a0 - (c00 * g0 + c01 * g1 + c02 * g2)
        w[p + ROWS_ATT + ROW] = a1 - (c10 * g0 + c11 * g1 + c12 * g2)
        w[p + ROWS_ATT + 2 * ROW] = a2 - (c20 * g0 + c21 * g1 + c22 * g2)
        # biases: b' = -b / tau
        w[p + ROWS_BG] = m * g0
        w[p + ROWS_BG + ROW] = m * g1
        w[p + ROWS_BG + 2 * ROW] = m * g2
        w[p + ROWS_BA] = m * b0
        w[p + ROWS_BA + ROW] = m * b1
        w[p + ROWS_BA + 2 * ROW] = m * b2


def apply_from_right(w, block, dt):
    """Multiply the 15x15 block at ``block`` by Phi' from the right, in its place."""
    turn_over(w, block, 0, ROW)
    apply_transition(w, S_A, dt)
    turn_back(w, block)


def complete(w, block, dt):
    """Multiply Phi P, which is at ``block``, by Phi' from the right, in its place.

    The product is symmetric: of what is computed, Phi (Phi P)', the upper triangle is taken for
    both, so that it is symmetric to the bit.
    """
    turn_over(w, block, 0, ROW)
    apply_transition(w, S_A, dt)
    mirror(w, block)


def propagate_foot(w, foot, dt, coupled=True):
    """Propagate a foot's own block and its side of the cross block, right after `mechanize`.

    The cross block is Phi_L P_LR Phi_R': the left foot's turn takes it from the left, the right
    foot's from the right.  While it is zero (``coupled`` is False) it stays so.
    """
    if foot == 0:
        propagate_block(w, PLL, dt)
        if coupled:
            apply_transition(w, PLR, dt)
    else:
        propagate_block(w, PRR, dt)
        if coupled:
            apply_from_right(w, PLR, dt)


def propagate_block(w, block, dt):
    """Propagate a foot's own block, eq. (8): Phi (P + Q dt/2) Phi' + Q dt/2."""
    add_noise(w, block, dt)
    apply_transition(w, block, dt)
    complete(w, block, dt)
    add_noise(w, block, dt)


def correlated(w):
    """Return whether the feet are correlated: whether the cross block holds anything."""
    if w[PLR] != 0.0:
        return True
    found = 0
    for k in lanes(BLOCK):
        found = found | (w[PLR + k] != 0.0)
    return found != 0
