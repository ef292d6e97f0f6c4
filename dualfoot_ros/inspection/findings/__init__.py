"""Findings on recordings and live streams: one class, one list of kinds, a function for each."""

from .finding import Finding, Key, Severity
from .finding_kinds import FindingKind
from .recording_findings import check_usable, findings_of, qualities_of, require_usable
from .ride_findings import ride_findings
from .start_findings import start_findings
from .stream_findings import STUCK_SHARE
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
    "findings_of",
    "qualities_of",
    "require_usable",
    "ride_findings",
    "start_findings",
    "walk_findings",
]
