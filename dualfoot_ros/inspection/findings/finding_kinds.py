"""Kinds of findings, on recordings and live: what code acts on."""

from __future__ import annotations

from enum import StrEnum


class FindingKind(StrEnum):
    """The subject of a finding; the values are the names in ``dualfoot info --json``.

    Attributes
    ----------
    logged_once : whether a node logs it once when it begins; the others stand in the report only,
        or are logged by whoever finds them
    """

    logged_once: bool

    def __new__(cls, name: str, logged_once: bool = False) -> FindingKind:
        """Make a member whose value is ``name``."""
        member = str.__new__(cls, name)
        member._value_ = name
        member.logged_once = logged_once
        return member

    # samples of a foot
    MISSING = "missing"
    CUT_OFF = "cut_off"
    NOT_FINITE = "not_finite"
    EMPTY = "empty"
    REFUSED_SAMPLES = "refused_samples"
    FORCE_UNIT = "force_unit"
    RATE_UNIT = "rate_unit"
    STUCK = "stuck", True
    CLIPPING = "clipping", True
    NO_STANDSTILL = "no_standstill"
    LATE_STANDSTILL = "late_standstill"
    GAPS = "gaps"
    WRONG_RATE = "wrong_rate", True

    # stamps and clocks
    BEGINS_ANEW = "begins_anew"
    STAMPS = "stamps"
    EQUAL_STAMPS = "equal_stamps"
    JITTER = "jitter"
    NO_OVERLAP = "no_overlap"
    RATES = "rates"
    NOT_STAMPED = "not_stamped"
    CLOCK_REFUSED = "clock_refused", True
    CLOCK_SETTLING = "clock_settling"
    CLOCK_IN_STEP = "clock_in_step", True
    STAMPS_APART = "stamps_apart", True
    LATE_SAMPLES = "late_samples", True
    STAMPS_NOT_SHARED = "stamps_not_shared"

    # air pressure and magnetic field
    PRESSURE_RANGE = "pressure_range"
    PRESSURE_STAMPS = "pressure_stamps"
    PRESSURE_CLOCK = "pressure_clock"
    NO_PRESSURE = "no_pressure"
    FIELD_STAMPS = "field_stamps"
    FIELD_RANGE = "field_range"
    NO_FIELD = "no_field"

    # the walk
    EXCHANGED_FEET = "swapped"
    ALIGNING = "aligning"
    NO_STANCE = "no_stance"

    # topics
    NO_PUBLISHER = "no_publisher"
    WRONG_TYPE = "wrong_type"
    QOS_MISFIT = "qos_misfit"
    NOT_BEGUN = "not_begun"
    BEGINS_LATE = "begins_late"
    SILENT = "silent"
    LOST_MESSAGES = "lost_messages"

    # links and devices
    LINK_DOWN = "link_down"
    NOTHING_USABLE = "nothing_usable"
    STRANGERS_ONLY = "strangers_only"
    NO_FRAMES = "no_frames"
    NO_DEVICE_TIME = "no_device_time"
    MIXED_SENDERS = "mixed_senders", True
    LOSSES = "losses", True
