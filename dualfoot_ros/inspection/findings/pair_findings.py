"""Findings on both feet together: whether one is missing, and how their clocks and rates agree."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...core import FEET, ImuSeries, row_blocks
from ...recording import ClockStep, Recording, Topics
from ..quality import Quality
from .finding import Finding, Severity
from .finding_kinds import FindingKind

RATE_RATIO = 1.5
ALONE_S = 3.0  # at the start or the end of a recording
SAME_SHARE = 0.5  # of the samples of a foot that the other one has too, to the last digit
MIXER = np.uint64(0x9E3779B97F4A7C15)  # odd: multiplication by it loses no bit
LEAST_SAME = 20
LET_CLOCKS_GO = (
    "let no clock be set during a recording, or stamp by a clock that is not set; if these are "
    "two recordings, cut the bag there"
)


def find_missing(recording: Recording) -> Iterator[Finding]:
    """Yield a finding when a foot has no samples; the other one can be tracked alone."""
    absent = [foot for foot in FEET if not recording.imu(foot)]
    if not absent:
        return
    topics = ", ".join(f"'{recording.topics.of(foot).samples}'" for foot in absent)
    present = [foot for foot in FEET if foot not in absent]
    which = f"the {absent[0]} foot" if present else "either foot"
    usual = all(recording.topics.of(foot).imu == Topics().of(foot).imu for foot in absent)
    goes_on = bool(present) and usual  # a topic that was asked for by name must be there
    only = f", so the {present[0]} foot is tracked alone" if goes_on else ""
    yield Finding(
        FindingKind.MISSING,
        Severity.WARNING if goes_on else Severity.ERROR,
        f"there are no samples of {which} ({topics}){only}",
        _topic_advice(recording),
        absent[0] if present else "",
    )


def find_cut(recording: Recording) -> Iterator[Finding]:
    """Yield a finding when a part of the bag could not be read."""
    if recording.cut:
        yield Finding(
            FindingKind.CUT_OFF,
            Severity.WARNING,
            f"the recording is not whole: {recording.cut}",
            "copy it again from where it was recorded, if it is whole there",
        )


def find_clock_steps(recording: Recording) -> Iterator[Finding]:
    """Yield a finding for each step of a clock that was taken off the stamps."""
    for step in recording.clock_steps:
        which = "both feet" if len(step.feet) == len(FEET) else f"the {step.feet[0]} foot"
        yield Finding(
            FindingKind.CLOCK_SET,
            Severity.WARNING,
            f"the clock of {which} was set {'back' if step.by_ns > 0 else 'ahead'} by "
            f"{abs(step.by_ns) * 1e-9:.3f} s, "
            f"{step.since_start_ns * 1e-9:.1f} s after the first sample (at "
            f"{step.at_ns * 1e-9:.3f} s), and the samples go on, so the stamps after it are moved "
            f"to follow those before{_truth_words(step)}",
            LET_CLOCKS_GO,
            "both" if len(step.feet) == len(FEET) else step.feet[0],
        )


def _truth_words(step: ClockStep) -> str:
    if not step.truth_cut:
        return ""
    return "; the truth steps otherwise, and there are no errors after its step"


def _topic_advice(recording: Recording) -> str:
    wanted = {recording.topics.of(foot).imu for foot in FEET}
    others = [topic for topic in recording.imu_topics if topic not in wanted]
    if not others:
        return "record the sensor_msgs/Imu topics of both feet"
    return (
        "give the right topics with --left-topic and --right-topic; the bag also has "
        f"{', '.join(others)}"
    )


def find_same_samples(recording: Recording) -> Iterator[Finding]:
    """Yield a finding when both feet have the samples of one sensor."""
    left, right = recording.left, recording.right
    if left is None or right is None or min(len(left), len(right)) < LEAST_SAME:
        return
    marks = np.sort(np.concatenate([_distinct(left), _distinct(right)]))
    same = int((marks[1:] == marks[:-1]).sum())
    if same > max(LEAST_SAME, SAME_SHARE * min(len(left), len(right))):
        yield Finding(
            FindingKind.SAME_SAMPLES,
            Severity.ERROR,
            f"both feet hold the same samples: {same} of {min(len(left), len(right))} are equal "
            "to the last digit, so one sensor is given for both",
            "give each foot its own topic or file (--left-topic and --right-topic, --left and "
            "--right; live, the remappings of left/imu/data_raw and right/imu/data_raw)",
        )


def _distinct(series: ImuSeries) -> NDArray[np.uint64]:
    """Return a number for each of the different values of the samples, whatever their stamps.

    Others share one once in 10^19 pairs of samples.
    """
    marks = np.concatenate([_marks(series, part) for part in row_blocks(len(series))])
    marks.sort()
    distinct: NDArray[np.uint64] = marks[np.diff(marks, prepend=~marks[:1]) != 0]
    return distinct


def _marks(series: ImuSeries, part: slice) -> NDArray[np.uint64]:
    """Return a number for each of the samples of a part that are finite."""
    values = np.hstack([series.specific_force[part], series.angular_rate[part]])
    finite = np.isfinite(values)
    if not finite.all():
        values = values[finite.all(axis=1)]
    bits = values.view(np.uint64)
    marks = np.zeros(len(bits), dtype=np.uint64)
    for column in bits.T:
        marks = (marks ^ column) * MIXER
        marks ^= marks >> np.uint64(29)
    return marks


def find_no_overlap(left: Quality, right: Quality) -> Iterator[Finding]:
    """Yield a finding when the feet share no time."""
    if min(left.end_s, right.end_s) <= max(left.start_s, right.start_s):
        yield Finding(
            FindingKind.NO_OVERLAP,
            Severity.ERROR,
            f"left and right do not overlap in time (left {left.start_s:.3f} to {left.end_s:.3f} "
            f"s, right {right.start_s:.3f} to {right.end_s:.3f} s), so the clocks of the devices "
            "were not synchronised",
            "'dualfoot sync BAG -o ALIGNED' finds the offset from how the feet moved, and "
            "'dualfoot import SOURCE --right-offset SECONDS' takes a known one",
        )


def find_one_foot(left: Quality, right: Quality) -> Iterator[Finding]:
    """Yield a finding when a foot begins much later, or ends much earlier, than the other."""
    for foot, own, other in (("left", left, right), ("right", right, left)):
        if own.start_s >= other.end_s or own.end_s <= other.start_s:
            return  # they do not overlap, which is another finding
        for verb, apart_s in (
            ("begins {:.1f} s after", own.start_s - other.start_s),
            ("ends {:.1f} s before", other.end_s - own.end_s),
        ):
            if apart_s > ALONE_S:
                yield Finding(
                    FindingKind.ONE_FOOT,
                    Severity.WARNING,
                    f"the {foot} foot {verb.format(apart_s)} the other one, which is tracked "
                    "alone there",
                    "check the sensor and its link",
                    f"{foot} {verb.split()[0]}",
                )


def find_different_rates(left: Quality, right: Quality) -> Iterator[Finding]:
    """Yield a finding when one foot is sampled much faster than the other."""
    ratio = left.rate_hz / right.rate_hz
    if np.isfinite(ratio) and not 1 / RATE_RATIO < ratio < RATE_RATIO:
        yield Finding(
            FindingKind.RATES,
            Severity.WARNING,
            f"the feet have different rates ({left.rate_hz:.1f} and {right.rate_hz:.1f} Hz)",
            "set both sensors to the same rate",
        )
