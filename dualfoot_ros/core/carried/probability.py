"""Gates as probabilities: the value that a normalised innovation squared stays below."""

from __future__ import annotations

import math


def nis_below(value: float, dimensions: int) -> float:
    """Return the probability that the NIS of ``dimensions`` rows is below ``value``.

    The distribution function of chi-square with as many degrees of freedom, in closed form.
    """
    half = 0.5 * value
    if dimensions % 2:
        total, term = math.erf(math.sqrt(half)), math.sqrt(half / math.pi) * 2.0 * math.exp(-half)
        first = 3
    else:
        total, term = 1.0 - math.exp(-half), half * math.exp(-half)
        first = 4
    for freedom in range(first, dimensions + 1, 2):
        total -= term
        term *= value / freedom
    return total


def nis_gate(probability: float, dimensions: int) -> float:
    """Return the NIS below which a consistent innovation of ``dimensions`` rows is that often.

    ``probability`` is in [0, 1); 0 accepts nothing.
    """
    low, high = 0.0, 1.0
    while nis_below(high, dimensions) < probability:
        high *= 2.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        if nis_below(middle, dimensions) < probability:
            low = middle
        else:
            high = middle
    return high
