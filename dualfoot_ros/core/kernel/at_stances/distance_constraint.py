"""The distance of the feet in passing, brought to what it is at least, where it exceeds that.

Liu et al. 2023, sections III-D and IV-C; the exact solver of `core.constraints.idc`.
"""

from ..closest import closest
from ..layout import (
    KNOW_NOTHING,
    M_DIRECTION,
    M_NOISE,
    M_P,
    M_PUSH,
    M_R,
    X_AFTER,
    X_BEFORE,
    X_DISTANCE,
    X_DISTANCE_AFTER,
    X_EXCEEDS,
    X_NIS,
    X_NOISE,
    X_NOW,
    X_S,
    X_Y,
)
from .observation import observe
from .separation import length, put_relative_row, separation, separation_covariance

LEAST_VARIANCE = 1e-12  # m^2; a distance that is known better is not corrected


def constrain_distance(w, x, c0, std, solves, given, a, b, c):
    """Bring the separation to ``c0`` m, known to ``std`` m, if it is longer; return whether it is.

    The separation is that of now, or (a, b, c) m when it is ``given``.  The innovation is that of
    the distance, and so is its NIS, -1 for none.  Nothing is done unless the entry ``solves``.
    """
    separation(w, x, X_NOW)
    for i in range(3):
        x[X_BEFORE + i] = x[X_NOW + i]
    if given:
        x[X_BEFORE] = a
        x[X_BEFORE + 1] = b
        x[X_BEFORE + 2] = c
    separation_covariance(w, x)
    for i in range(3):
        x[M_R + i] = x[X_BEFORE + i]
        x[X_AFTER + i] = x[X_BEFORE + i]
    distance = length(x, X_BEFORE)
    variance = quadratic(x) / (distance * distance) if distance > 0.0 else 0.0
    error = distance - c0
    exceeds = error > 0.0 and variance > LEAST_VARIANCE
    if exceeds and solves:
        project(w, x, c0, std)
    x[X_DISTANCE] = distance
    s = variance + std * std
    x[X_Y] = error
    x[X_S] = s
    x[X_NIS] = error * error / s if s > 0.0 else -1.0
    x[X_EXCEEDS] = 1.0 if exceeds else 0.0
    return exceeds


def quadratic(x):
    """Return r' P r of what is at M_R and M_P."""
    total = 0.0
    for i in range(3):
        p = M_P + 3 * i
        total += x[M_R + i] * (x[p] * x[M_R] + x[p + 1] * x[M_R + 1] + x[p + 2] * x[M_R + 2])
    return total


def project(w, x, c0, std):
    """Update with the row of the least correction."""
    closest(x, c0, std)
    put_relative_row(w, 0, x[M_DIRECTION], x[M_DIRECTION + 1], x[M_DIRECTION + 2])
    x[X_Y] = x[M_PUSH]
    x[X_NOISE] = x[M_NOISE]
    observe(w, x, 1, KNOW_NOTHING)
    distance_after(w, x)


def distance_after(w, x):
    """Write what the separation has become, at its moment and now; return the distance now, m."""
    x[X_DISTANCE_AFTER] = separation(w, x, X_AFTER)
    for i in range(3):
        x[X_AFTER + i] = x[X_BEFORE + i] + (x[X_AFTER + i] - x[X_NOW + i])
    return x[X_DISTANCE_AFTER]
