"""What a recording or a live stream is worth: facts in figures, and findings."""

from .arrival_facts import ArrivalFacts, advice_on, arrival_facts, describe_arrival
from .field_facts import FieldFacts, field_facts, recorded_fields
from .findings import (
    GRAVITY_ERROR,
    STUCK_SHARE,
    Finding,
    FindingKind,
    Key,
    Severity,
    check_usable,
    findings_of,
    qualities_of,
    require_usable,
    walk_findings,
)
from .lateral_spacing import SideBySide, side_by_side, straight
from .pressure_facts import PressureFacts, pressure_facts, wearer_words
from .quality import Quality, quality_of
from .stance_statistics import StanceStatistics, stance_statistics, unconstrained_config
from .stuck_values import AXES, TRIADS, Channel, Held, Stuck, held_at_rest

__all__ = [
    "AXES",
    "GRAVITY_ERROR",
    "STUCK_SHARE",
    "TRIADS",
    "ArrivalFacts",
    "Channel",
    "FieldFacts",
    "Finding",
    "FindingKind",
    "Held",
    "Key",
    "PressureFacts",
    "Quality",
    "Severity",
    "SideBySide",
    "StanceStatistics",
    "Stuck",
    "advice_on",
    "arrival_facts",
    "check_usable",
    "describe_arrival",
    "field_facts",
    "findings_of",
    "held_at_rest",
    "pressure_facts",
    "qualities_of",
    "quality_of",
    "recorded_fields",
    "require_usable",
    "side_by_side",
    "stance_statistics",
    "straight",
    "unconstrained_config",
    "walk_findings",
    "wearer_words",
]
