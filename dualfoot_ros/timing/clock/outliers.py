"""Arrivals out of line: impossible ones are put aside, late ones are followed as a run."""

from __future__ import annotations

from typing import NamedTuple

CONFIRMATIONS = 3  # arrivals, at different times
PATIENCE_NS = 3_000_000_000


class Arrival(NamedTuple):
    """One sample as the host sees it."""

    device_ns: int
    arrival_ns: int


class Suspects:
    """A few arrivals that contradict the model of the clock.

    One wrong stamp below the lower envelope would bend it for the whole horizon, and one wrong
    stamp from the past would look like a restart.  Three arrivals that agree are believed.
    """

    def __init__(self) -> None:
        self._held: list[Arrival] = []
        self._alone = True

    def hold(self, arrival: Arrival) -> int:
        """Put ``arrival`` aside; return how many older ones are given up for it."""
        before = len(self._held)
        self._held = [
            a
            for a in self._held
            if 0 <= arrival.arrival_ns - a.arrival_ns <= PATIENCE_NS
            and abs(_delayed(a) - _delayed(arrival)) <= PATIENCE_NS
        ]
        given_up = before - len(self._held)
        self._alone = self._alone if self._held else True
        self._held.append(arrival)
        return given_up

    def contradict(self) -> None:
        """Learn that an arrival in between was as expected."""
        self._alone = False

    @property
    def confirmed(self) -> bool:
        """Whether enough were held that arrived at different times."""
        return len({a.arrival_ns for a in self._held}) >= CONFIRMATIONS

    @property
    def alone(self) -> bool:
        """Whether no arrival was as expected since the first one held."""
        return self._alone

    def release(self) -> list[Arrival]:
        """Return all that are held, and hold none."""
        held, self._held, self._alone = self._held, [], True
        return held


def _delayed(arrival: Arrival) -> int:
    return arrival.arrival_ns - arrival.device_ns


class LateArrivals:
    """The present run of arrivals that all came later than expected, if there is one.

    Its length is counted in steps of ``step_ns`` that passed on *both* clocks: what a stall held
    back arrives at once, however long it was, and says no more than a single late arrival.
    """

    def __init__(self, step_ns: int) -> None:
        self._step_ns = step_ns
        self.end()

    def end(self) -> None:
        """Learn that an arrival was as expected."""
        self.since: Arrival | None = None
        self.steps, self.least_s = 0, 0.0

    def add(self, arrival: Arrival, late_s: float) -> None:
        """Take an arrival that is ``late_s`` later than expected."""
        if self.since is None:
            self.since = self._counted = arrival
            self.least_s = late_s
        self.least_s = min(self.least_s, late_s)
        if min(a - b for a, b in zip(arrival, self._counted, strict=True)) >= self._step_ns:
            self._counted = arrival
            self.steps += 1
