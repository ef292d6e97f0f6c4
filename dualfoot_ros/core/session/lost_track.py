"""Feet whose samples were wrong for a while: what they measure next says that they are lost.

A foot lands with a velocity that no landing and no floor has, or a constraint finds the feet far
from where they can be.  The covariance knows nothing of such a fault, so that the track would keep
its error for many steps and claim that it has none.  What is unknown then is put into the
covariance before the measurement is taken, so that it is taken for what it is worth.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

from ..carried.probability import nis_gate
from ..constraints import Request
from ..gait_history import GaitHistory
from ..joint_estimate import JointEstimate, Outcome, Touchdown
from ..kernel import Workspace
from ..kernel import layout as lay
from ..results.payloads import Reason

LOST_GATE = nis_gate(1.0 - 1e-9, 3)  # of a landing, which a sound track never passes
LEAST_SPEED = 1.5  # m/s; floors do 1, and a hole that was filled leaves up to 1.3
MISFIT = 20.0  # NIS a row of a constraint beyond which the feet cannot be where they seem to be


def lost_speed(touchdown: Touchdown) -> float | None:
    """Return how fast a foot has landed, m/s, if no foot can; None if it has not."""
    if not touchdown.nis > LOST_GATE:
        return None
    speed = math.hypot(*touchdown.velocity)
    return speed if speed >= LEAST_SPEED else None


def doubting(
    space: Workspace, gait: GaitHistory, request: Request, feet: Sequence[int] = (0, 1)
) -> Request:
    """Return a request that makes the places of ``feet`` unknown first, where it does not fit.

    Where stamps are uneven, a misfit tells nothing: the covariance knows too little all the time.
    """
    if gait.uneven:
        return request
    apply = partial(_apply, space, request.apply, feet)
    return Request(request.epoch, request.roll_back, apply, request.kind)


def _apply(
    space: Workspace,
    apply: Callable[[JointEstimate], Outcome],
    feet: Sequence[int],
    estimate: JointEstimate,
) -> Outcome:
    """Apply a constraint; where it cannot fit, again with places as unknown as it is off."""
    before = space.w[: lay.STATE].copy()
    outcome = apply(estimate)
    if not outcome.accepted or not outcome.nis > MISFIT * len(outcome.innovation):
        return outcome
    space.w[: lay.STATE] = before
    off = math.hypot(*outcome.innovation.tolist())
    for foot in feet:
        block = space.own_block(foot)
        for axis in range(lay.E_POS, lay.E_POS + 3):
            block[axis, axis] += off * off
    outcome = apply(estimate)
    if outcome.accepted:
        return outcome._replace(reason=Reason.DID_NOT_FIT)
    space.w[: lay.STATE] = before  # it has nothing to say any more
    return apply(estimate)
