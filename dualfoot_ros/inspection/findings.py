"""Whether a recording can be used, each objection a sentence: what is wrong and what to do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ..core import FEET, ImuSeries, RecordingError
from ..recording import Recording
from .field_facts import FieldFacts, field_findings
from .field_facts import facts_of as field_facts_of
from .pressure_facts import pressure_findings
from .quality import Quality, quality_of

GRAVITY = 9.80665
GRAVITY_ERROR = 1.5  # m/s^2, more than any accelerometer bias
FASTEST_FOOT = 35.0  # rad/s (2000 deg/s); no foot turns faster for long
RATE_RATIO = 1.5
MILLI = 1e-3
STUCK_SHARE = 0.1  # more than this and nothing can be made of it


@dataclass(frozen=True)
class Finding:
    """An objection. ``severity`` is "error" (the recording cannot be used) or "warning"."""

    severity: str
    name: str
    sentence: str


def require_usable(
    recording: Recording, *, allow_not_finite: bool = False
) -> tuple[ImuSeries, ImuSeries]:
    """Return the samples of both feet.

    With ``allow_not_finite`` samples with nan or inf are left to be refused and counted.  Whether
    there is a standstill is left to the tracker, whose parameters decide.

    Raises
    ------
    RecordingError
        With the sentence of the first other error that :func:`findings_of` has.
    """
    for finding in findings_of(recording):
        left_to_others = finding.name == "no_standstill" or (
            finding.name == "not_finite" and allow_not_finite
        )
        if finding.severity == "error" and not left_to_others:
            raise RecordingError(finding.sentence)
    assert recording.left is not None and recording.right is not None
    return recording.left, recording.right


def findings_of(
    recording: Recording, qualities: Mapping[str, Quality] | None = None
) -> Iterator[Finding]:
    """Yield every objection, the gravest first; ``qualities`` spares computing them again."""
    missing = list(_missing(recording))
    yield from missing
    if qualities is None:
        qualities = qualities_of(recording)
    for foot, quality in qualities.items():
        yield from _samples(foot, quality)
    usable = {foot: q for foot, q in qualities.items() if q.usable > 1}
    for foot, quality in usable.items():
        yield from _units(foot, quality)
    if len(usable) == len(FEET):
        yield from _together(usable["left"], usable["right"])
    for foot, quality in usable.items():
        yield from _stuck(foot, quality)
        yield from _standing(foot, quality)
        yield from _stream(foot, quality)
    for name, sentence in pressure_findings(recording.pressure, usable):
        yield Finding("warning", name, sentence)
    for name, sentence in field_findings(fields_of(recording)):
        yield Finding("warning", name, sentence)


def fields_of(recording: Recording) -> dict[str, FieldFacts]:
    """Return the facts of the magnetic field of each foot that has one recorded."""
    series = {foot: recording.imu(foot) for foot in FEET}
    found = {foot: field_facts_of(s) for foot, s in series.items() if s is not None}
    return {foot: facts for foot, facts in found.items() if facts is not None}


def qualities_of(recording: Recording) -> dict[str, Quality]:
    """Return the facts of each foot that is there and has samples."""
    series = {foot: recording.imu(foot) for foot in FEET}
    return {foot: quality_of(s) for foot, s in series.items() if s is not None and len(s)}


def _missing(recording: Recording) -> Iterator[Finding]:
    absent = [f for f in FEET if not recording.imu(f)]
    if not absent:
        return
    topics = ", ".join(f"'{recording.topics.of(f).imu}'" for f in absent)
    known = {recording.topics.of(f).imu for f in FEET}
    others = [t for t in recording.imu_topics if t not in known]
    hint = (
        f"give the right topics with --left-topic and --right-topic; the bag also has "
        f"{', '.join(others)}"
        if others
        else "record the sensor_msgs/Imu topics of both feet"
    )
    there = [f for f in FEET if f not in absent]
    which = f"the {absent[0]} foot" if there else "either foot"
    only = f", only the {there[0]} foot has some" if there else ""
    yield Finding("error", "missing", f"there are no samples of {which} ({topics}){only}; {hint}")


def _samples(foot: str, q: Quality) -> Iterator[Finding]:
    if q.not_finite:
        yield Finding(
            "error",
            "not_finite",
            f"{foot} foot: {q.not_finite} of {q.samples} samples are not finite (nan or inf), "
            f"the first is sample {q.first_not_finite}; repair the driver or the export, or leave "
            "them out with 'dualfoot evaluate --allow-nan'",
        )
    if q.usable < 2:
        yield Finding(
            "error",
            "empty",
            f"{foot} foot: {q.usable} of {q.samples} samples can be used "
            f"({q.not_finite} not finite, {q.duplicate} duplicate and {q.out_of_order} "
            "out-of-order stamps); check the driver's stamps and values",
        )
    elif q.begins_anew:
        yield Finding(
            "error",
            "begins_anew",
            f"{foot} foot: the stamps jump back and go on from there; these are two recordings in "
            "one bag, cut it there",
        )


def _units(foot: str, q: Quality) -> Iterator[Finding]:
    gravity = q.median_force if q.stand is None else q.stand.gravity
    where = "in the median" if q.stand is None else "at rest"
    told = f"{foot} foot: the specific force is {gravity:.4g} {where}"
    if abs(gravity - GRAVITY) > (GRAVITY_ERROR if q.stand else 2 * GRAVITY_ERROR):
        yield Finding("error", "force_unit", f"{told}{_force_advice(gravity)}")
    if q.high_rate > FASTEST_FOOT:
        yield Finding(
            "error",
            "rate_unit",
            f"{foot} foot: the angular rate exceeds {q.high_rate:.4g} for 2 % of the time, so it "
            "is in deg/s and not in rad/s; convert the bag with 'dualfoot import BAG --rate-unit "
            "deg/s -o NEW', and live set the unit in the driver or units.angular_rate of "
            "imu_adapter",
        )


def _force_advice(gravity: float) -> str:
    for unit, size in (("g", 1.0), ("mg", 1.0 / MILLI)):
        if abs(gravity / size - 1.0) < 0.2:
            return (
                f", so it is in {unit} and not in m/s^2; convert the bag with 'dualfoot import "
                f"BAG --force-unit {unit} -o NEW', and live set the unit in the driver or "
                "units.specific_force of imu_adapter"
            )
    if gravity < 3.0:
        return (
            ", so gravity was taken out; publish what the accelerometer reads (specific force, "
            "9.8 m/s^2 upwards at rest), not the linear acceleration"
        )
    return f"; {GRAVITY:.1f} m/s^2 is due, so check the unit and the scale of the accelerometer"


def _together(left: Quality, right: Quality) -> Iterator[Finding]:
    overlap = min(left.end_s, right.end_s) - max(left.start_s, right.start_s)
    if overlap <= 0.0:
        yield Finding(
            "error",
            "no_overlap",
            f"left and right do not overlap in time (left {left.start_s:.3f} to {left.end_s:.3f} "
            f"s, right {right.start_s:.3f} to {right.end_s:.3f} s), so the clocks of the devices "
            "were not synchronised: 'dualfoot sync BAG -o ALIGNED' finds the offset from how the "
            "feet moved, and 'dualfoot import SOURCE --right-offset SECONDS' takes a known one",
        )
    ratio = left.rate_hz / right.rate_hz
    if np.isfinite(ratio) and not 1 / RATE_RATIO < ratio < RATE_RATIO:
        yield Finding(
            "warning",
            "rates",
            f"the feet have different rates ({left.rate_hz:.1f} and {right.rate_hz:.1f} Hz); set "
            "both sensors to the same rate",
        )


def _stuck(foot: str, q: Quality) -> Iterator[Finding]:
    for stuck in q.stuck:
        what = "the sensor repeats itself" if stuck.what == "sensor" else f"{stuck.what} is stuck"
        yield Finding(
            "error" if stuck.share > STUCK_SHARE else "warning",
            "stuck",
            f"{foot} foot: {what} {_times(stuck.times)}, first {stuck.first_s:.1f} s after the "
            f"start and for up to {stuck.longest_s:.2f} s ({stuck.share:.1%} of the samples have "
            "not changed); check the sensor and its driver, which may fill gaps with old values",
        )


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _standing(foot: str, q: Quality) -> Iterator[Finding]:
    if q.stand is None:
        yield Finding(
            "error",
            "no_standstill",
            f"{foot} foot: there is no standstill of some seconds, without which neither the gyro "
            "bias nor up and down are known; stand still with both feet on the ground for 5 s "
            "before walking",
        )
    elif q.stand.start_s > 5.0:
        yield Finding(
            "warning",
            "late_standstill",
            f"{foot} foot: the first standstill begins {q.stand.start_s:.1f} s after the start; "
            "what is before it is not tracked",
        )


def _stream(foot: str, q: Quality) -> Iterator[Finding]:
    if q.gaps:
        yield Finding(
            "warning",
            "gaps",
            f"{foot} foot: {q.gaps} gaps, the longest {q.longest_gap_s:.3f} s; nothing is "
            "invented there, and the track suffers if one falls into a step",
        )
    if q.duplicate or q.out_of_order:
        yield Finding(
            "warning",
            "stamps",
            f"{foot} foot: {q.duplicate} duplicate and {q.out_of_order} out-of-order stamps are "
            "left out",
        )
    if q.clipped_force or q.clipped_rate:
        yield Finding(
            "warning",
            "clipping",
            f"{foot} foot: the sensor clips ({q.clipped_force} samples at {q.peak_force:.4g} "
            f"m/s^2, {q.clipped_rate} at {q.peak_rate:.4g} rad/s); choose a wider range",
        )
