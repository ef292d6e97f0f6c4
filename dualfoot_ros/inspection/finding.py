"""A finding on a recording: kind and severity for programs, text and remedy for people."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How grave a finding is."""

    WARNING = "warning"
    """The recording can be used, but its figures may suffer."""
    ERROR = "error"
    """The recording cannot be used."""


class FindingKind(StrEnum):
    """The subject of a finding; the values are the names in ``dualfoot info --json``."""

    MISSING = "missing"
    NOT_FINITE = "not_finite"
    EMPTY = "empty"
    BEGINS_ANEW = "begins_anew"
    FORCE_UNIT = "force_unit"
    RATE_UNIT = "rate_unit"
    NO_OVERLAP = "no_overlap"
    RATES = "rates"
    STUCK = "stuck"
    NO_STANDSTILL = "no_standstill"
    LATE_STANDSTILL = "late_standstill"
    GAPS = "gaps"
    STAMPS = "stamps"
    CLIPPING = "clipping"
    PRESSURE_RANGE = "pressure_range"
    PRESSURE_STAMPS = "pressure_stamps"
    PRESSURE_CLOCK = "pressure_clock"
    FIELD_STAMPS = "field_stamps"
    FIELD_RANGE = "field_range"
    EXCHANGED_FEET = "swapped"


@dataclass(frozen=True)
class Finding:
    """One observation about a recording that its user should know.

    Attributes
    ----------
    kind, severity : code decides by these alone
    text : what is wrong, and where
    remedy : what to do about it; empty where there is nothing to do
    """

    kind: FindingKind
    severity: Severity
    text: str
    remedy: str = ""

    @property
    def is_error(self) -> bool:
        """Whether it keeps the recording from being used."""
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
