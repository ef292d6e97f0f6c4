"""Turning and moving a foot's track: heading is a gauge, so this is exact at any time.

A foot's sensor cannot tell that its whole track is turned about the vertical.  Such a turn by
theta is the error g = theta (z x p, z x v) of position and velocity and -theta of the heading, and
none of level, biases or the other foot's.  Propagation keeps g.  The update of an error-state
filter does not: its row shows theta z x y, y being the innovation, where a turn cannot be seen,
and afterwards g is still that of the position and velocity before the correction.  This changes a
walk of minutes by millimetres.  But biases and positions come to depend on the heading by more and
more: with any heading variance it grows e-fold in about half an hour.

So in a long walk, and while the heading is too uncertain to be a small angle, a foot goes over to
the errors of the invariant filter (Barrau and Bonnabel 2017, IEEE Trans. Automatic Control 62(4),
section IV): H g = 0, and what is corrected turns with the heading, P <- T P T', T adding
phi_z (z x dx) to the errors of position and velocity from which dx has been taken.
"""

from typing import Any

from .layout import (
    DIAGONAL,
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
    S_DX,
    SIDE,
    TRACKED,
    VEL,
)

LONG_S = 1800.0  # s, of a long walk
SMALL_ANGLE = 0.3  # rad, up to which the error of a heading is a small angle
SMALL_VARIANCE = SMALL_ANGLE * SMALL_ANGLE
HEADING = E_ATT + 2


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


def keeps_gauge(w: Any, foot: int) -> bool:
    """Return whether updates must leave to ``foot`` what a turn of its whole track is."""
    block = PLL if foot == 0 else PRR
    return bool(w[TRACKED] > LONG_S or w[block + DIAGONAL * HEADING] > SMALL_VARIANCE)


def turn_correction(w, foot):
    """Let the estimated error S_DX, which was taken off ``foot``, turn with its heading."""
    d = S_DX + SIDE * foot
    for i in range(2):
        e = E_POS if i == 0 else E_VEL
        add_heading(w, foot, e, -w[d + e + 1])
        add_heading(w, foot, e + 1, w[d + e])


def add_heading(w, foot, state, factor):
    """Add ``factor`` times the heading error of ``foot`` to another error state of it."""
    block = PLL if foot == 0 else PRR
    row = block + ROW * state
    heading = block + ROW * HEADING
    turned = w[row + HEADING] + factor * w[heading + HEADING]
    variance = w[row + state] + factor * (w[row + HEADING] + turned)
    for j in range(15):
        w[row + j] += factor * w[heading + j]
    w[row + state] = variance
    for j in range(15):
        w[block + ROW * j + state] = w[row + j]
    for j in range(15):
        if foot == 0:
            w[PLR + ROW * state + j] += factor * w[PLR + ROW * HEADING + j]
        else:
            w[PLR + ROW * j + state] += factor * w[PLR + ROW * j + HEADING]
