"""Stance phase of one foot: the GLRT of Skog et al. 2010 and the clean-up of impossible phases.

The detector reads samples only, never the estimate, so a roll-back of the filter does not touch
it.  The window ends at the newest sample; nothing here looks ahead.  What a later sample reveals
(a stance or a swing too short to be one) is said by a notice, and the tracker re-runs the filter.
"""

import math

from .layout import (
    C_FOOT,
    C_GLRT_FORCE,
    C_GLRT_RATE,
    C_GLRT_THRESHOLD,
    C_STILL_NORM,
    C_STILL_RATE,
    C_STRIDE,
    GLRT_LEFT,
    LANDING,
    LEAVING,
    N_EPOCH,
    N_FOOT,
    N_LEAVE,
    N_MIN_STANCE,
    N_MIN_SWING,
    N_PHASE,
    N_RING,
    N_START,
    N_STRIDE,
    N_WINDOW,
    RINGS,
    SAMPLE,
    STANCE,
    STANCE_CONFIRMED,
    STANCE_ENDED,
    STANCE_FALSE,
    SWING,
    SWING_FALSE,
)


def glrt(w, n, foot):
    """Return the GLRT statistic over the newest W samples of ``foot`` (dimensionless).

    T = 1/W sum(|f - g f_mean/|f_mean||^2 / sigma_a^2 + |omega|^2 / sigma_w^2), with g the norm
    and the angular-rate offset both taken from the standstill, so that a bias is no motion.
    """
    still = C_FOOT + foot * C_STRIDE
    bx = w[still + C_STILL_RATE]
    by = w[still + C_STILL_RATE + 1]
    bz = w[still + C_STILL_RATE + 2]
    g = w[still + C_STILL_NORM]
    ring = n[N_RING]
    count = min(n[N_WINDOW], n[N_EPOCH] + 1)
    mx = 0.0
    my = 0.0
    mz = 0.0
    force = 0.0
    rate = 0.0
    i = n[N_EPOCH] % ring
    for _ in range(count):
        s = RINGS + SAMPLE * i + 1 + 6 * foot
        i = i - 1 if i > 0 else ring - 1
        fx = w[s]
        fy = w[s + 1]
        fz = w[s + 2]
        wx = w[s + 3] - bx
        wy = w[s + 4] - by
        wz = w[s + 5] - bz
        mx += fx
        my += fy
        mz += fz
        force += fx * fx + fy * fy + fz * fz
        rate += wx * wx + wy * wy + wz * wz
    mean = math.sqrt(mx * mx + my * my + mz * mz)
    force = force - 2.0 * g * mean + count * g * g
    return (force * w[C_GLRT_FORCE] + rate * w[C_GLRT_RATE]) / count


def detect(w, n, foot):
    """Advance the phase of ``foot`` by the newest sample; return (zero velocity, notice bits)."""
    statistic = glrt(w, n, foot)
    w[GLRT_LEFT + foot] = statistic
    still = statistic < w[C_GLRT_THRESHOLD]
    epoch = n[N_EPOCH]
    o = N_FOOT + foot * N_STRIDE
    phase = n[o + N_PHASE]
    notice = 0
    if phase == SWING:
        if still:
            n[o + N_START] = epoch
            phase = LANDING
    elif phase == LANDING and not still:
        phase = SWING
        notice = STANCE_FALSE
    elif phase == STANCE and not still:
        n[o + N_LEAVE] = epoch
        phase = LEAVING
    elif phase == LEAVING and still:
        phase = STANCE
        notice = SWING_FALSE
    if phase == LANDING and epoch - n[o + N_START] + 1 >= n[N_MIN_STANCE]:
        phase = STANCE
        notice = STANCE_CONFIRMED
    elif phase == LEAVING and epoch - n[o + N_LEAVE] + 1 >= n[N_MIN_SWING]:
        phase = SWING
        notice = STANCE_ENDED
    n[o + N_PHASE] = phase
    return still and phase != SWING, notice
