"""What a trajectory keeps of an epoch, written to where it stays: half of an output row."""

from ..floor import floor_moves
from ..layout import (
    E_ATT,
    E_POS,
    E_VEL,
    FLOOR_STD,
    FLOOR_UP_STD,
    FLOOR_VEL,
    FOOT,
    K_QUAT,
    K_VEL,
    N_EPOCH,
    N_FLAGS,
    N_RING,
    PLL,
    POS,
    PRR,
    ROT,
    ROW,
    VEL,
    Z_LEFT,
    Z_NIS,
    ZUPT_INFO,
)
from .output_row import height_drift, quaternion, relative_cell


def keep(
    w, n, k, left, right, nis, nothing, covariances,
    left_pos, left_vel, left_att, right_pos, right_vel, right_att, relative,
):  # fmt: skip
    """Write the state to row ``k`` of what a trajectory keeps.

    ``left`` and ``right`` (N, KEPT) are the nominal states of the feet, ``nis`` (N, 2) those of
    their zero-velocity updates, ``nothing`` where there is none.  With ``covariances`` the others
    (N, 6) are upper triangles of covariances, symmetric to the bit.
    """
    keep_foot(w, 0, left, k)
    keep_foot(w, 1, right, k)
    flags = n[N_FLAGS + n[N_EPOCH] % n[N_RING]]
    for foot in range(2):
        if (flags >> foot) & 1:
            nis[k, foot] = w[Z_LEFT + foot * ZUPT_INFO + Z_NIS]
        else:
            nis[k, foot] = nothing
    if covariances:
        keep_triangle(w, PLL, E_POS, left_pos, k)
        keep_triangle(w, PLL, E_VEL, left_vel, k)
        keep_triangle(w, PLL, E_ATT, left_att, k)
        keep_triangle(w, PRR, E_POS, right_pos, k)
        keep_triangle(w, PRR, E_VEL, right_vel, k)
        keep_triangle(w, PRR, E_ATT, right_att, k)
        drifted = height_drift(w)
        left_pos[k, 5] += drifted
        right_pos[k, 5] += drifted
        if floor_moves(w):
            blur(w, left_vel, k)
            blur(w, right_vel, k)
        keep_relative(w, relative, k)


def keep_foot(w, foot, out, k):
    """Write position, velocity and attitude of a foot to row ``k`` of ``out`` (N, KEPT)."""
    s = foot * FOOT
    for i in range(3):
        out[k, i] = w[s + POS + i]
        out[k, K_VEL + i] = w[s + VEL + i]
    if floor_moves(w):
        for i in range(3):
            out[k, K_VEL + i] += w[FLOOR_VEL + i]
    quaternion(w, s + ROT, out, k, K_QUAT)


def keep_triangle(w, block, first, out, k):
    """Write the upper triangle of three states of a block from ``first`` on to row ``k``."""
    for i in range(3):
        out[k, i] = w[block + ROW * first + first + i]
    for i in range(2):
        out[k, 3 + i] = w[block + ROW * (first + 1) + first + 1 + i]
    out[k, 5] = w[block + ROW * (first + 2) + first + 2]


def blur(w, out, k):
    """Add what the velocity of the floor is off by to the covariance in row ``k``."""
    out[k, 0] += w[FLOOR_STD] * w[FLOOR_STD]
    out[k, 3] += w[FLOOR_STD] * w[FLOOR_STD]
    out[k, 5] += w[FLOOR_UP_STD] * w[FLOOR_UP_STD]


def keep_relative(w, out, k):
    """Write the upper triangle of the covariance of left minus right position to row ``k``."""
    for i in range(3):
        out[k, i] = relative_cell(w, 0, i)
    for i in range(2):
        out[k, 3 + i] = relative_cell(w, 1, 1 + i)
    out[k, 5] = relative_cell(w, 2, 2)
