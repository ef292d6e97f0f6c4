"""``dualfoot info``: what is in a bag, in words."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ..core import AlignmentError
from .arguments import add_topic_arguments, load_bag

if TYPE_CHECKING:
    from ..inspection import FieldFacts, Finding, PressureFacts, Quality, Stances
    from ..recording import Recording

HELP = "tell in words what is in a bag: rates, gaps, standstill, units, stances"
EXAMPLES = """\
examples:
  dualfoot info walk
  dualfoot info walk --json | python3 -m json.tool
  dualfoot info drive.mcap --left-topic /imu_l/data --right-topic /imu_r/data

The exit code is 0 when the bag can be evaluated and 2 when it cannot; the reasons are printed
on standard error.
"""
DEG = 180.0 / math.pi


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("bag", metavar="BAG", help="rosbag2 folder (or its one file)")
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else")
    parser.add_argument("--no-stances", action="store_true", help="do not look for stances")
    add_topic_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Read, judge and tell; 2 when the bag cannot be evaluated."""
    from ..inspection import findings_of, qualities_of
    from ..recording import list_topics

    recording = load_bag(args.bag, args)
    qualities = qualities_of(recording)
    found = list(findings_of(recording, qualities))
    broken = any(f.severity == "error" for f in found)
    stances, of_walk = ({}, []) if broken or args.no_stances else _walked_on(recording)
    found += of_walk
    topics = list_topics(args.bag)
    if args.json:
        facts = _facts(recording, qualities, stances, found)
        facts["topics"] = {name: topic._asdict() for name, topic in topics.items()}
        print(json.dumps(_plain({"bag": args.bag, **facts}), allow_nan=False))
    else:
        print(f"{args.bag}: {_source(recording)}")
        for name, topic in topics.items():
            print(f"  {name}  {topic.msgtype}, {topic.messages} messages")
        for line in _words(recording, qualities, stances, found):
            print(line)
    for finding in found:
        if finding.severity == "error":
            print(f"dualfoot info: error: {finding.sentence}", file=sys.stderr)
    return 2 if broken else 0


def _walked_on(recording: Recording) -> tuple[dict[str, Stances], list[Finding]]:
    """Track the feet; return their stances and what the tracks show to be wrong."""
    from rich.console import Console

    from ..inspection import free_tracks, require_usable, stances_of, walk_findings

    with Console(stderr=True).status("looking for stances"):
        try:
            tracks = free_tracks(*require_usable(recording))
        except AlignmentError:
            return {}, []
        return stances_of(tracks), list(walk_findings(tracks))


def _source(recording: Recording) -> str:
    source = recording.notes.get("source")
    return f"imported from {source}" if source else "a recording of two feet"


def _words(
    recording: Recording,
    qualities: dict[str, Quality],
    stances: dict[str, Stances],
    found: list[Finding],
) -> Iterator[str]:
    for foot, quality in qualities.items():
        yield f"{foot} foot"
        for line in (*_stream(quality), *_standstill(quality)):
            yield f"  {line}"
        if foot in stances:
            yield f"  {_walked(stances[foot])}"
    if len(qualities) == 2:
        yield f"both feet: {_together(qualities['left'], qualities['right'])}"
    for worn, facts in _pressure(recording).items():
        yield f"pressure on {_barometer(worn, facts)}"
    for foot, field in _fields(recording).items():
        yield f"magnetic field of the {foot} foot: {_magnetometer(field)}"
    yield f"truth: {_truth(recording)}"
    reference = recording.reference
    yield f"reference: {reference.summary() if reference else 'none'}"
    for finding in found:
        if finding.severity == "warning":
            yield f"warning: {finding.sentence}"
    broken = any(f.severity == "error" for f in found)
    yield "the bag cannot be evaluated" if broken else "the bag can be evaluated"


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
        f"{stand.gravity - 9.80665:+.3f} m/s^2 along the vertical"
    )


def _walked(s: Stances) -> str:
    return (
        f"{s.count} stances (median {s.median_s:.2f} s, {s.share:.0%} of the walk), about "
        f"{s.distance_m:.1f} m walked"
    )


def _together(left: Quality, right: Quality) -> str:
    overlap = min(left.end_s, right.end_s) - max(left.start_s, right.start_s)
    start = (right.start_s - left.start_s) * 1e3
    both = f"share {overlap:.1f} s" if overlap > 0 else "share no time"
    return (
        f"{both}; the right foot starts {abs(start):.3f} ms {'after' if start >= 0 else 'before'} "
        f"the left; rates differ by {(right.rate_hz / left.rate_hz - 1) * 1e6:+.0f} ppm"
    )


def _pressure(recording: Recording) -> dict[str, PressureFacts]:
    from ..inspection import facts_of

    return {worn: facts_of(series) for worn, series in recording.pressure.items()}


def _barometer(worn: str, facts: PressureFacts) -> str:
    from ..inspection import wearer

    return (
        f"{wearer(worn)}: {facts.samples} samples from {facts.start_s:.3f} to "
        f"{facts.end_s:.3f} s, {facts.rate_hz:.2f} Hz, median {facts.median:.1f} Pa; height from "
        f"{facts.lowest_m:+.1f} to {facts.highest_m:+.1f} m against the start, noise "
        f"{facts.noise_m:.2f} m a sample (evaluate uses it with --set aids.barometer=true)"
    )


def _fields(recording: Recording) -> dict[str, FieldFacts]:
    from ..inspection import fields_of

    return fields_of(recording)


def _magnetometer(facts: FieldFacts) -> str:
    if not facts.samples:
        return f"none of {facts.all_samples} samples has it"
    low, median, high = (1e6 * size for size in (facts.low_t, facts.median_t, facts.high_t))
    return (
        f"{facts.samples} of {facts.all_samples} samples have it, median {median:.1f} uT, 90 % "
        f"from {low:.1f} to {high:.1f} uT (evaluate uses it with --set aids.magnetic_heading=true)"
    )


def _truth(recording: Recording) -> str:
    counts = [
        f"{len(truth)} poses of the {foot} foot"
        for foot in ("left", "right")
        if (truth := recording.truth(foot)) is not None
    ]
    return ", ".join(counts) or "none"


def _facts(
    recording: Recording,
    qualities: dict[str, Quality],
    stances: dict[str, Stances],
    found: list[Finding],
) -> dict[str, Any]:
    feet: dict[str, Any] = {foot: asdict(q) for foot, q in qualities.items()}
    for foot, s in stances.items():
        feet[foot]["stances"] = asdict(s)
    reference = recording.reference
    return {
        "notes": dict(recording.notes),
        "feet": feet,
        "pressure": {worn: asdict(facts) for worn, facts in _pressure(recording).items()},
        "magnetic_field": {foot: asdict(facts) for foot, facts in _fields(recording).items()},
        "truth": {f: len(t) for f in ("left", "right") if (t := recording.truth(f)) is not None},
        "reference": None if reference is None else reference.summary(),
        "findings": [asdict(f) for f in found],
        "usable": not any(f.severity == "error" for f in found),
    }


def _plain(value: Any) -> Any:
    """Return ``value`` as JSON can hold it: arrays as lists, what is not finite as null."""
    if isinstance(value, dict):
        return {key: _plain(v) for key, v in value.items()}
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
