"""The contents of a bag as lines of text, for ``dualfoot info``."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from ..core import FEET, STANDARD_GRAVITY
from ..inspection import (
    FieldFacts,
    Finding,
    PressureFacts,
    Quality,
    StanceStatistics,
    pressure_facts,
    recorded_fields,
    wearer_words,
)
from ..recording import Recording, TopicInfo

DEG = 180.0 / math.pi


class Contents(NamedTuple):
    """A recording, the topics of its bag, and the results of its inspection.

    ``stances`` are those of each foot; empty when they were not looked for.
    """

    recording: Recording
    topics: Mapping[str, TopicInfo]
    qualities: Mapping[str, Quality]
    findings: list[Finding]
    stances: dict[str, StanceStatistics]

    @property
    def usable(self) -> bool:
        """Whether no finding keeps the recording from being evaluated."""
        return not any(finding.is_error for finding in self.findings)


def contents_lines(bag: str, contents: Contents) -> Iterator[str]:
    """Yield the lines that describe the contents of ``bag``."""
    recording = contents.recording
    yield f"{bag}: {_origin(recording)}"
    for name, topic in contents.topics.items():
        yield f"  {name}  {topic.msgtype}, {topic.messages} messages"
    yield from _feet(contents)
    for worn, series in recording.pressure.items():
        yield f"pressure on {_barometer(worn, pressure_facts(series))}"
    for foot, field in recorded_fields(recording).items():
        yield f"magnetic field of the {foot} foot: {_magnetometer(field)}"
    yield f"truth: {_truth(recording)}"
    reference = recording.reference
    yield f"reference: {reference.summary() if reference else 'none'}"
    for finding in contents.findings:
        if not finding.is_error:
            yield f"warning: {finding.sentence}"
    yield "the bag can be evaluated" if contents.usable else "the bag cannot be evaluated"


def _origin(recording: Recording) -> str:
    source = recording.notes.get("source")
    return f"imported from {source}" if source else "a recording of two feet"


def _feet(contents: Contents) -> Iterator[str]:
    qualities = contents.qualities
    for foot, quality in qualities.items():
        yield f"{foot} foot"
        kind = _kind(contents.recording, foot)
        for line in (*_stream(quality), kind, *_standstill(quality)):
            yield f"  {line}"
        if foot in contents.stances:
            yield f"  {_stances(contents.stances[foot])}"
    if len(qualities) == len(FEET):
        yield f"both feet: {_compare_feet(qualities['left'], qualities['right'])}"


def _stream(q: Quality) -> Iterator[str]:
    yield (
        f"{q.samples} samples from {q.start_s:.3f} to {q.end_s:.3f} s ({q.duration_s:.1f} s), "
        f"{q.rate_hz:.2f} Hz, jitter {q.jitter_s * 1e3:.3f} ms"
    )
    yield (
        f"{q.gaps} gaps, {q.duplicate} duplicate and {q.out_of_order} out-of-order stamps, "
        f"{q.not_finite} samples not finite"
    )
    yield (
        f"greatest values {q.peak_force:.1f} m/s^2 and {q.peak_rate:.2f} rad/s; clipped: "
        f"{q.clipped_force} and {q.clipped_rate} samples"
    )


def _kind(recording: Recording, foot: str) -> str:
    imu = recording.imu(foot)
    if imu is not None and imu.increments is not None:
        return f"samples are {imu.increments.words} ({imu.increments}), as the recording says"
    return (
        "nothing says what the samples are: taken for averaged, means over their interval "
        f"(--set increments.{foot}=compensated or sampled otherwise)"
    )


def _standstill(q: Quality) -> Iterator[str]:
    stand = q.stand
    if stand is None:
        yield "no standstill"
        return
    bias = ", ".join(f"{v * DEG:+.3f}" for v in stand.angular_rate)
    yield (
        f"stands still from {stand.start_s:.1f} to {stand.end_s:.1f} s after the start "
        f"({stand.windows} windows)"
    )
    yield (
        f"gyro bias ({bias}) deg/s, scatter {stand.angular_rate_scatter * DEG:.3f} deg/s; "
        f"gravity norm {stand.gravity:.3f} m/s^2, so the accelerometer is off by "
        f"{stand.gravity - STANDARD_GRAVITY:+.3f} m/s^2 along the vertical"
    )


def _stances(stances: StanceStatistics) -> str:
    return (
        f"{stances.count} stances (median {stances.median_s:.2f} s, {stances.share:.0%} of the "
        f"walk), about {stances.distance_m:.1f} m walked"
    )


def _compare_feet(left: Quality, right: Quality) -> str:
    overlap = min(left.end_s, right.end_s) - max(left.start_s, right.start_s)
    start = (right.start_s - left.start_s) * 1e3
    both = f"share {overlap:.1f} s" if overlap > 0 else "share no time"
    return (
        f"{both}; the right foot starts {abs(start):.3f} ms {'after' if start >= 0 else 'before'} "
        f"the left; rates differ by {(right.rate_hz / left.rate_hz - 1) * 1e6:+.0f} ppm"
    )


def _barometer(worn: str, facts: PressureFacts) -> str:
    return (
        f"{wearer_words(worn)}: {facts.samples} samples from {facts.start_s:.3f} to "
        f"{facts.end_s:.3f} s, {facts.rate_hz:.2f} Hz, median {facts.median:.1f} Pa; height from "
        f"{facts.lowest_m:+.1f} to {facts.highest_m:+.1f} m relative to the start, noise "
        f"{facts.noise_m:.2f} m a sample (evaluate uses it with --set aids.barometer=true)"
    )


def _magnetometer(facts: FieldFacts) -> str:
    if not facts.samples:
        return f"none of {facts.all_samples} samples has one"
    low, median, high = (1e6 * size for size in (facts.low_t, facts.median_t, facts.high_t))
    return (
        f"{facts.samples} of {facts.all_samples} samples have one, median {median:.1f} uT, 90 % "
        f"from {low:.1f} to {high:.1f} uT (evaluate uses it with --set aids.magnetic_heading=true)"
    )


def _truth(recording: Recording) -> str:
    counts = [
        f"{len(truth)} poses of the {foot} foot"
        for foot in FEET
        if (truth := recording.truth(foot)) is not None
    ]
    return ", ".join(counts) or "none"
