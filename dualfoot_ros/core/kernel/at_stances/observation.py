"""A whole update by up to three rows, from the rows to the corrected state."""

import math

from ..layout import (
    DIAGONAL,
    E_POS,
    JOINT,
    KNOW_NOTHING,
    PLL,
    PRR,
    ROWS_MOST,
    S_H,
    S_S,
    S_Y,
    SIDE,
    WALKED,
    X_NOISE,
    X_S,
    X_Y,
)
from ..measurement_update import collect, correct, correct_considering

ROUNDING = 1e-13  # relative size below which a variance is a rounding error


def observe(w, x, rows, kind):
    """Update with the ``rows`` rows at S_H and what ``x`` has of them; return the NIS.

    ``x`` holds the innovation (X_Y) and the noise of each row (X_NOISE) and gets S (X_S).  A
    variance H P H' that is mere rounding counts as none: what an exact constraint has settled
    stays settled.  ``kind`` is what the update leaves alone, KNOW_NOTHING for nothing.
    """
    collect(w, rows)
    for k in range(rows):
        if observes_height(w, k):
            w[WALKED] = 0.0
        s = S_S + (ROWS_MOST + 1) * k
        if w[s] < ROUNDING * greatest_variance(w, k):
            w[s] = 0.0
        w[s] += x[X_NOISE + k]
        w[S_Y + k] = x[X_Y + k]
    for i in range(ROWS_MOST * ROWS_MOST):
        x[X_S + i] = w[S_S + i]
    if kind == KNOW_NOTHING:
        return correct(w, rows)
    return correct_considering(w, rows, kind)


def observes_height(w, k):
    """Return whether row ``k`` measures a height, and not how high one foot is above the other."""
    h = S_H + JOINT * k + E_POS + 2
    return abs(w[h] + w[h + SIDE]) > ROUNDING


def greatest_variance(w, k):
    """Return the greatest variance that the present variances of the states can give row ``k``."""
    total = 0.0
    for foot in range(2):
        block = PLL if foot == 0 else PRR
        for j in range(15):
            coefficient = w[S_H + JOINT * k + SIDE * foot + j]
            if coefficient != 0.0:
                total += abs(coefficient) * math.sqrt(max(0.0, w[block + DIAGONAL * j]))
    return total * total
