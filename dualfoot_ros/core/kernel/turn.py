"""Turning and moving a foot's track: heading is a gauge, so this is exact at any time."""

from .layout import (
    E_ATT,
    E_POS,
    E_VEL,
    FLOOR_VEL,
    FOOT,
    PLL,
    PLR,
    POS,
    PRR,
    ROT,
    ROW,
    VEL,
)


def turn_vector(w, index, stride, c, s):
    """Turn the vector at ``index``, ``index + stride`` about z; (c, s) = (cos, sin)."""
    x = w[index]
    y = w[index + stride]
    w[index] = c * x - s * y
    w[index + stride] = s * x + c * y


def turn_rows(w, block, c, s):
    """Turn the position, velocity and attitude rows of a 15x15 block."""
    for j in range(15):
        for e in (E_POS, E_VEL, E_ATT):
            turn_vector(w, block + ROW * e + j, ROW, c, s)


def turn_columns(w, block, c, s):
    """Turn the position, velocity and attitude columns of a 15x15 block."""
    for i in range(15):
        for e in (E_POS, E_VEL, E_ATT):
            turn_vector(w, block + ROW * i + e, 1, c, s)


def symmetrise(w, block):
    """Copy the upper triangle onto the lower one."""
    for i in range(15):
        for j in range(i + 1, 15):
            w[block + ROW * j + i] = w[block + ROW * i + j]


def turn(w, state, foot, c, s, pivot, shift):
    """Turn the track of ``foot`` about the vertical through ``pivot`` (2,), then ``shift`` (3,).

    ``state`` is the index of the state (0, or that of a snapshot).  Nominal states and covariance
    are turned exactly.
    """
    o = state + foot * FOOT
    w[o + POS] -= pivot[0]
    w[o + POS + 1] -= pivot[1]
    turn_vector(w, o + POS, 1, c, s)
    w[o + POS] += pivot[0] + shift[0]
    w[o + POS + 1] += pivot[1] + shift[1]
    w[o + POS + 2] += shift[2]
    turn_vector(w, o + VEL, 1, c, s)
    for j in range(3):
        turn_vector(w, o + ROT + j, 3, c, s)
    block = state + (PLL if foot == 0 else PRR)
    turn_rows(w, block, c, s)
    turn_columns(w, block, c, s)
    symmetrise(w, block)
    if foot == 0:
        turn_rows(w, state + PLR, c, s)
        turn_vector(w, state + FLOOR_VEL, 1, c, s)  # it stands with the left foot
    else:
        turn_columns(w, state + PLR, c, s)
