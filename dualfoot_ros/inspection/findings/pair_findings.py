"""Findings on both feet together: whether one is missing, and how their clocks and rates agree."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...core import FEET
from ...recording import Recording
from ..quality import Quality
from .finding import Finding, Severity
from .finding_kinds import FindingKind

RATE_RATIO = 1.5


def find_missing(recording: Recording) -> Iterator[Finding]:
    """Yield a finding when a foot has no samples."""
    absent = [foot for foot in FEET if not recording.imu(foot)]
    if not absent:
        return
    topics = ", ".join(f"'{recording.topics.of(foot).samples}'" for foot in absent)
    present = [foot for foot in FEET if foot not in absent]
    which = f"the {absent[0]} foot" if present else "either foot"
    only = f", only the {present[0]} foot has some" if present else ""
    yield Finding(
        FindingKind.MISSING,
        Severity.ERROR,
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


def _topic_advice(recording: Recording) -> str:
    wanted = {recording.topics.of(foot).imu for foot in FEET}
    others = [topic for topic in recording.imu_topics if topic not in wanted]
    if not others:
        return "record the sensor_msgs/Imu topics of both feet"
    return (
        "give the right topics with --left-topic and --right-topic; the bag also has "
        f"{', '.join(others)}"
    )


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
