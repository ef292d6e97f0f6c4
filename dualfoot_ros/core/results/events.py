"""Events: what was applied to, or found in, the estimate, and when."""

from __future__ import annotations

from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np

from ..samples.series import FloatArray
from .payloads import NO_DETAILS, Payload, YawTurn, named_values

FEET = ("left", "right")
NO_INNOVATION, NO_COVARIANCE = np.empty(0), np.empty((0, 0))  # one each for all events


class EventKind(StrEnum):
    """What can happen at an epoch."""

    ALIGNED = "aligned"
    STOOD = "stood"
    STANCE_START = "stance_start"
    STANCE_END = "stance_end"
    ZUPT = "zupt"
    CONSTRAINT = "constraint"
    AID = "aid"
    HEADING = "heading"
    RESET = "reset"
    MISSING = "missing"
    LOST = "lost"
    JOINED = "joined"
    BRIDGED = "bridged"
    CARRIED = "carried"


class Event(NamedTuple):
    """Something that was applied to, or found in, the estimate.

    Attributes
    ----------
    kind : what happened
    stamp_ns : when it holds (for a constraint at the minimum-distance moment: that moment)
    foot : "left", "right" or "both"
    detected_ns : the epoch at which it became known and was applied; never before ``stamp_ns``
    innovation : (m,) predicted minus measured (estimate minus truth, as the filter's errors), in
        the units of the measurement
    S : (m, m) innovation covariance
    nis : normalised innovation squared, innovation' S^-1 innovation
    accepted : False when a gate or a rule refused to apply it
    payload : further values, of a type that tells what they are
    reason : why it was refused or taken with a doubt, or why the tracker started anew
    """

    kind: EventKind
    stamp_ns: int
    foot: str
    detected_ns: int
    innovation: FloatArray = NO_INNOVATION
    S: FloatArray = NO_COVARIANCE
    nis: float = float("nan")
    accepted: bool = True
    payload: Payload = NO_DETAILS
    reason: StrEnum | None = None

    @property
    def detail(self) -> dict[str, Any]:
        """Further values by name, for files and people: those of the payload, and the reason."""
        return named_values(self.payload, self.reason)

    @property
    def turn(self) -> YawTurn:
        """The turn that a HEADING event tells.

        Raises
        ------
        TypeError
            When the event tells none.
        """
        if not isinstance(self.payload, YawTurn):
            raise TypeError(f"an event of kind {self.kind} tells no turn")
        return self.payload
