"""All findings on a recording, and the refusal of one that cannot be used."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..core import FEET, ImuSeries, RecordingError
from ..recording import Recording
from .field_facts import FieldFacts, field_facts, field_findings
from .finding import Finding, FindingKind, Severity
from .pressure_facts import pressure_findings
from .quality import Quality, quality_of
from .sample_findings import foot_findings, pair_findings, stream_findings, unit_findings


def require_usable(
    recording: Recording, *, allow_not_finite: bool = False
) -> tuple[ImuSeries, ImuSeries]:
    """Return the samples of both feet; raise as :func:`check_usable`."""
    check_usable(recording, allow_not_finite=allow_not_finite)
    assert recording.left is not None and recording.right is not None
    return recording.left, recording.right


def check_usable(recording: Recording, *, allow_not_finite: bool = False) -> tuple[Finding, ...]:
    """Return the warnings about a recording that can be used.

    With ``allow_not_finite`` samples with nan or inf are left to be refused and counted.  Whether
    there is a standstill is left to the tracker, whose parameters decide.

    Raises
    ------
    RecordingError
        With the sentence of the first other error that :func:`findings_of` has.
    """
    decided_later = {FindingKind.NO_STANDSTILL}
    if allow_not_finite:
        decided_later.add(FindingKind.NOT_FINITE)
    findings = list(findings_of(recording))
    for finding in findings:
        if finding.is_error and finding.kind not in decided_later:
            raise RecordingError(finding.sentence)
    return tuple(finding for finding in findings if not finding.is_error)


def findings_of(
    recording: Recording, qualities: Mapping[str, Quality] | None = None
) -> Iterator[Finding]:
    """Yield every finding, the gravest first; ``qualities`` spares computing them again."""
    yield from _missing_feet(recording)
    if qualities is None:
        qualities = qualities_of(recording)
    for foot, quality in qualities.items():
        yield from foot_findings(foot, quality)
    usable = {foot: quality for foot, quality in qualities.items() if quality.usable > 1}
    for foot, quality in usable.items():
        yield from unit_findings(foot, quality)
    if len(usable) == len(FEET):
        yield from pair_findings(usable["left"], usable["right"])
    for foot, quality in usable.items():
        yield from stream_findings(foot, quality)
    yield from pressure_findings(recording.pressure, usable)
    yield from field_findings(recorded_fields(recording))


def recorded_fields(recording: Recording) -> dict[str, FieldFacts]:
    """Return the facts of the magnetic field of each foot that has one recorded."""
    series = {foot: recording.imu(foot) for foot in FEET}
    facts = {foot: field_facts(s) for foot, s in series.items() if s is not None}
    return {foot: known for foot, known in facts.items() if known is not None}


def qualities_of(recording: Recording) -> dict[str, Quality]:
    """Return the facts of each foot that is there and has samples."""
    series = {foot: recording.imu(foot) for foot in FEET}
    return {foot: quality_of(s) for foot, s in series.items() if s is not None and len(s)}


def _missing_feet(recording: Recording) -> Iterator[Finding]:
    absent = [foot for foot in FEET if not recording.imu(foot)]
    if not absent:
        return
    topics = ", ".join(f"'{recording.topics.of(foot).imu}'" for foot in absent)
    present = [foot for foot in FEET if foot not in absent]
    which = f"the {absent[0]} foot" if present else "either foot"
    only = f", only the {present[0]} foot has some" if present else ""
    yield Finding(
        FindingKind.MISSING,
        Severity.ERROR,
        f"there are no samples of {which} ({topics}){only}",
        _topic_advice(recording),
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
