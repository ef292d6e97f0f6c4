"""Arrivals that cannot be: put aside until others confirm or contradict them."""

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
