"""Losses of a sensor: samples that are lost on the way or refused, and the reasons."""

from __future__ import annotations

from collections.abc import Mapping

from ...core import Refusal
from ...inspection import Finding, FindingKind, Severity
from ..ros.status import Status

SHARE = 0.03  # of the samples of a period; fewer are only counted
LEAST = 3  # samples
LEAST_BYTES = 100
REFUSED = (
    Refusal.NOT_FINITE,
    Refusal.OUT_OF_RANGE,
    Refusal.BAD_CHECKSUM,
    Refusal.MALFORMED,
    Refusal.INCOMPLETE,
)
LOSSES = (Refusal.LOST, *REFUSED)
BYTES, SAMPLES = "bytes", "samples"


def select_counts(counters: Mapping[str, int]) -> dict[str, int]:
    """Return the counters of samples and of the reasons for losses; an absent one is 0."""
    names = (BYTES, SAMPLES, Refusal.GARBAGE_BYTES, *LOSSES)
    return {name: counters.get(name, 0) for name in names}


def increases(now: Mapping[str, int], before: Mapping[str, int]) -> dict[str, int]:
    """Return the increase of each counter."""
    return {name: count - before.get(name, 0) for name, count in now.items()}


def count_lost(counts: Mapping[str, int]) -> int:
    """Return the samples lost on the way; a frame that cannot be read is not lost as well."""
    unread = counts.get(Refusal.BAD_CHECKSUM, 0) + counts.get(Refusal.MALFORMED, 0)
    return max(0, counts.get(Refusal.LOST, 0) - unread)


def in_words(counts: Mapping[str, int]) -> str:
    """Return the losses that are not zero, each with its count; empty when all are."""
    return _list({**counts, Refusal.LOST: count_lost(counts)})


def _list(counts: Mapping[str, int]) -> str:
    reasons = [reason for reason in (*LOSSES, Refusal.GARBAGE_BYTES) if counts.get(reason)]
    return ", ".join(f"{reason.words} ({counts[reason]})" for reason in reasons)


class LossReport:
    """Warning when more than a few percent of a report's period are lost or refused."""

    def __init__(self) -> None:
        self._before: dict[str, int] = {}

    def describe(self, counters: Mapping[str, int], status: Status) -> None:
        """Take the counters at the end of a period; add the losses that are too many."""
        now = select_counts(counters)
        counts, self._before = increases(now, self._before), now
        counts[Refusal.LOST] = count_lost(counts)
        missing = (reason for reason in LOSSES if reason is not Refusal.OUT_OF_RANGE)
        total = counts[SAMPLES] + sum(counts[reason] for reason in missing)
        limit = max(LEAST, SHARE * total)
        many: dict[str, int] = {r: counts[r] for r in LOSSES if counts[r] >= limit}
        garbage = counts[Refusal.GARBAGE_BYTES]
        if garbage >= max(LEAST_BYTES, SHARE * counts[BYTES]):
            many[Refusal.GARBAGE_BYTES] = garbage
        mixed = any(status.of_kind(FindingKind.MIXED_SENDERS))
        if many and not mixed:  # between the numberings of two devices there are only holes
            text = f"lost or refused of {total} samples since the last report: {_list(many)}"
            about = " ".join(many)
            status.note(Finding(FindingKind.LOSSES, Severity.WARNING, text, about=about))
