"""Findings of a node, and the status that they make up.

A finding has a kind, which code acts on, and a text, which is for people: the text may be reworded
without any change of behaviour.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple, Protocol

from diagnostic_msgs.msg import DiagnosticStatus

OK = DiagnosticStatus.OK
WARN = DiagnosticStatus.WARN
ERROR = DiagnosticStatus.ERROR


class FindingKind(StrEnum):
    """Kinds of findings."""

    # topics and links
    NO_PUBLISHER = "no_publisher"
    WRONG_TYPE = "wrong_type"
    QOS_MISFIT = "qos_misfit"
    NOT_BEGUN = "not_begun"
    BEGINS_LATE = "begins_late"
    SILENT = "silent"
    LOST_MESSAGES = "lost_messages"
    # devices
    LINK_DOWN = "link_down"
    NOTHING_USABLE = "nothing_usable"
    STRANGERS_ONLY = "strangers_only"
    NO_FRAMES = "no_frames"
    NO_DEVICE_TIME = "no_device_time"
    MIXED_SENDERS = "mixed_senders"
    LOSSES = "losses"
    SENSOR_FAULT = "sensor_fault"
    # samples and their stamps
    REFUSED_SAMPLES = "refused_samples"
    WRONG_UNIT = "wrong_unit"
    NOT_STAMPED = "not_stamped"
    CLOCK_REFUSED = "clock_refused"
    CLOCK_SETTLING = "clock_settling"
    CLOCK_IN_STEP = "clock_in_step"
    STAMPS_APART = "stamps_apart"
    LATE_SAMPLES = "late_samples"
    STAMPS_NOT_SHARED = "stamps_not_shared"
    # the walk
    ALIGNING = "aligning"
    NO_STANCE = "no_stance"
    NO_PRESSURE = "no_pressure"
    NO_FIELD = "no_field"


class Key(NamedTuple):
    """Identity of a finding: its kind, and which of several it is about (a foot, a topic ...)."""

    kind: FindingKind
    about: str


@dataclass(frozen=True)
class Finding:
    """Something that is wrong.

    Attributes
    ----------
    kind : what code acts on
    level : WARN or ERROR
    text : one sentence for people
    about : which of several it is about: a foot, a topic, a fault; "" where there is one only
    logged : whether it is also logged, once when it begins
    """

    kind: FindingKind
    level: bytes
    text: str
    about: str = ""
    logged: bool = False

    @property
    def key(self) -> Key:
        """Identity of the finding, whatever its level and its text."""
        return Key(self.kind, self.about)


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
        """The first finding of the highest level."""
        return max(self.findings, key=lambda finding: finding.level, default=None)

    @property
    def level(self) -> bytes:
        """Highest level of the findings."""
        return OK if self.worst is None else self.worst.level

    @property
    def message(self) -> str:
        """Text of the worst finding."""
        return "ok" if self.worst is None else self.worst.text


class Described(Protocol):
    """A part of a node that has something to report."""

    def describe(self, status: Status) -> None:
        """Add values and findings to a status."""
