"""Checks of the stamps of each foot: zero, equal, uneven, or of a clock that was set."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping

from ...core import FEET
from ...inspection import Finding, FindingKind, Severity
from ...timing import Aligner
from ..ros.status import Status

WINDOW = 200  # intervals over which jitter is judged
UNEVEN = 0.3  # of the usual interval: 95 % of the intervals of a sampling clock differ by less
LEAST_JITTER_NS = 2_000_000
EQUAL_SHARE = 0.05
WITHOUT_STAMPS = ("arrival", "even")
"""Policies that need no stamps in the headers."""

ARRIVALS = (
    "stamp the samples where they are taken, or set stamp of imu_adapter (stamping.{foot} here) "
    "to device, or to even where the device sends no time"
)


class StampChecks:
    """Checks of the header stamps, and of what an aligner makes of the stamps."""

    def __init__(self, aligner: Aligner, policy: Callable[[str], str]) -> None:
        """``policy`` tells by which stamp the samples of a foot are taken."""
        self._aligner, self._policy = aligner, policy
        self._intervals = {foot: deque[int](maxlen=WINDOW) for foot in FEET}
        self._newest: dict[str, int] = {}
        self._zeros = dict.fromkeys(FEET, 0)
        self._before: Mapping[str, int] = aligner.counters

    def observe(self, foot: str, header_ns: int, stamp_ns: int) -> None:
        """Take the stamp in the header of a sample, and the one that is used."""
        self._zeros[foot] += header_ns == 0 and self._policy(foot) not in WITHOUT_STAMPS
        step = stamp_ns - self._newest.get(foot, stamp_ns)
        self._newest[foot] = stamp_ns
        if 0 < step <= self._aligner.config.max_gap_ns:
            self._intervals[foot].append(step)

    def describe(self, status: Status) -> None:
        """Add what is wrong with the stamps since the last report to a status."""
        now = self._aligner.counters
        new = {name: count - self._before.get(name, 0) for name, count in now.items()}
        self._before = now
        for foot in FEET:
            for finding in self._of_foot(foot, new):
                status.note(finding)
        if new["restarts"] > 0:
            text = "the stamps of both feet went back, and are taken as they are from there"
            status.note(Finding(FindingKind.CLOCK_SET, Severity.WARNING, text, about="both"))
        self._zeros = dict.fromkeys(FEET, 0)

    def _of_foot(self, foot: str, new: Mapping[str, int]) -> Iterator[Finding]:
        yield from self._zero(foot)
        yield from self._equal(foot, new)
        yield from self._jitter(foot)
        if new[f"{foot}_clock_set"] > 0:
            text = (
                f"the clock of the {foot} foot was set while the other one went on; its samples "
                "are stamped as before, to some ms"
            )
            yield Finding(FindingKind.CLOCK_SET, Severity.WARNING, text, about=foot)

    def _zero(self, foot: str) -> Iterator[Finding]:
        if self._zeros[foot]:
            text = f"{self._zeros[foot]} stamps of the {foot} foot are zero"
            remedy = f"set stamping.{foot} to even, or stamp of imu_adapter"
            yield Finding(FindingKind.ZERO_STAMPS, Severity.WARNING, text, remedy, foot)

    def _equal(self, foot: str, new: Mapping[str, int]) -> Iterator[Finding]:
        equal, taken = new[f"{foot}_duplicate"], new[f"{foot}_accepted"]
        if equal > EQUAL_SHARE * (equal + taken) and not self._zeros[foot]:
            text = (
                f"{equal} of {equal + taken} samples of the {foot} foot have the stamp of the one "
                "before and are left out"
            )
            remedy = ARRIVALS.format(foot=foot)
            yield Finding(FindingKind.EQUAL_STAMPS, Severity.WARNING, text, remedy, foot)

    def _jitter(self, foot: str) -> Iterator[Finding]:
        intervals = sorted(self._intervals[foot])
        if len(intervals) < WINDOW:
            return
        usual = intervals[WINDOW // 2]
        off = sorted(_unevenness(each, usual) for each in intervals)[WINDOW * 19 // 20]
        if off > max(UNEVEN * usual, LEAST_JITTER_NS):
            text = (
                f"the stamps of the {foot} foot are uneven by {1e-6 * off:.1f} ms, as times of "
                "arrival are; a track suffers from it"
            )
            remedy = ARRIVALS.format(foot=foot)
            yield Finding(FindingKind.JITTER, Severity.WARNING, text, remedy, foot)


def _unevenness(interval_ns: int, usual_ns: int) -> int:
    """Return how far an interval is from whole ones: lost samples make it no less even."""
    return abs(interval_ns - usual_ns * max(1, round(interval_ns / usual_ns)))
