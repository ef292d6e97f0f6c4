"""What an epoch is watched for, and the row that tells of both feet, laid out as in `layout`."""

import math

from ..floor import floor_moves
from ..layout import (
    A_COUNT,
    A_FOOT,
    A_SECONDS,
    A_SQUARES,
    A_STRIDE,
    A_SUM,
    BLOCK,
    C_HEIGHT_DRIFT,
    DIAGONAL,
    E_ATT,
    E_POS,
    E_VEL,
    FLOOR_STD,
    FLOOR_UP_STD,
    FLOOR_VEL,
    FOOT,
    N_BACK,
    N_EPOCH,
    N_FLAGS,
    N_FOOT,
    N_GONE,
    N_RING,
    N_START,
    N_STILL,
    N_STRIDE,
    NOTICE_BACK,
    NOTICE_GONE,
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
    OUT,
    PLL,
    PLR,
    POS,
    PRR,
    RATE,
    ROT,
    ROW,
    STOOD_S,
    TOLD_BLOCK,
    VEL,
    WALKED,
    Z_LEFT,
    ZUPT_INFO,
)

LARGEST = 1.7976931348623157e308  # number there is


def missing(w, sample):
    """Return whether the sample of a foot at index ``sample`` is not there: nan."""
    return w[sample] != w[sample]


def watch_presence(w, n, foot, sample):
    """Take note whether ``foot`` has a sample; return the notice of a change."""
    o = N_FOOT + foot * N_STRIDE
    gone = missing(w, sample)
    if gone and n[o + N_GONE] == 0:
        n[o + N_GONE] = 1
        return NOTICE_GONE << foot
    if not gone and n[o + N_GONE] == 1:
        n[o + N_GONE] = 0
        n[o + N_BACK] = n[N_EPOCH]
        return NOTICE_BACK << foot
    return 0


def collect_stand(w, foot, standing, o):
    """Take the sample at ``o`` into the window of a standing foot; return whether it is full.

    Whoever reads a full window sets its length to zero.
    """
    a = A_FOOT + foot * A_STRIDE
    if standing == 0 or w[a + A_SECONDS] == 0.0:
        for k in range(A_STRIDE):
            w[a + k] = 0.0
    if standing == 0:
        return False
    w[a + A_SECONDS] += w[o]
    w[a + A_COUNT] += 1.0
    for k in range(3):
        rate = w[o + 4 + 6 * foot + k]
        w[a + A_SUM + k] += rate
        w[a + A_SQUARES + k] += rate * rate
    return w[a + A_SECONDS] >= STOOD_S


def stands(n, foot):
    """Return 1 when the stance of ``foot`` has lasted long enough to be a standstill, else 0."""
    if n[N_EPOCH] - n[N_FOOT + foot * N_STRIDE + N_START] >= n[N_STILL]:
        return 1
    return 0


def squared_distance(w):
    """Return the squared distance of the feet, m^2."""
    x = w[POS] - w[FOOT + POS]
    y = w[POS + 1] - w[FOOT + POS + 1]
    z = w[POS + 2] - w[FOOT + POS + 2]
    return x * x + y * y + z * z


def emit(w, n, out, k):
    """Write the state to row ``k`` of ``out`` (N, OUT), laid out as in ``layout``.

    What scale, misalignment and the rolling of the foot leave of the vertical velocity is alike in
    every stride and in both feet, so the error of the height grows with the time walked and not
    with its root.  It is no state: the variance that is told takes (drift t)^2 beside that of P.
    """
    drifted = height_drift(w)
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
            out[k, O_RELATIVE + 3 * i + j] = relative_cell(w, i, j)


def relative_cell(w, i, j):
    """Return a cell of the covariance of left minus right position, m^2."""
    return (
        w[PLL + ROW * i + j] + w[PRR + ROW * i + j] - (w[PLR + ROW * i + j] + w[PLR + ROW * j + i])
    )


def height_drift(w):
    """Return what the drift of the height adds to its variance, m^2."""
    return w[C_HEIGHT_DRIFT] * w[WALKED] * w[WALKED]


def tell(w, told):
    """Write the covariance after the row that ``told`` (1, TOLD) holds.

    Returns whether all of that row is numbers.  Of the blocks (left, right, cross) the rows of
    position, velocity and attitude are told.  Velocities are in the navigation frame: that of the
    floor counts for both feet.  So does the drift of the height, which is alike in both.
    """
    for b in range(3):
        for i in range(TOLD_BLOCK):
            told[0, OUT + TOLD_BLOCK * b + i] = w[PLL + BLOCK * b + i]
    drifted = height_drift(w)
    moves = floor_moves(w)
    for b in range(3):
        o = OUT + TOLD_BLOCK * b
        told[0, o + DIAGONAL * (E_POS + 2)] += drifted
        if moves:
            for i in range(3):
                std = w[FLOOR_UP_STD] if i == 2 else w[FLOOR_STD]
                told[0, o + DIAGONAL * (E_VEL + i)] += std * std
    numbers = 0
    for i in range(OUT):
        if abs(told[0, i]) <= LARGEST:
            numbers += 1
    return numbers == OUT


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
