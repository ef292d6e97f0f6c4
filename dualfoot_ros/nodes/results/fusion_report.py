"""Report of the node ``fusion``: its diagnostics, and what it logs of the walk."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Mapping, Sequence

import numpy as np
from rclpy.clock import Clock
from rclpy.impl.rcutils_logger import RcutilsLogger

from ...core import FEET, DualFootTracker, Event, EventKind, Refusal, Update, refusal_of
from ...inspection import (
    Finding,
    FindingKind,
    Severity,
    find_other_rate,
    lost_foot_findings,
    ride_findings,
    start_findings,
)
from ...timing import Aligner
from ..ros.diagnostics import OVER_S, Rates
from ..ros.status import Described, Status
from . import event_messages

LOGGED = (
    EventKind.ALIGNED,
    EventKind.HEADING,
    EventKind.RESET,
    EventKind.MISSING,
    EventKind.LOST,
    EventKind.JOINED,
)
RATE_OVER = 500  # samples over which the rate that comes is seen
NO_STANCE_NS = 2_000_000_000
LOST_SAID_NS = 10_000_000_000  # for how long a foot that was lost is reported
NOT_SHARED = 0.5  # of the pairs are interpolated; of lost samples that are filled it is less
MOST_LAG_S = 60.0  # beyond it, the stamps are of another clock
OTHER_CLOCK = "unknown: the stamps are of another clock (in a replay, set use_sim_time)"
NIS_MEMORY = 0.99  # of the running mean, a ZUPT of 3 dimensions


class FusionReport:
    """Report on the updates of a tracker, and on the parts that feed it."""

    def __init__(
        self,
        tracker: DualFootTracker,
        aligner: Aligner,
        parts: Sequence[Described],
        clock: Clock,
        logger: RcutilsLogger,
        *,
        external: bool,
    ) -> None:
        """Report on ``tracker`` and ``aligner``, and whatever the ``parts`` describe.

        ``external`` says that another node makes the pairs, so that nothing is to be interpolated.
        """
        self._tracker, self._aligner, self._parts = tracker, aligner, parts
        self._clock, self._logger, self._external = clock, logger, external
        self._aligner_rates, self._tracker_rates = Rates(), Rates()
        self._logged: dict[Refusal, float] = {}  # when pairs were refused for it last, s
        self._nis = float("nan")
        self._correction_m = 0.0
        self._phase = "aligning"
        self._start: Finding | None = None
        self._ride: Finding | None = None
        self._lost: Finding | None = None
        self._lost_ns = 0
        self._stance = dict.fromkeys(FEET, False)
        self._stamp_ns = 0
        self._last_stance_ns = dict.fromkeys(FEET, 0)
        self._rate_hz: float | None = None  # that is used
        self._stamps_ns: deque[int] = deque(maxlen=RATE_OVER)

    def add(self, update: Update) -> None:
        """Take one update."""
        if update.refused is not None:
            self._log_refusal(Refusal(update.refused))
        for event in update.announced:
            self._add_event(event)
        self._phase, self._stamp_ns = update.phase, update.stamp_ns
        if update.row is not None:
            self._stamps_ns.append(update.stamp_ns)
        for k, foot in enumerate(FEET):
            self._add_stance(foot, update, update.stance_nis(k))

    def _add_stance(self, foot: str, update: Update, nis: float | None) -> None:
        self._stance[foot] = nis is not None
        standing = nis is not None or update.phase != "walking"
        if standing or update.stamp_ns < self._last_stance_ns[foot]:
            self._last_stance_ns[foot] = update.stamp_ns
        if nis is not None and np.isfinite(nis):
            ratio = nis / 3.0
            first = not np.isfinite(self._nis)
            self._nis = ratio if first else NIS_MEMORY * self._nis + (1 - NIS_MEMORY) * ratio

    def _log_refusal(self, reason: Refusal) -> None:
        if reason not in self._logged:
            self._logger.warning(
                f"pairs are refused: {reason.words} (further ones are only counted, as "
                f"'tracker {reason}' in /diagnostics)"
            )
        self._logged[reason] = time.monotonic()

    def _log_refusals_over(self) -> None:
        now_s = time.monotonic()
        for reason, last_s in list(self._logged.items()):
            if now_s - last_s >= OVER_S:
                del self._logged[reason]
                self._logger.info(f"over: pairs are refused: {reason.words}")

    def _add_event(self, event: Event) -> None:
        if event.kind in LOGGED:
            self._logger.info(event_messages.summarise(event))
        if event.kind is EventKind.ALIGNED:
            self._start = next(start_findings([event]), None)
            self._rate_hz = float(event.detail["rate"])
            self._stamps_ns.clear()
            if self._start is not None:
                self._logger.warning(self._start.sentence)
            self._ride = None
        elif event.kind is EventKind.STOOD:
            self._start = None
        elif event.kind is EventKind.CARRIED:
            self._ride = next(ride_findings([event]), None)
        elif event.kind is EventKind.LOST:
            self._lost = next(lost_foot_findings([event]), None)
            self._lost_ns = event.detected_ns
        if event.kind is EventKind.CONSTRAINT and event.accepted and len(event.innovation):
            self._correction_m = float(np.linalg.norm(event.innovation))

    def collect(self, status: Status) -> None:
        """Fill in a status."""
        self._log_refusals_over()
        for part in self._parts:
            part.describe(status)
        self._describe_tracker(status)
        self._describe_stances(status)
        self._describe_counters(status)

    def _describe_tracker(self, status: Status) -> None:
        tracker = self._tracker
        status.values |= {
            "method": tracker.config.method,
            "phase": self._phase,
            "engine": tracker.engine,
            "lag (s)": self._lag(),
            "NIS ratio of ZUPT": self._nis,
            "last constraint innovation (m)": self._correction_m,
        }
        if tracker.spacing is not None:
            spacing, std = tracker.spacing
            status.values |= {"spacing of the feet (m)": spacing, "spacing std (m)": std}
        if self._start is not None:
            status.note(self._start)
        if self._rate_hz is not None:
            status.values["rate used (Hz)"] = self._rate_hz
            stamps_ns = np.fromiter(self._stamps_ns, dtype=np.int64)
            for finding in find_other_rate(self._rate_hz, stamps_ns):
                status.note(finding)
        if self._ride is not None:
            status.note(self._ride)
        if self._lost is not None and self._stamp_ns - self._lost_ns < LOST_SAID_NS:
            status.note(self._lost)
        if tracker.phase == "aligning" and tracker.complaint:
            text = f"aligning: stand still ({tracker.complaint})"
            status.note(Finding(FindingKind.ALIGNING, Severity.WARNING, text))

    def _lag(self) -> float | str:
        """Return the age of the newest estimate, s, where its stamp is of the node's clock."""
        if not self._stamp_ns:
            return float("nan")
        lag_s = (self._clock.now().nanoseconds - self._stamp_ns) * 1e-9
        return lag_s if abs(lag_s) < MOST_LAG_S else OTHER_CLOCK

    def _describe_stances(self, status: Status) -> None:
        for foot in FEET:
            status.values[f"{foot} stance"] = self._stance[foot]
            if self._stamp_ns - self._last_stance_ns[foot] > NO_STANCE_NS:
                text = f"no stance of the {foot} foot for 2 s of walking: check stance.threshold"
                kind = FindingKind.NO_STANCE
                status.note(Finding(kind, Severity.WARNING, text, about=foot))

    def _describe_counters(self, status: Status) -> None:
        aligned, tracked = self._aligner.counters, dict(self._tracker.counters)
        paired = self._aligner_rates.since_last(aligned)
        rates = self._tracker_rates.since_last(tracked)
        status.values["pair rate (Hz)"] = paired["pairs"]
        status.values |= {f"aligner {name}": n for name, n in aligned.items()}
        status.values |= {f"tracker {name}": n for name, n in tracked.items()}
        refused = [
            *(f"{words} (aligner {name})" for name, words in _select_warned(paired).items()),
            *(f"{words} (tracker {name})" for name, words in _select_warned(rates).items()),
        ]
        if refused:
            text = f"samples are refused: {', '.join(refused)}"
            status.note(Finding(FindingKind.REFUSED_SAMPLES, Severity.WARNING, text))
        if rates.get(Refusal.STANCES_WITHOUT_PRESSURE, 0.0) > 0:
            text = "stances have no air pressure: check its clock and rate"
            status.note(Finding(FindingKind.NO_PRESSURE, Severity.WARNING, text))
        if rates.get(Refusal.STANCES_WITHOUT_FIELD, 0.0) > 0:
            text = "stances have no magnetic field: check its stamps and rate"
            status.note(Finding(FindingKind.NO_FIELD, Severity.WARNING, text))
        if self._external and paired["interpolated"] > NOT_SHARED * paired["pairs"]:
            kind, text = FindingKind.STAMPS_NOT_SHARED, "the streams do not share their stamps"
            status.note(Finding(kind, Severity.WARNING, text, "use sync: internal"))


def _select_warned(rates: Mapping[str, float]) -> dict[str, str]:
    """Return the words of the refusals that go on and need a warning, by their counters."""
    reasons = {name: refusal_of(name) for name, rate in rates.items() if rate > 0}
    return {
        name: reason[0].words
        for name, reason in reasons.items()
        if reason is not None and reason[0].needs_warning
    }
