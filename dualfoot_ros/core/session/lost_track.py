"""Feet whose samples were wrong for a while: a landing says that they are lost.

A foot lands with a velocity that no landing and no floor has.  The covariance knows nothing of
such a fault, so that the track would keep its error for many steps and claim that it has none.
"""

from __future__ import annotations

import math

from ..carried.probability import nis_gate
from ..joint_estimate import Touchdown

LOST_GATE = nis_gate(1.0 - 1e-9, 3)  # of a landing, which a sound track never passes
LEAST_SPEED = 1.5  # m/s; floors do 1, and a hole that was filled leaves up to 1.3


def lost_speed(touchdown: Touchdown) -> float | None:
    """Return how fast a foot has landed, m/s, if no foot can; None if it has not."""
    if not touchdown.nis > LOST_GATE:
        return None
    speed = math.hypot(*touchdown.velocity)
    return speed if speed >= LEAST_SPEED else None
