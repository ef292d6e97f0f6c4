"""Check of the live streams: every few seconds the last stretch of them is inspected."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from ...core import METHODS, DualFootTracker, FloatArray
from ...inspection import Finding, Stretch, stretch_findings
from ...timing import Aligner
from ..ros.status import Status

EVERY_NS = 4_000_000_000  # of data, between inspections of a stream that is new
LATER_NS = 15_000_000_000  # and of one that was found good OFTEN times
OFTEN = 8
KEPT = 2  # inspections for which a finding stays, so that it does not come and go


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
        self._checked_ns = 0
        self._good = 0
        self._recent: list[Sequence[Finding]] = []

    def add(self, foot: str, stamp_ns: int, values: FloatArray) -> None:
        """Take specific force and angular rate (6,) of one sample."""
        self._stretch.add(foot, stamp_ns + self._aligner.shift_ns(foot), values)

    def reset(self) -> None:
        """Forget the samples."""
        self._stretch.clear()

    def describe(self, status: Status) -> None:
        """Add the findings of the last inspections; begin another one when it is due."""
        if self._aligner.clocks_set != self._clocks_set:
            self._clocks_set = self._aligner.clocks_set
            self.reset()  # stamps from before do not belong to those since
        known = {finding.key for finding in status.findings}
        for finding in self._findings():
            if finding.key not in known:
                status.note(finding)
        if self._is_due():
            self._begin()

    def wait(self) -> None:
        """Wait for the inspection that runs, if one does."""
        if self._worker is not None:
            self._worker.join()

    def _findings(self) -> list[Finding]:
        """Return the findings of the last inspections, each once, the newest words first."""
        found: dict[object, Finding] = {}
        for findings in reversed(self._recent):
            for finding in findings:
                found.setdefault(finding.key, finding)
        return list(found.values())

    def _is_due(self) -> bool:
        if self._worker is not None and self._worker.is_alive():
            return False
        newest_ns = self._stretch.newest_ns
        every_ns = EVERY_NS if self._good < OFTEN else LATER_NS
        return newest_ns < self._checked_ns or newest_ns - self._checked_ns >= every_ns

    def _begin(self) -> None:
        stretch = self._stretch.take()
        self._checked_ns = self._stretch.newest_ns
        one_shoe = METHODS[self._tracker.config.method].sensors_on_one_shoe
        track = self._tracker.engine == "compiled" and not one_shoe

        def inspect() -> None:
            found = tuple(stretch_findings(stretch, self._tracker.config, track=track))
            self._good = 0 if found else self._good + 1
            self._recent = [*self._recent, found][-KEPT:]

        self._worker = threading.Thread(target=inspect, name="stream_check")
        self._worker.start()
