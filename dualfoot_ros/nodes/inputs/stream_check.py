"""Check of the live streams: every few seconds the last stretch of them is inspected."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from ...core import METHODS, DualFootTracker, FloatArray
from ...inspection import (
    SIGNALS_S,
    WALK_S,
    Finding,
    Stretch,
    signal_findings,
    track_findings,
)
from ...recording import Recording
from ...timing import Aligner
from ..ros.status import Status

OFTEN = 4  # good inspections, after which they are rarer
KEPT = 2  # inspections for which a finding stays, so that it does not come and go


@dataclass
class Inspection:
    """One kind of inspection: of how long a stretch (s), and after how much new data (s).

    ``later_s`` holds for streams that were found good OFTEN times.
    """

    find: Callable[[Recording], Iterable[Finding]]
    length_s: float
    every_s: float
    later_s: float
    checked_ns: int = 0
    good: int = 0
    recent: list[Sequence[Finding]] = field(default_factory=list)

    def is_due(self, newest_ns: int) -> bool:
        """Return whether there is enough new data; ``newest_ns`` is its newest stamp."""
        every_s = self.every_s if self.good < OFTEN else self.later_s
        return newest_ns < self.checked_ns or newest_ns - self.checked_ns >= 1e9 * every_s

    def inspect(self, stretch: Recording) -> None:
        """Take the findings on ``stretch``."""
        found = tuple(self.find(stretch))
        self.good = 0 if found else self.good + 1
        self.recent = [*self.recent, found][-KEPT:]


class StreamCheck:
    """Findings on the samples that a tracker is fed with, and on the walk they show.

    Samples are only kept as they come.  When the report asks, and enough of them are new, a thread
    inspects them, so that no sample waits; the report after that has its findings.
    """

    def __init__(self, tracker: DualFootTracker, aligner: Aligner) -> None:
        """Inspect what ``tracker`` gets from ``aligner``, and track as it does."""
        self._tracker, self._aligner = tracker, aligner
        self._clocks_set = aligner.clocks_set
        self._stretch = Stretch()
        self._worker: threading.Thread | None = None
        self._signals = Inspection(signal_findings, SIGNALS_S, 4.0, 15.0)
        # It costs four times as much, and tells little before there are turns.
        self._walk = Inspection(self._find_in_walk, WALK_S, 15.0, WALK_S)

    def add(self, foot: str, stamp_ns: int, values: FloatArray) -> None:
        """Take specific force and angular rate (6,) of one sample."""
        self._stretch.add(foot, stamp_ns + self._aligner.shift_ns(foot), values)

    def reset(self) -> None:
        """Forget the samples."""
        self._stretch.clear()

    def describe(self, status: Status) -> None:
        """Add the findings of the last inspections; begin those that are due."""
        if self._aligner.clocks_set != self._clocks_set:
            self._clocks_set = self._aligner.clocks_set
            self.reset()  # stamps from before do not belong to those since
        known = {finding.key for finding in status.findings}
        for finding in self._findings():
            if finding.key not in known:
                status.note(finding)
        if self._worker is None or not self._worker.is_alive():
            self._begin()

    def wait(self) -> None:
        """Wait for the inspection that runs, if one does."""
        if self._worker is not None:
            self._worker.join()

    def _findings(self) -> list[Finding]:
        """Return the findings of the last inspections, each once, the newest words first."""
        found: dict[object, Finding] = {}
        for inspection in (self._signals, self._walk):
            for findings in reversed(inspection.recent):
                for finding in findings:
                    found.setdefault(finding.key, finding)
        return list(found.values())

    def _begin(self) -> None:
        """Begin the inspections that are due, in one thread."""
        newest_ns = self._stretch.newest_ns
        due = [each for each in (self._signals, self._walk) if each.is_due(newest_ns)]
        if not due:
            return
        taken = [(each, self._stretch.take(each.length_s)) for each in due]
        for each in due:
            each.checked_ns = newest_ns

        def inspect() -> None:
            while taken:
                each, stretch = taken.pop(0)
                each.inspect(stretch)
                del stretch
                give_back_memory()

        self._worker = threading.Thread(target=inspect, name="stream_check")
        self._worker.start()

    def _find_in_walk(self, stretch: Recording) -> Iterable[Finding]:
        """Return what the tracks show, once there is a kernel that is fast enough."""
        one_shoe = METHODS[self._tracker.config.method].sensors_on_one_shoe
        if self._tracker.engine != "compiled" or one_shoe:
            return ()
        return track_findings(stretch, self._tracker.config)


def give_back_memory() -> None:
    """Give free memory back to the system, where the allocator is that of glibc.

    It keeps what a thread has freed, in pieces, for the threads after it: a ``fusion`` that
    inspects its last minute again and again held 30 MB more after ten minutes.  Takes some ms.
    """
    trim = _trim()
    if trim is not None:
        trim(0)


@cache
def _trim() -> Any:
    """Return the function of glibc that does it; None where there is none."""
    try:
        return ctypes.CDLL(None).malloc_trim
    except (AttributeError, OSError, TypeError):
        return None
