"""Connection events of a link: the times at which it can deliver at all.

On Bluetooth Low Energy whatever waits is handed over at the next connection event, the events
being one interval apart on the host's side.  So an arrival, less what the host adds, is an event.
The events are a clock like any other: they are counted, and followed as the line under the
arrivals.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import numpy as np

from ...core import FloatArray
from .envelope import LowerEnvelope
from .interval import NEAR_S, find_interval

APART_S = 0.001  # samples that arrive so soon after one another came in one notification
NOTIFICATIONS = 65  # in which an interval is looked for
HOST_S = 0.0003  # what the host usually adds
PERIOD_ERROR = 1.0e-3  # of an interval at first, as a ratio
LOST = 0.4  # with a smaller share of the arrivals at events, there are none


class Notification(NamedTuple):
    """Freshest sample of a notification, and when its first one came; s."""

    time_s: float
    arrival_s: float


class ConnectionEvents:
    """Find the events of a link from its notifications, and follow them.

    All times are s near an origin.  Memory is bounded.
    """

    def __init__(self, bin_s: float, bins: int) -> None:
        self._bin_s, self._bins = bin_s, bins
        self._recent: deque[Notification] = deque(maxlen=NOTIFICATIONS)
        self._newest: Notification | None = None
        self._last_s = 0.0
        self._until_search = NOTIFICATIONS
        self._forget()

    @property
    def interval_s(self) -> float | None:
        """Time from event to event; None while none is known."""
        line = self._envelope.line
        return None if line is None else self._period_s * (1.0 + line.skew)

    def add(self, time_s: float, arrival_s: float) -> list[Notification]:
        """Take a sample; return notifications that are whole by now, with their events.

        That is mostly none, or one; while no interval is known none; all the recent ones when it
        is found.
        """
        newest, since_s = self._newest, arrival_s - self._last_s
        self._last_s = arrival_s
        if newest is None or abs(since_s) > APART_S:
            self._newest = Notification(time_s, arrival_s)
            return [] if newest is None else self._notified(newest)
        if time_s > newest.time_s:
            self._newest = Notification(time_s, newest.arrival_s)
        return []

    def _notified(self, notification: Notification) -> list[Notification]:
        self._recent.append(notification)
        if self._envelope.line is None:
            return self._search()
        self._count(self._number_of(notification.arrival_s), notification.arrival_s)
        self._check(notification.arrival_s)
        return [self._with_event(notification)] if self._known() else []

    def _search(self) -> list[Notification]:
        """Look for an interval now and then; return all recent notifications when it is found."""
        self._until_search -= 1
        if self._until_search > 0:
            return []
        self._until_search = NOTIFICATIONS // 4
        time_s, arrival_s = np.array(self._recent).T
        period_s = find_interval(time_s, arrival_s)
        if period_s is None:
            return []
        self._begin(period_s, arrival_s)
        if self._envelope.line is None:  # multiples of it, but nowhere near one lattice
            return []
        for each in arrival_s.tolist():
            self._check(each)
        return [self._with_event(each) for each in self._recent] if self._known() else []

    def _begin(self, period_s: float, arrival_s: FloatArray) -> None:
        """Follow the events from some arrivals (n,) on; the best period near the given one."""
        periods = period_s * (1.0 + PERIOD_ERROR * np.linspace(-2.0, 2.0, 401))
        turns = np.exp(2j * np.pi * arrival_s / periods[:, None]).sum(axis=1)
        best = int(np.argmax(np.abs(turns)))
        self._period_s = float(periods[best])
        self._origin_s = float(np.angle(turns[best])) / (2.0 * np.pi) * self._period_s
        for each in arrival_s.tolist():
            number = round((each - self._origin_s) / self._period_s)
            if abs(each - self._origin_s - number * self._period_s) < NEAR_S + HOST_S:
                self._count(number, each)

    def _count(self, number: int, arrival_s: float) -> None:
        """Take an arrival at the event of that number."""
        counted_s = number * self._period_s
        self._envelope.add(counted_s, arrival_s - self._origin_s - counted_s)
        self._number = number

    def _check(self, arrival_s: float) -> None:
        """Learn whether an arrival was at an event."""
        late_s = arrival_s - self._at(self._number_of(arrival_s))
        self._at_event.append(late_s < NEAR_S + HOST_S)

    def _known(self) -> bool:
        """Forget the events when too few arrivals are at them; return whether they are kept."""
        kept = bool(np.mean(self._at_event) >= LOST)
        if not kept:
            self._forget()
        return kept

    def _forget(self) -> None:
        self._envelope = LowerEnvelope(self._bin_s, self._bins, PERIOD_ERROR, HOST_S)
        self._at_event: deque[bool] = deque(maxlen=NOTIFICATIONS)
        self._number, self._period_s, self._origin_s = 0, 0.0, 0.0

    def _with_event(self, notification: Notification) -> Notification:
        event_s = self._at(self._number_of(notification.arrival_s))
        return Notification(notification.time_s, event_s)

    def _number_of(self, arrival_s: float) -> int:
        """Return the number of the last event before an arrival; a little early is in time."""
        since_s = arrival_s + HOST_S - self._at(self._number)
        return self._number + math.floor(since_s / (self.interval_s or math.inf))

    def _at(self, number: int) -> float:
        counted_s, line = number * self._period_s, self._envelope.line
        assert line is not None
        return self._origin_s + counted_s + line.at(counted_s)
