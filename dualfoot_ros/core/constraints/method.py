"""What a constraint method is: it is told what the gait does and may ask for constraints."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import ClassVar, NamedTuple, Protocol

from ..joint_estimate import JointEstimate, Outcome
from ..kernel.at_stances.stance_end import share_of_stance
from ..parameters import Parameters
from ..results.events import EventKind
from ..samples.series import FloatArray
from .learnt_spacing import Spacing


class StancePhase(NamedTuple):
    """A stance, in epochs of the tracker.

    ``first`` and ``last`` bound the zero-velocity epochs (``last`` is ``now`` while it lasts),
    ``lag`` is by how many epochs the detector's window ends after its middle, ``now`` is the
    newest epoch, ``heading`` (rad) the direction the person faces: the mean of both feet's last
    stances.
    """

    foot: int
    first: int
    last: int
    lag: float
    now: int
    period_s: float
    heading: float

    @property
    def duration_s(self) -> float:
        """Length of the stance."""
        return (self.last - self.first + 1) * self.period_s

    def moment(self, share: float) -> int:
        """Return the epoch at a share of the stance: eq. (31) of Liu et al. 2023 for kappa."""
        return share_of_stance(self.first, self.last, share, self.lag)


class Request(NamedTuple):
    """A constraint a method asks for.

    ``epoch`` is the moment it is about.  With ``roll_back`` it is applied at that moment and the
    filter re-run since; without, it is applied now.
    """

    epoch: int
    roll_back: bool
    apply: Callable[[JointEstimate], Outcome]
    kind: EventKind = EventKind.CONSTRAINT


class Gait(Protocol):
    """What a method may ask the tracker about now and the recent past."""

    @property
    def now(self) -> int:
        """Newest epoch."""

    @property
    def period_s(self) -> float:
        """Nominal length of an epoch."""

    def in_stance(self, foot: int, epoch: int) -> bool:
        """Return whether ``foot`` had zero velocity at ``epoch``."""

    def positions_after(self, epoch: int) -> FloatArray:
        """Return both feet's positions (2, 3) m as estimated at ``epoch``."""

    def sample(self, foot: int, epoch: int) -> FloatArray:
        """Return specific force and bias-free angular rate (6,) of ``foot`` at ``epoch``."""

    def last_stance_end(self, foot: int) -> int:
        """Return the last epoch of the last stance of ``foot`` that has ended, -1 for none."""

    def remembers(self, epoch: int) -> bool:
        """Return whether the filter can be rolled back to just after ``epoch``."""

    def stamp(self, epoch: int, default: int = 0) -> int:
        """Return the stamp in ns of ``epoch``, or ``default`` when it is forgotten."""


class Method:
    """Base of the methods: asks for nothing.

    Attributes
    ----------
    name : what selects the method, and the name of its group of parameters
    config_class : class of that group; an instance of it is what the method is made from
    sensors_on_one_shoe : "left" and "right" are two sensors on the same foot
    dimensions : rows of its measurement, the degrees of freedom of its NIS
    memory_s : s, how far back its requests may reach
    needs_heading : it is not asked before the heading of the walk is known
    watch_m : m, distance of the feet beyond which `on_epoch` is called (infinity: never, below
        zero: at every epoch)
    lever_arm : (3,) m from the first sensor to the second, where both are on one shoe
    spacing : distance of the feet side by side, where the method needs it
    """

    name: ClassVar[str] = ""
    config_class: ClassVar[type[Parameters]] = Parameters
    sensors_on_one_shoe: ClassVar[bool] = False
    config: Parameters
    dimensions: int = 1
    memory_s: float = 0.0
    needs_heading: bool = True
    watch_m: float = math.inf
    lever_arm: FloatArray | None = None
    spacing: Spacing | None = None

    def __init__(self, config: Parameters) -> None:
        """Use ``config``, an instance of ``config_class``."""
        self.config = config

    @property
    def asks_at_start(self) -> bool:
        """Whether the start of a stance is anything to it."""
        return type(self).on_stance_start is not Method.on_stance_start

    @property
    def asks_at_end(self) -> bool:
        """Whether the end of a stance is anything to it."""
        return type(self).on_stance_end is not Method.on_stance_end

    def retune(self, config: Parameters) -> None:
        """Go on with other weights and distances of ``config``."""
        self.config = config

    def on_stance_start(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return what follows from a stance that has been confirmed."""
        return ()

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return what follows from a stance that has ended."""
        return ()

    def on_epoch(self, gait: Gait) -> Sequence[Request]:
        """Return what is to be applied now, the feet being farther apart than ``watch_m``."""
        return ()

    def note(self, outcome: Outcome) -> None:
        """Take note of what came of a request when it was first applied (not when re-run)."""

    def moved(self, up_m: float, turned: float) -> None:
        """Take note that the whole track was moved ``up_m`` m up and turned by ``turned`` rad."""
