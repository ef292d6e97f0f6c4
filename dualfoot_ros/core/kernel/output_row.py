"""The row of an epoch: what the tracker tells of both feet, laid out as in `layout`."""

import math

from .floor import floor_moves
from .layout import (
    C_HEIGHT_DRIFT,
    E_ATT,
    E_POS,
    E_VEL,
    FLOOR_STD,
    FLOOR_UP_STD,
    FLOOR_VEL,
    FOOT,
    N_EPOCH,
    N_FLAGS,
    N_FOOT,
    N_GONE,
    N_RING,
    N_STRIDE,
    O_COV_ATT,
    O_COV_POS,
    O_COV_VEL,
    O_FOOT,
    O_POS,
    O_PRESENT,
    O_QUAT,
    O_RATE,
    O_RELATIVE,
    O_STANCE,
    O_VEL,
    O_ZUPT,
    PLL,
    PLR,
    POS,
    PRR,
    RATE,
    ROT,
    ROW,
    VEL,
    WALKED,
    Z_LEFT,
    ZUPT_INFO,
)


def emit(w, n, out, k):
    """Write the state to row ``k`` of ``out`` (N, OUT), laid out as in ``layout``.

    What scale, misalignment and the rolling of the foot leave of the vertical velocity is alike in
    every stride and in both feet, so the error of the height grows with the time walked and not
    with its root.  It is no state: the variance that is told takes (drift t)^2 beside that of P.
    """
    drifted = w[C_HEIGHT_DRIFT] * w[WALKED] * w[WALKED]
    flags = n[N_FLAGS + n[N_EPOCH] % n[N_RING]]
    for foot in range(2):
        s = foot * FOOT
        o = foot * O_FOOT
        for i in range(3):
            out[k, o + O_POS + i] = w[s + POS + i]
            out[k, o + O_VEL + i] = w[s + VEL + i]
            out[k, o + O_RATE + i] = w[s + RATE + i]
        out[k, o + O_STANCE] = (flags >> foot) & 1
        out[k, o + O_PRESENT] = 1 - n[N_FOOT + foot * N_STRIDE + N_GONE]
        quaternion(w, s + ROT, out, k, o + O_QUAT)
        block = PLL if foot == 0 else PRR
        for i in range(3):
            for j in range(3):
                m = 3 * i + j
                out[k, o + O_COV_POS + m] = w[block + ROW * (E_POS + i) + E_POS + j]
                out[k, o + O_COV_VEL + m] = w[block + ROW * (E_VEL + i) + E_VEL + j]
                out[k, o + O_COV_ATT + m] = w[block + ROW * (E_ATT + i) + E_ATT + j]
        out[k, o + O_COV_POS + 8] += drifted
        for i in range(ZUPT_INFO):
            out[k, o + O_ZUPT + i] = w[Z_LEFT + foot * ZUPT_INFO + i]
    if floor_moves(w):
        emit_floor(w, out, k)
    for i in range(3):
        for j in range(3):
            out[k, O_RELATIVE + 3 * i + j] = (
                w[PLL + ROW * i + j]
                + w[PRR + ROW * i + j]
                - (w[PLR + ROW * i + j] + w[PLR + ROW * j + i])
            )


def emit_floor(w, out, k):
    """Add the velocity of the floor to that of both feet in row ``k`` of ``out`` (N, OUT)."""
    for foot in range(2):
        o = foot * O_FOOT
        for i in range(3):
            std = w[FLOOR_UP_STD] if i == 2 else w[FLOOR_STD]
            out[k, o + O_VEL + i] += w[FLOOR_VEL + i]
            out[k, o + O_COV_VEL + 4 * i] += std * std


def quaternion(w, r, out, k, o):
    """Write the Hamilton quaternion (x, y, z, w >= 0) of the rotation at ``r``."""
    m00 = w[r]
    m11 = w[r + 4]
    m22 = w[r + 8]
    trace = m00 + m11 + m22
    if trace > 0.0:
        s = 2.0 * math.sqrt(1.0 + trace)
        x = (w[r + 7] - w[r + 5]) / s
        y = (w[r + 2] - w[r + 6]) / s
        z = (w[r + 3] - w[r + 1]) / s
        q = 0.25 * s
    elif m00 > m11 and m00 > m22:
        s = 2.0 * math.sqrt(1.0 + m00 - m11 - m22)
        x = 0.25 * s
        y = (w[r + 1] + w[r + 3]) / s
        z = (w[r + 2] + w[r + 6]) / s
        q = (w[r + 7] - w[r + 5]) / s
    elif m11 > m22:
        s = 2.0 * math.sqrt(1.0 + m11 - m00 - m22)
        x = (w[r + 1] + w[r + 3]) / s
        y = 0.25 * s
        z = (w[r + 5] + w[r + 7]) / s
        q = (w[r + 2] - w[r + 6]) / s
    else:
        s = 2.0 * math.sqrt(1.0 + m22 - m00 - m11)
        x = (w[r + 2] + w[r + 6]) / s
        y = (w[r + 5] + w[r + 7]) / s
        z = 0.25 * s
        q = (w[r + 3] - w[r + 1]) / s
    if q < 0.0:
        x = -x
        y = -y
        z = -z
        q = -q
    out[k, o] = x
    out[k, o + 1] = y
    out[k, o + 2] = z
    out[k, o + 3] = q
