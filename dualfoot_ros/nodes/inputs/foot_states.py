"""State of each foot in data time: there, or stale, so that the other one goes on alone."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

from ...core import FEET
from ...inspection import Finding, FindingKind, Severity
from ...timing import Aligner
from ..ros.status import Status

STALE_NS = 200_000_000  # behind the other foot by so much more than usual


class FootState(StrEnum):
    """Whether the samples of a foot can be used."""

    OK = "OK"
    STALE = "STALE"
    UNUSED = "UNUSED"


class FootStates:
    """States of both feet, from the stamps that an aligner has seen.

    A foot is stale as soon as its stamps are 0.2 s further behind those of the other foot than
    they usually are, and until it is in a pair again.
    """

    def __init__(self, aligner: Aligner, feet: Sequence[str]) -> None:
        self._aligner = aligner
        unused = {foot: FootState.UNUSED for foot in FEET if foot not in feet}
        self.states = dict.fromkeys(FEET, FootState.OK) | unused

    def observe(self) -> bool:
        """Look at the aligner after a sample; return whether a foot has changed its state."""
        changed = False
        for foot, state in self.states.items():
            now = self._judge(foot, state)
            changed |= now is not state
            self.states[foot] = now
        return changed

    def _judge(self, foot: str, state: FootState) -> FootState:
        if state is FootState.UNUSED:
            return state
        if self._aligner.behind_ns(foot) > STALE_NS:
            return FootState.STALE
        back = state is FootState.OK or self._aligner.present[foot]
        return FootState.OK if back else state

    @property
    def degraded(self) -> bool:
        """Whether a foot that should be there is not."""
        return FootState.STALE in self.states.values()

    def describe(self, status: Status) -> None:
        """Add the state of each foot, and of both together, to a status."""
        for foot, state in self.states.items():
            status.values[f"{foot} foot"] = state.value
            if state is FootState.STALE:
                status.note(self._finding(foot))
        status.values["state"] = "DEGRADED" if self.degraded else "OK"

    def _finding(self, foot: str) -> Finding:
        other = FEET[1 - FEET.index(foot)]
        behind_s = 1e-9 * self._aligner.behind_ns(foot)
        text = (
            f"DEGRADED: the {foot} foot is STALE, {behind_s:.1f} s behind; the {other} foot goes "
            "on alone"
        )
        remedy = f"check the sensor of the {foot} foot and its link"
        return Finding(FindingKind.STALE_FOOT, Severity.WARNING, text, remedy, foot)
