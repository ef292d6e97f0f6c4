"""Findings on recordings and live streams: one class, one list of kinds, a function for each."""

from .finding import Finding, Key, Severity
from .finding_kinds import FindingKind
from .rate_findings import find_other_rate, seen_rate_hz
from .recording_findings import check_usable, findings_of, qualities_of, require_usable
from .ride_findings import ride_findings
from .stream_findings import STUCK_SHARE
from .tracker_findings import (
    lost_foot_findings,
    lost_heading,
    start_findings,
    tracker_findings,
)
from .unit_findings import GRAVITY_ERROR
from .walk_findings import coupled_findings, walk_findings

__all__ = [
    "GRAVITY_ERROR",
    "STUCK_SHARE",
    "Finding",
    "FindingKind",
    "Key",
    "Severity",
    "check_usable",
    "coupled_findings",
    "find_other_rate",
    "findings_of",
    "lost_foot_findings",
    "lost_heading",
    "qualities_of",
    "require_usable",
    "ride_findings",
    "seen_rate_hz",
    "start_findings",
    "tracker_findings",
    "walk_findings",
]
