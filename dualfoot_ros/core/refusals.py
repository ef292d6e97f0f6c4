"""Reasons for which data is refused or missing: one name, one wording and one rule each."""

from __future__ import annotations

from enum import StrEnum

from .results.events import FEET


class Refusal(StrEnum):
    """A reason why a sample, a pair, a frame or a stance was not used.

    The value is the name of its counter, as it stands in diagnostics and in JSON.

    Attributes
    ----------
    words : the reason as a phrase that can follow a colon
    needs_warning : whether a node warns as long as its counter grows; the others are counted, or
        are warned of by whoever knows more about them
    """

    words: str
    needs_warning: bool

    def __new__(cls, counter: str, words: str = "", needs_warning: bool = False) -> Refusal:
        """Make a member whose value is ``counter``."""
        member = str.__new__(cls, counter)
        member._value_ = counter
        member.words, member.needs_warning = words, needs_warning
        return member

    # samples and pairs
    NOT_FINITE = "not_finite", "values that are not finite", True
    OUT_OF_RANGE = "out_of_range", "values beyond the range of the sensor", True
    DUPLICATE = "duplicate", "a stamp that was there already"
    OUT_OF_ORDER = "out_of_order", "a stamp older than the one before", True
    FAR_AHEAD = "far_ahead", "a stamp far ahead of the one before", True
    GAP = "gap", "a gap before the sample"
    GAPS = "gaps", "a gap before the pair"
    IN_GAP = "in_gap", "a gap in the samples"
    LATE = "late", "a stamp too far behind those of the other foot"
    OUTSIDE = "outside", "a time at which only one foot was on"

    # stamps by the clock of a device
    SETTLING = "settling", "a clock that is not known yet"
    EARLY = "early", "an arrival that contradicts all others"
    BAD_SKEW = "bad_skew", "a clock that runs too fast or too slow"
    NOT_STAMPED = "not_stamped", "a stamp that contradicts the arrivals or fits no message"

    # bytes of a device
    GARBAGE_BYTES = "garbage_bytes", "bytes that belong to no frame"
    BAD_CHECKSUM = "bad_checksum", "a wrong checksum"
    MALFORMED = "malformed", "content that does not fit the format"
    INCOMPLETE = "incomplete", "no specific force or no angular rate"
    OTHER = "other", "a kind of frame that is not used"
    LOST = "lost", "lost on the way"
    REPEATED = "repeated", "a packet counter that did not advance"
    FOREIGN = "foreign", "a sender that is not among the peers"

    # air pressure and magnetic field
    PRESSURE_UNUSED = "pressure_unused", "the barometer aid is off"
    PRESSURE_OUT_OF_RANGE = "pressure_out_of_range", "no air pressure in Pa", True
    PRESSURE_OUT_OF_ORDER = (
        "pressure_out_of_order",
        "a stamp that is not later than the one before",
        True,
    )
    STANCES_WITHOUT_PRESSURE = "stances_without_pressure", "too few samples of air pressure"
    FIELD_UNUSED = "field_unused", "the magnetic heading is off"
    FIELD_OUT_OF_RANGE = "field_out_of_range", "not finite, or no field of the earth in T", True
    FIELD_OUT_OF_ORDER = (
        "field_out_of_order",
        "a stamp that is not later than the one before",
        True,
    )
    STANCES_WITHOUT_FIELD = "stances_without_field", "no sample of the magnetic field"
    STANCES_IN_DISTURBED_FIELD = "stances_in_disturbed_field", "a disturbed magnetic field"
    STANCES_BEFORE_FIELD_REFERENCE = (
        "stances_before_field_reference",
        "a reference of the magnetic field that is not known yet",
    )


BY_COUNTER = {str(refusal): (refusal, "") for refusal in Refusal} | {
    f"{foot}_{refusal}": (refusal, foot) for foot in FEET for refusal in Refusal
}
"""Each reason by the names of its counters: as it is, and as ``left_not_finite`` of a foot."""


def refusal_of(counter: str) -> tuple[Refusal, str] | None:
    """Return the reason that a counter counts, and the foot ("" for both).

    None for a counter of anything else, as ``pairs``.
    """
    return BY_COUNTER.get(counter)
