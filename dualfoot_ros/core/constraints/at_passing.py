"""Methods that constrain the feet when one has passed the other, and learn their spacing.

At the end of a stance with nothing unusual about it the kernel does by itself what such a method
would ask for: `end_stance` in ``kernel/at_stances/stance_end.py``, by a rule of a few numbers.
Otherwise `on_stance_end` is asked.  Both come to the same, to the last bit.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..kernel import layout as lay
from ..samples.series import FloatArray
from .learnt_spacing import Spacing
from .method import Method


class AtPassing(Method):
    """Base of these methods.

    Attributes
    ----------
    rule : (R_SIZE,) what the kernel does at the end of a stance; None where the method is asked
    """

    spacing: Spacing
    rule: FloatArray | None = None

    def apply(self, estimate: JointEstimate, *, target: float, heading: float) -> Outcome:
        """Constrain the feet to ``target`` m where the person faces ``heading`` (rad)."""
        raise AssertionError(f"{type(self).__name__} says what a constraint does")

    def outcome(
        self, estimate: JointEstimate, found: list[float], target: float, heading: float
    ) -> Outcome:
        """Return what came of that, of what the kernel has ``found``."""
        raise AssertionError(f"{type(self).__name__} says what a constraint does")

    def note(self, outcome: Outcome) -> None:
        """Learn the spacing, if it was not given."""
        self.spacing.note(outcome)

    def moved(self, up_m: float, turned: float) -> None:
        """Learn the placement anew."""
        self.spacing.moved()


def rule_of(numbers: Mapping[int, float]) -> FloatArray:
    """Return the rule of ``numbers`` by their places (R_KIND and so on); the others are zero."""
    rule = np.zeros(lay.R_SIZE)
    for place, number in numbers.items():
        rule[place] = number
    return rule
