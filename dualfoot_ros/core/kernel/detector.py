"""Stance phase of one foot: the GLRT of Skog et al. 2010 and the clean-up of impossible phases.

The detector reads samples only, never the estimate, so a roll-back of the filter does not touch
it.  The window ends at the newest sample; nothing here looks ahead.  What a later sample reveals
(a stance or a swing too short to be one) is said by a notice, and the tracker re-runs the filter.
"""

import math

from .layout import (
    BINS,
    C_ADAPTS,
    C_FOOT,
    C_GLRT_FORCE,
    C_GLRT_RATE,
    C_GLRT_THRESHOLD,
    C_STILL_NORM,
    C_STILL_RATE,
    C_STRIDE,
    D_ACTIVE,
    D_COUNT,
    D_EDGES,
    D_FOOT,
    D_HISTOGRAM,
    D_LEAST,
    D_SKIP,
    D_STRIDE,
    D_THRESHOLD,
    D_VALUES,
    GLRT_LEFT,
    HISTORY,
    LANDING,
    LEAVING,
    N_BACK,
    N_DECIMATE,
    N_EPOCH,
    N_FOOT,
    N_GONE,
    N_LEAVE,
    N_MIN_STANCE,
    N_MIN_SWING,
    N_PHASE,
    N_RING,
    N_SHORT_STANCE,
    N_STANDS,
    N_START,
    N_STRIDE,
    N_WALKING,
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

LOW, HIGH = 0.1, 0.6  # quantiles of the statistic that are of stances and of swings
FIRST, RENEW = 48, 12  # values to the first threshold, and from one to the next
CERTAIN_SWING = 1e4  # statistic that no standing foot has for long
NO_STOP = 1e5  # statistic that no foot has in a stop
CLEAR = 0.25  # share of the threshold below which a short stance counts


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
    count = min(n[N_WINDOW], n[N_EPOCH] + 1 - n[N_FOOT + foot * N_STRIDE + N_BACK])
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


def bin_of(w, statistic):
    """Return the bin of a statistic: the first whose upper edge is above it."""
    low = 0
    high = BINS - 1
    while low < high:
        middle = (low + high) // 2
        if statistic < w[D_EDGES + middle]:
            high = middle
        else:
            low = middle + 1
    return low


def follow(w, n, foot, statistic):
    """Take a statistic into the history of a walking foot, and renew the threshold.

    A foot is quieter in a stop than in any stance of a walk, so what a stop adds to a stance is
    left out: a threshold learnt from it would miss the stances after it.  A stop in which the foot
    moves is none: the threshold that says so was learnt from spikes, and is learnt anew.
    """
    d = D_FOOT + foot * D_STRIDE
    o = N_FOOT + foot * N_STRIDE
    if n[o + N_PHASE] == STANCE and n[N_EPOCH] - n[o + N_START] >= n[N_STANDS]:
        if statistic < NO_STOP:
            return
        forget_walk(w, d)
    if statistic > CERTAIN_SWING:
        w[d + D_ACTIVE] = n[N_WALKING]
    if w[d + D_ACTIVE] <= 0.0:
        return
    w[d + D_ACTIVE] -= 1.0
    w[d + D_SKIP] -= 1.0
    if w[d + D_SKIP] > 0.0:
        return
    w[d + D_SKIP] = n[N_DECIMATE]
    place = bin_of(w, statistic)
    count = int(w[d + D_COUNT])
    slot = d + D_VALUES + count % HISTORY
    if count >= HISTORY:
        w[d + D_HISTOGRAM + int(w[slot])] -= 1.0
    w[slot] = place
    w[d + D_HISTOGRAM + place] += 1.0
    w[d + D_COUNT] = count + 1
    if count >= FIRST and count % RENEW == 0:
        known = min(count + 1, HISTORY)
        low = quantile(w, d, LOW * known)
        high = quantile(w, d, HIGH * known)
        w[d + D_THRESHOLD] = w[D_EDGES + (low + high) // 2]


def forget_walk(w, d):
    """Forget the history of a foot, and go back to the threshold of the start."""
    for k in range(D_THRESHOLD):
        w[d + k] = 0.0
    w[d + D_THRESHOLD] = w[C_GLRT_THRESHOLD]


def quantile(w, d, rank):
    """Return the bin of the value with that rank in the history of a foot."""
    total = 0.0
    for k in range(BINS):
        total += w[d + D_HISTOGRAM + k]
        if total >= rank:
            return k
    return BINS - 1


def leave(w, n, foot):
    """End the phase of a foot without samples; return the notice bits."""
    o = N_FOOT + foot * N_STRIDE
    phase = n[o + N_PHASE]
    n[o + N_PHASE] = SWING
    w[GLRT_LEFT + foot] = 0.0
    if phase == LANDING:
        return STANCE_FALSE
    if phase == STANCE:
        n[o + N_LEAVE] = n[N_EPOCH]
        return STANCE_ENDED
    return STANCE_ENDED if phase == LEAVING else 0


def detect(w, n, foot):
    """Advance the phase of ``foot`` by the newest sample; return (zero velocity, notice bits)."""
    if n[N_FOOT + foot * N_STRIDE + N_GONE] == 1:
        return False, leave(w, n, foot)
    statistic = glrt(w, n, foot)
    w[GLRT_LEFT + foot] = statistic
    d = D_FOOT + foot * D_STRIDE
    threshold = w[C_GLRT_THRESHOLD]
    if w[C_ADAPTS] == 1.0:
        follow(w, n, foot, statistic)
        threshold = w[d + D_THRESHOLD]
    still = statistic < threshold
    epoch = n[N_EPOCH]
    o = N_FOOT + foot * N_STRIDE
    phase = n[o + N_PHASE]
    notice = 0
    if phase == SWING:
        if still:
            n[o + N_START] = epoch
            phase = LANDING
            w[d + D_LEAST] = statistic
    elif phase == LANDING and not still:
        phase = SWING
        notice = STANCE_FALSE
    elif phase == STANCE and not still:
        n[o + N_LEAVE] = epoch
        phase = LEAVING
    elif phase == LEAVING and still:
        phase = STANCE
        notice = SWING_FALSE
    if phase == LANDING:
        w[d + D_LEAST] = min(w[d + D_LEAST], statistic)
        length = epoch - n[o + N_START] + 1
        clear = w[C_ADAPTS] == 1.0 and w[d + D_LEAST] < CLEAR * threshold
        if length >= n[N_MIN_STANCE] or (clear and length >= n[N_SHORT_STANCE]):
            phase = STANCE
            notice = STANCE_CONFIRMED
    elif phase == LEAVING and epoch - n[o + N_LEAVE] + 1 >= n[N_MIN_SWING]:
        phase = SWING
        notice = STANCE_ENDED
    n[o + N_PHASE] = phase
    return still and phase != SWING, notice
