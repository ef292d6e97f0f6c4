"""``dualfoot info``: the contents of a bag in words."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ..core import DualFootError
from .arguments import (
    add_json_argument,
    add_recording_argument,
    add_topic_arguments,
    is_bag,
    load_bag,
    recording_name,
)
from .printing import print_error, print_json, status

if TYPE_CHECKING:
    from .info_lines import Contents

HELP = "describe a bag in words: rates, gaps, standstill, units, stances"
EXAMPLES = """\
examples:
  dualfoot info walk
  dualfoot info walk --json | python3 -m json.tool
  dualfoot info drive.mcap --left-topic /imu_l/data --right-topic /imu_r/data

The exit code is 0 when the bag can be evaluated and 2 when it cannot; the reasons are printed
on standard error.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_recording_argument(parser)
    add_json_argument(parser)
    parser.add_argument("--no-stances", action="store_true", help="do not look for stances")
    add_topic_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Read, inspect and describe; return 2 when the bag cannot be evaluated."""
    from .info_lines import contents_lines

    contents = _inspect(args)
    if args.json:
        print_json({"bag": recording_name(args), **_facts(contents)})
    else:
        for line in contents_lines(recording_name(args), contents):
            print(line)
    for finding in contents.findings:
        if finding.is_error:
            print_error("info", finding.sentence)
    return 0 if contents.usable else 2


def _inspect(args: argparse.Namespace) -> Contents:
    from ..inspection import findings_of, mend_clocks, qualities_of
    from ..recording import keep_large_arrays_on_disk, list_topics
    from .info_lines import Contents

    keep_large_arrays_on_disk()
    recording = mend_clocks(load_bag(args.bag, args))
    qualities = qualities_of(recording)
    contents = Contents(
        recording,
        list_topics(args.bag) if is_bag(args) else {},
        qualities,
        list(findings_of(recording, qualities)),
        {},
    )
    if contents.usable and not args.no_stances:
        _inspect_walk(contents)
    return contents


def _inspect_walk(contents: Contents) -> None:
    """Track the walk as ``evaluate`` does by default; add its stances, and what it shows."""
    from ..evaluation import pair_samples, track_walk
    from ..inspection import (
        Finding,
        FindingKind,
        Severity,
        coupled_findings,
        stance_statistics,
        tracker_findings,
        unconstrained_config,
        walk_findings,
    )

    recording = contents.recording
    both = bool(recording.left) and bool(recording.right)  # else no foot is against another
    with status("looking for stances"):
        try:
            samples = pair_samples(recording)
            alone = track_walk(samples, unconstrained_config(), covariances=False)
            stances, findings = stance_statistics(alone), [*walk_findings(alone)] if both else []
            del alone  # before the next one: a walk of an hour takes some hundred megabytes
            coupled = track_walk(samples, covariances=False)
            findings += [*coupled_findings(coupled)] if both else []
            findings += tracker_findings(coupled)
        except DualFootError as error:
            finding = Finding(FindingKind.NOT_TRACKED, Severity.ERROR, str(error))
            contents.findings.append(finding)
            return
    contents.stances.update(stances)
    contents.findings.extend(findings)


def _facts(contents: Contents) -> dict[str, Any]:
    from ..core import FEET
    from ..inspection import pressure_facts, recorded_fields

    recording = contents.recording
    feet: dict[str, Any] = {foot: asdict(q) for foot, q in contents.qualities.items()}
    for foot, facts in feet.items():
        imu = recording.imu(foot)
        facts["increments"] = None if imu is None else imu.increments
    for foot, stances in contents.stances.items():
        if foot in feet:
            feet[foot]["stances"] = asdict(stances)
    truths = {foot: recording.truth(foot) for foot in FEET}
    reference = recording.reference
    return {
        "notes": dict(recording.notes),
        "feet": feet,
        "pressure": {w: pressure_facts(s)._asdict() for w, s in recording.pressure.items()},
        "magnetic_field": {foot: f._asdict() for foot, f in recorded_fields(recording).items()},
        "truth": {foot: len(truth) for foot, truth in truths.items() if truth is not None},
        "reference": None if reference is None else reference.summary(),
        "findings": [finding.to_dict() for finding in contents.findings],
        "usable": contents.usable,
        "topics": {name: topic._asdict() for name, topic in contents.topics.items()},
    }
