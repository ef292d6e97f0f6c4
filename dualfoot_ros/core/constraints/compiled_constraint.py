"""A constraint that the kernel makes: to go back for it is one call."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..joint_estimate import JointEstimate, Outcome


@dataclass(slots=True)
class CompiledConstraint:
    """A constraint that is an entry of the kernel; it can be what a request applies.

    Attributes
    ----------
    entry : name of the entry; the kernel has ``entry`` and ``entry_back``
    given : what the entry is given beside the arrays
    outcome : makes the outcome of the estimate and of what the entry has left beside the state
    """

    entry: str
    given: tuple[float, ...]
    outcome: Callable[[JointEstimate, list[float]], Outcome]

    def __call__(self, estimate: JointEstimate) -> Outcome:
        """Apply it to the present state."""
        return self.outcome(estimate, estimate.act(self.entry, *self.given)[1])

    def go_back(self, estimate: JointEstimate, first: int, gate: float) -> Outcome | None:
        """Apply it to the state before epoch ``first`` and run again from there.

        None where it does not fit, its NIS a row being beyond ``gate``; then the state is of no
        use any more.
        """
        found = estimate.act_back(self.entry, first, gate, *self.given)
        return None if found is None else self.outcome(estimate, found)
