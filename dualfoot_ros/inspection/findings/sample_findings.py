"""Findings on samples of a foot that cannot be used at all."""

from __future__ import annotations

from collections.abc import Iterator

from ..quality import Quality
from .finding import Finding, Severity
from .finding_kinds import FindingKind

LEAST_SAMPLES = 2  # of a foot; nothing can be found out about fewer


def find_not_finite(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when samples have nan or inf."""
    if quality.not_finite:
        yield Finding(
            FindingKind.NOT_FINITE,
            Severity.ERROR,
            f"{foot} foot: {quality.not_finite} of {quality.samples} samples are not finite (nan "
            f"or inf), the first is sample {quality.first_not_finite}",
            "repair the driver or the export, or leave them out with 'dualfoot evaluate "
            "--allow-nan'",
            foot,
        )


def find_too_few(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when too few samples can be used."""
    if quality.usable < LEAST_SAMPLES:
        yield Finding(
            FindingKind.EMPTY,
            Severity.ERROR,
            f"{foot} foot: {quality.usable} of {quality.samples} samples can be used "
            f"({quality.not_finite} not finite, {quality.duplicate} duplicate and "
            f"{quality.out_of_order} out-of-order stamps)",
            _few_remedy(quality),
            foot,
        )


def _few_remedy(quality: Quality) -> str:
    if quality.duplicate > quality.samples // 2:
        return (
            "the headers have no stamps, so take the times at which the messages were logged, "
            "with 'dualfoot import BAG --stamps log -o NEW'"
        )
    return "check the driver's stamps and values"


def find_second_recording(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the stamps begin anew."""
    if quality.usable >= LEAST_SAMPLES and quality.begins_anew:
        yield Finding(
            FindingKind.BEGINS_ANEW,
            Severity.ERROR,
            f"{foot} foot: the stamps jump back and go on from there, so these are two recordings "
            "in one bag",
            "cut it there",
            foot,
        )
