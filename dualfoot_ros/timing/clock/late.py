"""Arrivals that are all late: chance, a stall, or a clock that was set."""

from __future__ import annotations

from .outliers import Arrival


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
