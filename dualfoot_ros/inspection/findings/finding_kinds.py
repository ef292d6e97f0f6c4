"""Kinds of findings, on recordings and live: what code acts on."""

from __future__ import annotations

from enum import StrEnum


class FindingKind(StrEnum):
    """The subject of a finding; the values are the names in ``dualfoot info --json``.

    Attributes
    ----------
    logged_once : whether a node logs it once when it begins; the others stand in the report only,
        or are logged by whoever finds them
    momentary : whether it is about a moment, so that a node does not log that it is over
    """

    logged_once: bool
    momentary: bool

    def __new__(cls, name: str, logged_once: bool = False, momentary: bool = False) -> FindingKind:
        """Make a member whose value is ``name``."""
        member = str.__new__(cls, name)
        member._value_ = name
        member.logged_once, member.momentary = logged_once, momentary
        return member

    # samples of a foot
    MISSING = "missing"
    CUT_OFF = "cut_off"
    NOT_FINITE = "not_finite"
    EMPTY = "empty"
    REFUSED_SAMPLES = "refused_samples"
    FORCE_UNIT = "force_unit"
    RATE_UNIT = "rate_unit"
    GRAVITY = "gravity", True
    RATE_AXES = "rate_axes", True
    RATE_SCALE = "rate_scale", True
    RATE_MISFIT = "rate_misfit", True
    STUCK = "stuck", True
    CLIPPING = "clipping", True
    NO_STANDSTILL = "no_standstill"
    LATE_STANDSTILL = "late_standstill"
    GAPS = "gaps"
    MISSING_SAMPLES = "missing_samples", True
    JITTER = "jitter", True
    LOW_RATE = "low_rate", True
    SAME_SAMPLES = "same_samples", True
    WRONG_RATE = "wrong_rate", True
    RATE_USED = "rate_used", True

    # stamps and clocks
    BEGINS_ANEW = "begins_anew"
    STAMPS = "stamps"
    OVERLAID = "overlaid", True
    NO_OVERLAP = "no_overlap"
    RATES = "rates"
    CLOCKS_APART = "clocks_apart", True
    ONE_FOOT = "one_foot"
    NOT_STAMPED = "not_stamped"
    CLOCK_REFUSED = "clock_refused", True
    CLOCK_SETTLING = "clock_settling"
    CLOCK_IN_STEP = "clock_in_step", True
    STAMPS_APART = "stamps_apart", True
    LATE_SAMPLES = "late_samples", True
    STAMPS_NOT_SHARED = "stamps_not_shared"
    ZERO_STAMPS = "zero_stamps", True
    EQUAL_STAMPS = "equal_stamps", True
    CLOCK_SET = "clock_set", True, True
    NO_PAIRS = "no_pairs", True
    STALE_FOOT = "stale_foot", True

    # air pressure and magnetic field
    PRESSURE_RANGE = "pressure_range"
    PRESSURE_STAMPS = "pressure_stamps"
    PRESSURE_CLOCK = "pressure_clock"
    NO_PRESSURE = "no_pressure"
    FIELD_STAMPS = "field_stamps"
    FIELD_RANGE = "field_range"
    NO_FIELD = "no_field"

    # the walk
    EXCHANGED_FEET = "swapped", True
    ALIGNING = "aligning"
    NO_STANCE = "no_stance"
    RESTLESS_START = "restless_start"
    NOT_TRACKED = "not_tracked"
    MISSED_STANCES = "missed_stances", True
    LONG_STRIDE = "long_stride", True
    STANCE_SHARE = "stance_share", True
    UNEQUAL_WAYS = "unequal_ways", True
    MIRRORED_FOOT = "mirrored_foot", True
    FEET_APART = "feet_apart", True
    SPACING = "spacing", True
    CARRIED = "carried", True
    LOST_HEADING = "lost_heading", True
    LOST_FOOT = "lost_foot", True, True

    # topics
    NO_PUBLISHER = "no_publisher"
    WRONG_TYPE = "wrong_type"
    QOS_MISFIT = "qos_misfit"
    NOT_BEGUN = "not_begun"
    BEGINS_LATE = "begins_late"
    SILENT = "silent"
    LOST_MESSAGES = "lost_messages"
    FALLING_BEHIND = "falling_behind", True

    # links and devices
    LINK_DOWN = "link_down"
    NOTHING_USABLE = "nothing_usable"
    STRANGERS_ONLY = "strangers_only"
    NO_FRAMES = "no_frames"
    NO_DEVICE_TIME = "no_device_time"
    MIXED_SENDERS = "mixed_senders", True
    LOSSES = "losses", True
