"""Status of a node: named values and findings, and the level that they make up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Protocol

from diagnostic_msgs.msg import DiagnosticStatus

from ...inspection import Finding, FindingKind, Severity

OK: bytes = DiagnosticStatus.OK
WARN: bytes = DiagnosticStatus.WARN
ERROR: bytes = DiagnosticStatus.ERROR
LEVELS = {Severity.WARNING: WARN, Severity.ERROR: ERROR}


@dataclass
class Status:
    """Status of a node: named values, and findings, of which the worst decides the level."""

    values: dict[str, Any] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)

    def note(self, finding: Finding) -> None:
        """Add a finding."""
        self.findings.append(finding)

    def of_kind(self, kind: FindingKind) -> Iterator[Finding]:
        """Yield the findings of a kind."""
        return (finding for finding in self.findings if finding.kind is kind)

    @property
    def worst(self) -> Finding | None:
        """The first of the gravest findings."""
        return max(self.findings, key=lambda finding: finding.severity.rank, default=None)

    @property
    def level(self) -> bytes:
        """Level of the worst finding."""
        return OK if self.worst is None else LEVELS[self.worst.severity]

    @property
    def message(self) -> str:
        """Sentence of the worst finding."""
        return "ok" if self.worst is None else self.worst.sentence


class Described(Protocol):
    """A part of a node that has something to report."""

    def describe(self, status: Status) -> None:
        """Add values and findings to a status."""
