"""Gap between the stamps of the feet: the foot that is behind, by how much, and the remedy."""

from __future__ import annotations

import time
from collections.abc import Mapping

from ...core import FEET, Refusal
from ...inspection import Finding, FindingKind, Severity
from ...timing import Aligner
from ..ros.status import Status

UNPAIRED_S = 2.0  # without a pair while both feet deliver, by the wall clock
DELIVERS_S = 1.0  # a foot without a sample for longer is silent, which its input reports
REASONS = (Refusal.NOT_FINITE, Refusal.DUPLICATE, Refusal.OUT_OF_ORDER)
REMEDY = (
    "set stamping.left and stamping.right to device (stamp, where imu_adapter does it), or "
    "add {offset:.3f} s with stamping.right_offset; for a recording use dualfoot sync"
)


class StampGap:
    """Comparison of the stamps of both feet, as they are given to an aligner."""

    def __init__(self, aligner: Aligner) -> None:
        self._aligner = aligner
        self._newest_ns: dict[str, int] = {}
        self._seen_s: dict[str, float] = {}
        self._behind_ns = dict.fromkeys(FEET, 0)  # the most, since the last report
        self._pairs = self._late = 0
        self._refused: Mapping[str, int] = aligner.counters
        self._unpaired_s = 0.0  # since when both deliver and no pair is made

    def observe(self, foot: str, stamp_ns: int) -> None:
        """Take the stamp of a sample that is given to the aligner."""
        other, now_s = _other(foot), time.monotonic()
        pairs = self._aligner.pairs_of_both
        if pairs != self._pairs or now_s - self._seen_s.get(other, -DELIVERS_S) >= DELIVERS_S:
            self._pairs, self._unpaired_s = pairs, now_s
        self._newest_ns[foot], self._seen_s[foot] = stamp_ns, now_s
        other_ns = self._newest_ns.get(other)
        if other_ns is not None:
            self._behind_ns[foot] = max(self._behind_ns[foot], other_ns - stamp_ns)

    def describe(self, status: Status) -> None:
        """Add to a status how far the stamps are apart, and the samples lost by it."""
        counters = self._aligner.counters
        late, self._late = counters["late"] - self._late, counters["late"]
        refused = self._refused_most(counters)
        if len(self._newest_ns) == len(FEET):
            status.values["right less left, newest stamps (s)"] = 1e-9 * self._right_less_left_ns()
        if self._is_unpaired():
            apart = abs(self._right_less_left_ns()) > self._aligner.config.max_delay_ns
            status.note(self._gap_finding() if apart else _find_no_pairs(refused))
        elif late > 0:
            text = self._describe_late(late)
            status.note(Finding(FindingKind.LATE_SAMPLES, Severity.WARNING, text))
        self._behind_ns = dict.fromkeys(FEET, 0)

    def _right_less_left_ns(self) -> int:
        return self._newest_ns["right"] - self._newest_ns["left"]

    def _refused_most(self, counters: Mapping[str, int]) -> tuple[str, int]:
        """Return the words of the refusal that has grown most since the last report, by how much.

        The words are empty where nothing was refused.
        """
        new = {name: count - self._refused.get(name, 0) for name, count in counters.items()}
        self._refused = counters
        found = [
            (new[f"{foot}_{reason}"], f"{reason.words}, of the {foot} foot")
            for foot in FEET
            for reason in REASONS
        ]
        most, words = max(found)
        return (words, most) if most > 0 else ("", 0)

    def _is_unpaired(self) -> bool:
        """Return whether both feet deliver and have made no pair of both for some seconds."""
        now_s = time.monotonic()
        deliver = len(self._seen_s) == len(FEET) and (
            now_s - min(self._seen_s.values()) < DELIVERS_S
        )
        return deliver and now_s - self._unpaired_s >= UNPAIRED_S

    def _gap_finding(self) -> Finding:
        right_less_left_s = 1e-9 * self._right_less_left_ns()
        foot = "left" if right_less_left_s > 0.0 else "right"
        text = (
            f"no pairs: the stamps of the {foot} foot are {abs(right_less_left_s):.1f} s behind "
            f"those of the {_other(foot)} foot, where aligner.max_delay is "
            f"{self._aligner.config.max_delay:g} s"
        )
        remedy = REMEDY.format(offset=-right_less_left_s)
        return Finding(FindingKind.STAMPS_APART, Severity.ERROR, text, remedy)

    def _describe_late(self, late: int) -> str:
        foot = max(FEET, key=self._behind_ns.__getitem__)
        return (
            f"samples of the {foot} foot come too late: up to "
            f"{1e-9 * self._behind_ns[foot]:.3f} s behind those of the {_other(foot)} foot "
            f"where aligner.max_delay is {self._aligner.config.max_delay:g} s; {late} are dropped"
        )


def _find_no_pairs(refused: tuple[str, int]) -> Finding:
    words, count = refused
    why = f"{count} samples were refused: {words}" if words else "their holes cover each other"
    text = f"no pairs: both feet deliver and no pair of both came for {UNPAIRED_S:g} s; {why}"
    return Finding(FindingKind.NO_PAIRS, Severity.ERROR, text, "check the stamps of both feet")


def _other(foot: str) -> str:
    return FEET[1 - FEET.index(foot)]
