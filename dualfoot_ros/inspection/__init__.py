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
    coupled_findings,
    find_other_rate,
    findings_of,
    lost_foot_findings,
    lost_heading,
    qualities_of,
    require_usable,
    ride_findings,
    start_findings,
    tracker_findings,
    walk_findings,
)
from .gyro_agreement import GyroAgreement, RateError, gyro_agreement
from .lateral_spacing import SideBySide, side_by_side, straight
from .mended_clocks import mend_clocks
from .pressure_facts import PressureFacts, pressure_facts, wearer_words
from .quality import Quality, quality_of
from .stance_statistics import StanceStatistics, stance_statistics, unconstrained_config
from .stretch import SIGNALS_S, WALK_S, Stretch, signal_findings, track_findings
from .stuck_values import AXES, TRIADS, Channel, Held, Stuck, held_at_rest
from .walk_facts import LEAST_HOLE_S, StepFacts, WalkFacts, longest_holes_s, walk_facts

__all__ = [
    "AXES",
    "GRAVITY_ERROR",
    "LEAST_HOLE_S",
    "SIGNALS_S",
    "STUCK_SHARE",
    "TRIADS",
    "WALK_S",
    "ArrivalFacts",
    "Channel",
    "FieldFacts",
    "Finding",
    "FindingKind",
    "GyroAgreement",
    "Held",
    "Key",
    "PressureFacts",
    "Quality",
    "RateError",
    "Severity",
    "SideBySide",
    "StanceStatistics",
    "StepFacts",
    "Stretch",
    "Stuck",
    "WalkFacts",
    "advice_on",
    "arrival_facts",
    "check_usable",
    "coupled_findings",
    "describe_arrival",
    "field_facts",
    "find_other_rate",
    "findings_of",
    "gyro_agreement",
    "held_at_rest",
    "longest_holes_s",
    "lost_foot_findings",
    "lost_heading",
    "mend_clocks",
    "pressure_facts",
    "qualities_of",
    "quality_of",
    "recorded_fields",
    "require_usable",
    "ride_findings",
    "side_by_side",
    "signal_findings",
    "stance_statistics",
    "start_findings",
    "straight",
    "track_findings",
    "tracker_findings",
    "unconstrained_config",
    "walk_facts",
    "walk_findings",
    "wearer_words",
]
