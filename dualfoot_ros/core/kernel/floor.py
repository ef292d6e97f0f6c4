"""A floor that moves under both feet: carried along, and looked for while both feet stand.

The filter runs in the frame of the floor, where a standing foot is at rest.  The velocity of the
floor moves both positions, and what is not known of it makes both uncertain by the same.  A floor
that begins to move, or stops, gives both standing feet the same acceleration.
"""

import math

from .layout import (
    C_FOOT,
    C_GRAVITY,
    C_STILL_RATE,
    C_STRIDE,
    DIAGONAL,
    E_POS,
    F_NEWEST,
    F_REST,
    F_SECONDS,
    F_SUM,
    F_WINDOWS,
    FLOOR_S,
    FLOOR_STD,
    FLOOR_UP_STD,
    FLOOR_VEL,
    FOOT,
    FORCE,
    N_EPOCH,
    N_FOOT,
    N_RING,
    N_SETTLED,
    N_STRIDE,
    N_TURNED,
    PLL,
    PLR,
    POS,
    PRR,
    RINGS,
    ROT,
    SAMPLE,
)

FLOOR_WINDOW_S = 0.25  # over which the acceleration of the feet is taken
LEAST_ACCELERATION = 0.15  # m/s^2, of a floor
ALIKE = 0.5  # share of it by which the feet may differ
TURNS = 0.3  # rad/s, beyond which a foot moves on its floor
RENEWED = 0.2  # share of a new window in the acceleration at rest


def floor_moves(w):
    """Return whether the floor moves, as far as is known."""
    return w[FLOOR_STD] > 0.0 or w[FLOOR_UP_STD] > 0.0


def carry(w, dt):
    """Move both feet with the floor; not knowing its velocity adds to both positions alike."""
    before = w[FLOOR_S]
    w[FLOOR_S] = before + dt
    growth = (2.0 * before + dt) * dt  # of the squared time
    for i in range(3):
        way = w[FLOOR_VEL + i] * dt
        w[POS + i] += way
        w[FOOT + POS + i] += way
        std = w[FLOOR_UP_STD] if i == 2 else w[FLOOR_STD]
        variance = std * std * growth
        d = DIAGONAL * (E_POS + i)
        w[PLL + d] += variance
        w[PRR + d] += variance
        w[PLR + d] += variance


def settled(w, n, foot):
    """Return whether ``foot`` has not turned for a while: its sensor rests on the floor.

    A floor that gains velocity fast enough looks like a swing to the detector, but does not turn.
    """
    o = N_FOOT + foot * N_STRIDE
    s = RINGS + SAMPLE * (n[N_EPOCH] % n[N_RING]) + 4 + 6 * foot
    still = C_FOOT + foot * C_STRIDE + C_STILL_RATE
    x = w[s] - w[still]
    y = w[s + 1] - w[still + 1]
    z = w[s + 2] - w[still + 2]
    if not x * x + y * y + z * z < TURNS * TURNS:
        n[o + N_TURNED] = n[N_EPOCH]
    return n[N_EPOCH] - n[o + N_TURNED] >= n[N_SETTLED]


def watch_floor(w, n, dt):
    """Take the acceleration of both feet at rest; return whether a window asks for attention.

    Whoever reads a window sets its length to zero.
    """
    left = settled(w, n, 0)
    if not settled(w, n, 1) or not left:
        for i in range(F_WINDOWS + 1 - F_SECONDS):
            w[F_SECONDS + i] = 0.0
        return False
    if w[F_SECONDS] == 0.0:
        for i in range(6):
            w[F_SUM + i] = 0.0
    w[F_SECONDS] += dt
    for foot in range(2):
        o = foot * FOOT
        for i in range(3):
            r = o + ROT + 3 * i
            gained = (
                w[r] * w[o + FORCE] + w[r + 1] * w[o + FORCE + 1] + w[r + 2] * w[o + FORCE + 2]
            )
            if i == 2:
                gained -= w[C_GRAVITY]
            w[F_SUM + 3 * foot + i] += gained * dt
    if w[F_SECONDS] < FLOOR_WINDOW_S:
        return False
    if floor_moves(w) or gains_alike(w):
        return True
    rest(w)
    return False


def rest(w):
    """Take a window in which nothing has begun to move: what the feet read in it is an error."""
    for i in range(6):
        if w[F_WINDOWS] == 1.0:
            w[F_REST + i] = w[F_NEWEST + i]
        elif w[F_WINDOWS] > 1.0:
            w[F_REST + i] += RENEWED * (w[F_NEWEST + i] - w[F_REST + i])
        w[F_NEWEST + i] = w[F_SUM + i] / w[F_SECONDS]
    w[F_WINDOWS] += 1.0
    w[F_SECONDS] = 0.0


def gains_alike(w):
    """Return whether both feet have gained the same velocity over the window."""
    both = 0.0
    apart = 0.0
    for i in range(3):
        left = w[F_SUM + i]
        right = w[F_SUM + 3 + i]
        both += (left + right) * (left + right)
        apart += (left - right) * (left - right)
    mean = 0.5 * math.sqrt(both)
    if mean < LEAST_ACCELERATION * w[F_SECONDS]:
        return False
    return math.sqrt(apart) < ALIKE * mean
