"""How fusion is doing: what its diagnostics and its log say."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...core import FEET, Event, EventKind, Update
from ..ros.diagnostics import WARN, Rates, Status
from . import event_messages as events

if TYPE_CHECKING:
    from ..fusion import FusionNode

LOGGED = (EventKind.ALIGNED, EventKind.HEADING, EventKind.RESET)
NO_STANCE_NS = 5_000_000_000
NIS_MEMORY = 0.99  # of the running mean, a ZUPT of 3 dimensions


class Health:
    """Watches the updates of a fusion node and tells about them."""

    def __init__(self, node: FusionNode, sync: str) -> None:
        self._node, self._external = node, sync == "external"
        self._rates = Rates()
        self._seen: dict[str, int] = {}
        self._nis = float("nan")
        self._correction_m = 0.0
        self._phase = "aligning"
        self._stance = dict.fromkeys(FEET, False)
        self._stamp_ns = 0
        self._last_stance_ns = dict.fromkeys(FEET, 0)

    def add(self, update: Update) -> None:
        """Take one update."""
        if update.refused is not None:
            self._say_refusal(update.refused)
        for event in update.announced:
            self._happened(event)
        self._phase, self._stamp_ns = update.phase, update.stamp_ns
        zupts = {e.foot: e.nis for e in update.events if e.kind is EventKind.ZUPT}
        for foot in FEET:
            self._look_at(foot, update, zupts.get(foot))

    def _look_at(self, foot: str, update: Update, nis: float | None) -> None:
        self._stance[foot] = nis is not None
        standing = nis is not None or update.phase != "walking"
        if standing or update.stamp_ns < self._last_stance_ns[foot]:
            self._last_stance_ns[foot] = update.stamp_ns
        if nis is not None and np.isfinite(nis):
            ratio = nis / 3.0
            first = not np.isfinite(self._nis)
            self._nis = ratio if first else NIS_MEMORY * self._nis + (1 - NIS_MEMORY) * ratio

    def _say_refusal(self, name: str) -> None:
        self._seen[name] = self._seen.get(name, 0) + 1
        if self._seen[name] == 1:
            self._node.get_logger().warning(
                f"pairs are refused: {name} (from now on only counted, see /diagnostics)"
            )

    def _happened(self, event: Event) -> None:
        if event.kind in LOGGED:
            self._node.get_logger().info(events.words(event))
        if event.kind is EventKind.CONSTRAINT and event.accepted and len(event.innovation):
            self._correction_m = float(np.linalg.norm(event.innovation))

    def collect(self, status: Status) -> None:
        """Fill in a report."""
        self._node.watch.describe(status)
        self._node.stamper.describe(status)
        self._node.apart.describe(status)
        for suspicion in self._node.suspicions.values():
            for sentence in suspicion.said:
                status.note(WARN, sentence)
        self._describe_state(status)
        self._describe_counters(status)

    def _describe_state(self, status: Status) -> None:
        tracker = self._node.tracker
        now_ns = self._node.get_clock().now().nanoseconds
        status.values |= {
            "method": tracker.config.method,
            "phase": self._phase,
            "engine": tracker.engine,
            "lag (s)": (now_ns - self._stamp_ns) * 1e-9 if self._stamp_ns else float("nan"),
            "NIS ratio of ZUPT": self._nis,
            "last constraint innovation (m)": self._correction_m,
        }
        status.values |= {f"{foot} stance": self._stance[foot] for foot in FEET}
        if tracker.spacing is not None:
            spacing, std = tracker.spacing
            status.values |= {"spacing of the feet (m)": spacing, "spacing std (m)": std}
        if tracker.phase == "aligning" and tracker.complaint:
            status.note(WARN, f"aligning: stand still ({tracker.complaint})")
        for foot in FEET:
            if self._stamp_ns - self._last_stance_ns[foot] > NO_STANCE_NS:
                status.note(
                    WARN,
                    f"no stance of the {foot} foot for 5 s of walking: check stance.threshold",
                )

    def _describe_counters(self, status: Status) -> None:
        aligner, tracker = self._node.aligner.counters, dict(self._node.tracker.counters)
        rates = self._rates.since_last(
            {f"aligner {k}": n for k, n in aligner.items()}
            | {f"tracker {k}": n for k, n in tracker.items()}
        )
        status.values["pair rate (Hz)"] = rates["aligner pairs"]
        status.values |= {f"aligner {name}": n for name, n in aligner.items()}
        status.values |= {f"tracker {name}": n for name, n in tracker.items()}
        bad = [name for name, rate in rates.items() if rate > 0 and _is_refusal(name)]
        if bad:
            status.note(WARN, f"samples are refused: {', '.join(bad)}")
        if rates.get("tracker stances_without_pressure", 0.0) > 0:
            status.note(WARN, "stances go without air pressure: check its clock and rate")
        if rates.get("tracker stances_without_field", 0.0) > 0:
            status.note(WARN, "stances go without a magnetic field: check its stamps and rate")
        if self._external and rates["aligner interpolated"] > 0:
            status.note(WARN, "the streams do not share their stamps; use sync: internal")


def _is_refusal(name: str) -> bool:
    words = ("not_finite", "out_of_range", "out_of_order", "far_ahead")
    return name.endswith(words)
