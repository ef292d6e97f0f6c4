"""A finding, recorded or live: kind and severity for programs, text and remedy for people."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

from .finding_kinds import FindingKind


class Severity(StrEnum):
    """Gravity of a finding, the mildest first."""

    WARNING = "warning"
    """The samples can be used, but the track may suffer."""
    ERROR = "error"
    """The recording cannot be used, or the node does not work."""

    @property
    def rank(self) -> int:
        """Number to compare by: 1 for the mildest, so that 0 is no finding at all."""
        return 1 + list(Severity).index(self)


class Key(NamedTuple):
    """Identity of a finding, whatever its severity and its words."""

    kind: FindingKind
    about: str


class Finding(NamedTuple):
    """One observation about a recording or a live stream that its user should know.

    Attributes
    ----------
    kind, severity : code decides by these alone
    text : what is wrong, and where
    remedy : what to do about it; empty where there is nothing to do
    about : which of several of its kind it is: a foot, a topic, a fault; empty for the only one
    """

    kind: FindingKind
    severity: Severity
    text: str
    remedy: str = ""
    about: str = ""

    @property
    def key(self) -> Key:
        """Identity of the finding."""
        return Key(self.kind, self.about)

    @property
    def is_error(self) -> bool:
        """Whether it keeps the recording from being used, or the node from its work."""
        return self.severity is Severity.ERROR

    @property
    def sentence(self) -> str:
        """Text and remedy in one sentence."""
        return f"{self.text}; {self.remedy}" if self.remedy else self.text

    def to_dict(self) -> dict[str, str]:
        """Return the finding in plain values, as ``dualfoot info --json`` has it."""
        return {
            "severity": self.severity.value,
            "name": self.kind.value,
            "sentence": self.sentence,
        }
