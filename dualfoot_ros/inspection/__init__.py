"""What a recording or a live stream is worth: the checks behind ``info`` and the nodes."""

from .exchanged_feet import walk_findings
from .field_facts import FieldFacts
from .findings import (
    GRAVITY,
    GRAVITY_ERROR,
    STUCK_SHARE,
    Finding,
    fields_of,
    findings_of,
    qualities_of,
    require_usable,
)
from .lateral_spacing import SideBySide, side_by_side, straight
from .passings import SHARE, Passing, passings_of
from .pressure_facts import PressureFacts, facts_of, wearer
from .quality import Quality, quality_of
from .stance_statistics import Stances, free_config, free_tracks, stances_of
from .stuck_values import TRIADS, Held, Stuck, held_at_rest

__all__ = [
    "GRAVITY",
    "GRAVITY_ERROR",
    "SHARE",
    "STUCK_SHARE",
    "TRIADS",
    "FieldFacts",
    "Finding",
    "Held",
    "Passing",
    "PressureFacts",
    "Quality",
    "SideBySide",
    "Stances",
    "Stuck",
    "facts_of",
    "fields_of",
    "findings_of",
    "free_config",
    "free_tracks",
    "held_at_rest",
    "passings_of",
    "qualities_of",
    "quality_of",
    "require_usable",
    "side_by_side",
    "stances_of",
    "straight",
    "walk_findings",
    "wearer",
]
