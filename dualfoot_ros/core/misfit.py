"""Constraints that find the feet far from where they can be: samples were wrong for a while.

The covariance knows nothing of such a fault, so that the track would keep its error for many steps
and claim that it has none.  What is unknown then is put into the covariance before the measurement
is taken, so that it is taken for what it is worth.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from .joint_estimate import JointEstimate, Outcome
from .kernel import Workspace
from .kernel import layout as lay
from .results.payloads import Reason

MISFIT = 20.0  # NIS a row of a constraint beyond which the feet cannot be where they seem to be


def apply_doubting(
    space: Workspace,
    estimate: JointEstimate,
    apply: Callable[[JointEstimate], Outcome],
    feet: Sequence[int],
) -> Outcome:
    """Apply a constraint; where it cannot fit, again with the places of ``feet`` unknown.

    They are as unknown as the constraint is off.
    """
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
