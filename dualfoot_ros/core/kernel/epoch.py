"""One epoch of the tracker, the loop over many, and the re-run after a roll-back.

Live and batch both go through ``advance``: live with one sample, batch with all of them.  It
stops after every epoch that set a notice, because what a notice asks for (a constraint, a re-run)
is decided by the tracker and not here.
"""

import math

from .covariance import propagate_foot
from .detector import detect
from .floor import carry, floor_moves, watch_floor
from .layout import (
    A_COUNT,
    A_FOOT,
    A_SECONDS,
    A_SQUARES,
    A_STRIDE,
    A_SUM,
    C_HEIGHT_DRIFT,
    C_WATCH,
    E_ATT,
    E_POS,
    E_VEL,
    FLAG_STILL,
    FLOOR_STD,
    FLOOR_UP_STD,
    FLOOR_VEL,
    FOOT,
    N_BACK,
    N_EPOCH,
    N_FLAGS,
    N_FOOT,
    N_GONE,
    N_NOTICE,
    N_OLDEST,
    N_RING,
    N_START,
    N_STILL,
    N_STRIDE,
    NOTICE_BACK,
    NOTICE_FLOOR,
    NOTICE_GONE,
    NOTICE_SHIFT,
    NOTICE_STOOD,
    NOTICE_WATCH,
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
    RINGS,
    ROT,
    ROW,
    S_CDT,
    S_SF,
    SAMPLE,
    STATE,
    STOOD_S,
    VEL,
    WALKED,
    Z_LEFT,
    ZUPT_INFO,
)
from .strapdown import mechanize, orthonormalise
from .zero_velocity import zupt

ORTHONORMAL_EVERY = 32768  # epochs, over which rounding turns an attitude by 1e-13


def filter_epoch(w, n, epoch):
    """Run the filter over a stored epoch: eqs (1)-(3), (7)-(11) and, in stance, (12).

    Both feet are propagated before either is corrected: a correction moves both.
    """
    i = epoch % n[N_RING]
    sample = RINGS + SAMPLE * i
    dt = w[sample]
    flags = n[N_FLAGS + i]
    still = flags // FLAG_STILL
    for foot in range(2):
        if missing(w, sample + 1 + 6 * foot):
            hold(w, foot, dt)
            continue
        o = foot * FOOT + POS
        x = w[o]
        y = w[o + 1]
        z = w[o + 2]
        mechanize(w, foot, dt, sample + 1 + 6 * foot)  # eqs (1)-(3)
        propagate_foot(w, foot, dt)  # eqs (7)-(11), with the attitude before the step
        if (still >> foot) & 1:  # a standing foot stays where it is
            w[o] = x
            w[o + 1] = y
            w[o + 2] = z
    if flags % FLAG_STILL != 3:  # one foot swings
        w[WALKED] += dt
    for foot in range(2):
        if (flags >> foot) & 1:
            zupt(w, foot, (still >> foot) & 1 == 1)  # eq. (12)
        else:
            for k in range(ZUPT_INFO):
                w[Z_LEFT + foot * ZUPT_INFO + k] = 0.0
    if floor_moves(w):
        carry(w, dt)
    if epoch % ORTHONORMAL_EVERY == ORTHONORMAL_EVERY - 1:
        orthonormalise(w, 0)
        orthonormalise(w, 1)


def missing(w, sample):
    """Return whether the sample of a foot at index ``sample`` is not there: nan."""
    return w[sample] != w[sample]


def hold(w, foot, dt):
    """Keep a foot without samples where it is; its position becomes as uncertain as its speed."""
    for i in range(9):
        w[S_CDT + i] = 0.0
    for i in range(3):
        w[S_SF + i] = 0.0
    propagate_foot(w, foot, dt)


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


def save(w, n, epoch):
    """Keep a snapshot of the state before ``epoch``."""
    ring = n[N_RING]
    o = RINGS + SAMPLE * ring + STATE * (epoch % ring)
    for k in range(STATE):
        w[o + k] = w[k]


def restore(w, n, epoch):
    """Go back to the state before ``epoch``; it must not be older than n[N_OLDEST]."""
    ring = n[N_RING]
    o = RINGS + SAMPLE * ring + STATE * (epoch % ring)
    for k in range(STATE):
        w[k] = w[o + k]


def rerun(w, n, first, last):
    """Run the filter again over the stored epochs first..last, renewing the snapshots."""
    for epoch in range(first, last + 1):
        save(w, n, epoch)
        filter_epoch(w, n, epoch)


def set_flags(n, foot, first, last, value):
    """Set or clear the zero-velocity flag of ``foot`` over the stored epochs first..last."""
    for epoch in range(first, last + 1):
        i = N_FLAGS + epoch % n[N_RING]
        if value:
            n[i] = n[i] | (1 << foot)
        else:
            n[i] = n[i] & ~(1 << foot)


def advance(w, n, dts, samples, start, stop, out):
    """Run epochs ``start..stop-1`` of ``samples`` (N, 12) with intervals ``dts`` (N,) s.

    Each writes its row of ``out`` (N, OUT).  Returns the index after the last epoch that was run:
    ``stop``, or earlier when an epoch set n[N_NOTICE].
    """
    ring = n[N_RING]
    for k in range(start, stop):
        epoch = n[N_EPOCH] + 1
        n[N_EPOCH] = epoch
        if epoch - n[N_OLDEST] >= ring:
            n[N_OLDEST] = epoch - ring + 1
        i = epoch % ring
        o = RINGS + SAMPLE * i
        w[o] = dts[k]
        for j in range(12):
            w[o + 1 + j] = samples[k, j]
        save(w, n, epoch)  # the state before the epoch: where a roll-back begins
        presence = watch_presence(w, n, 0, o + 1) | watch_presence(w, n, 1, o + 7)
        left, left_notice = detect(w, n, 0)
        right, right_notice = detect(w, n, 1)
        flags = 0
        if left:
            flags = 1 + FLAG_STILL * stands(n, 0)
        if right:
            flags += 2 + 2 * FLAG_STILL * stands(n, 1)
        n[N_FLAGS + i] = flags
        n[N_NOTICE] = left_notice | (right_notice << NOTICE_SHIFT) | presence
        for foot in range(2):
            if collect_stand(w, foot, (flags // FLAG_STILL >> foot) & 1, o):
                n[N_NOTICE] = n[N_NOTICE] | (NOTICE_STOOD << foot)
        filter_epoch(w, n, epoch)
        if watch_floor(w, n, dts[k]):
            n[N_NOTICE] = n[N_NOTICE] | NOTICE_FLOOR
        if squared_distance(w) > w[C_WATCH]:
            n[N_NOTICE] = n[N_NOTICE] | NOTICE_WATCH
        emit(w, n, out, k)
        if n[N_NOTICE] != 0:
            return k + 1
    return stop


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
