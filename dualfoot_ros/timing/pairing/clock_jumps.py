"""A clock of one foot that is set in mid-walk: recognised by the arrivals, and undone."""

from __future__ import annotations

from collections import deque
from statistics import median_low

from ...core import FEET
from .pairing_config import AlignerConfig

USUAL = 20  # turns of delivery over which the usual lead is taken
NEW = 15  # samples of each foot that must agree on the new lead
TURNS = 4  # in which the feet must deliver meanwhile; a fast replay may come in blocks


class ClockJumps:
    """What to add to the stamps of each foot, so that a clock that was set goes on as before.

    The lead of the right foot over the left one is the difference of their newest stamps.  When
    it changes by more than ``max_delay`` and stays there while both feet deliver, and the stamps
    of one foot made a step in just that direction, its clock was set: what the lead has changed
    is taken off.  A foot that is late, or comes back after a silence, makes no such step.  Clocks
    that are set together leave the lead as it was, and what was apart from the start stays so.

    ``shift_ns`` is what is added to the stamps, by foot; ``jumps`` counts the clocks set.
    """

    def __init__(self, config: AlignerConfig) -> None:
        self._limit_ns = config.max_delay_ns
        self.shift_ns = dict.fromkeys(FEET, 0)
        self.jumps = dict.fromkeys(FEET, 0)
        self._newest: dict[str, int] = {}
        self._ahead: dict[str, int] = {}  # of the time of arrival, where that is known
        self._turn = ""
        self._leads: deque[int] = deque(maxlen=USUAL)
        self._usual = 0
        self._end_run()

    def _end_run(self) -> None:
        self._steps: dict[str, int] = {}
        self._begin_run()

    def _begin_run(self) -> None:
        self._run = {foot: deque[int](maxlen=NEW) for foot in FEET}
        self._times = {foot: deque[tuple[int, int]](maxlen=NEW) for foot in FEET}
        self._running, self._turns = False, 0

    def usual_lead_ns(self, foot: str) -> int:
        """Return how far the newest stamp of a foot is usually ahead of that of the other."""
        return self._usual if foot == "right" else -self._usual

    def suspects(self, foot: str) -> bool:
        """Tell whether the clock of this foot alone seems to be set; it shows soon."""
        return self._running and list(self._steps) == [foot]

    def is_set(self, foot: str, stamp_ns: int, arrival_ns: int | None = None) -> bool:
        """Take the stamp of a sample as it came; return whether the foot's clock was set.

        If so, ``shift_ns`` of the foot has changed.  With times of arrival the leads are those of
        the stamps against them, which no queue changes, and nothing is learnt from samples that
        come faster or slower than they were taken.
        """
        stamp_ns += self.shift_ns[foot]
        step = stamp_ns - self._newest.get(foot, stamp_ns)
        self._newest[foot] = stamp_ns
        self._ahead[foot] = stamp_ns - (arrival_ns or 0)
        if not -self._limit_ns <= step <= self._limit_ns:
            self._begin_run()
            self._steps[foot] = step
        if len(self._newest) < len(FEET):
            return False
        turned, self._turn = self._turn != foot, foot
        if arrival_ns is not None:
            self._times[foot].append((stamp_ns, arrival_ns))
        return self._compare(foot, self._ahead["right"] - self._ahead["left"], turned)

    def _compare(self, foot: str, lead: int, turned: bool) -> bool:
        """Compare a lead with the usual one, which is taken where the feet deliver in turn."""
        known = len(self._leads) == USUAL and abs(self._usual) <= self._limit_ns
        if known and abs(lead - self._usual) > self._limit_ns:
            self._running = True
            self._turns += turned
            self._run[foot].append(lead)
            return self._undo(foot)
        if self._running or self._steps:
            self._end_run()
        if turned:
            self._leads.append(lead)
            self._usual = median_low(self._leads)
        return False

    def _undo(self, foot: str) -> bool:
        """Take the change of the lead off the stamps of ``foot`` where they made that step."""
        leads = [lead for run in self._run.values() for lead in run]
        step = self._steps.get(foot)
        steady = 2 * (max(leads) - min(leads)) <= self._limit_ns
        if step is None or len(leads) < NEW * len(FEET) or self._turns < TURNS:
            return False
        if not steady or not all(map(_is_at_its_pace, self._times.values())):
            return False
        excess = median_low(leads) - self._usual
        ahead = excess if foot == "right" else -excess
        if (step > 0) != (ahead > 0):
            return False
        self.shift_ns[foot] -= ahead
        self._newest[foot] -= ahead
        self._ahead[foot] -= ahead
        self.jumps[foot] += 1
        self._end_run()
        return True


def _is_at_its_pace(times: deque[tuple[int, int]]) -> bool:
    """Return whether samples (stamp, arrival) come about as fast as they were taken."""
    if not times:
        return True  # nobody knows when they came
    stamps_ns, arrivals_ns = (
        last - first for first, last in zip(times[0], times[-1], strict=True)
    )
    return stamps_ns < 2 * arrivals_ns < 4 * stamps_ns
