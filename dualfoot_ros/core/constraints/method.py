"""What a constraint method is: it is told of each stance and may ask for one constraint."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from ..estimate import JointEstimate, Outcome
from ..series import FloatArray


@dataclass(frozen=True)
class StancePhase:
    """A stance that has ended, in epochs of the tracker.

    ``first`` and ``last`` bound the zero-velocity epochs, ``lag`` is by how many epochs the
    detector's window ends after its middle, ``now`` the epoch at which the end became certain.
    """

    foot: int
    first: int
    last: int
    lag: float
    now: int
    period_s: float

    @property
    def duration_s(self) -> float:
        """Length of the stance."""
        return (self.last - self.first + 1) * self.period_s

    def moment(self, kappa: float) -> int:
        """Return the epoch of the minimum-distance moment, eq. (31) of Liu et al. 2023."""
        middle = (1.0 - kappa) * self.first + kappa * self.last - self.lag
        return round(middle)


@dataclass(frozen=True)
class Request:
    """A constraint a method asks for.

    ``epoch`` is the moment it is about.  With ``roll_back`` it is applied at that moment and the
    filter re-run since; without, it is applied now.
    """

    epoch: int
    roll_back: bool
    apply: Callable[[JointEstimate], Outcome]


class Gait(Protocol):
    """What a method may ask the tracker about the past."""

    def in_stance(self, foot: int, epoch: int) -> bool:
        """Return whether ``foot`` had zero velocity at ``epoch``."""

    def positions_after(self, epoch: int) -> FloatArray:
        """Return both feet's positions (2, 3) m as estimated at ``epoch``."""

    def remembers(self, epoch: int) -> bool:
        """Return whether the filter can be rolled back to just after ``epoch``."""


class Method(Protocol):
    """A constraint method; see the modules beside this one."""

    @property
    def memory_s(self) -> float:
        """How far back a constraint may reach from the end of a stance, s."""

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Request | None:
        """Return the constraint that follows from a stance that has ended, if any."""
