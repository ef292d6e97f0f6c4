"""All findings on a recording, and the refusal of one that cannot be used.

A new finding is one function in a module beside this one, and its place in a list below.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from ...core import FEET, ImuSeries, RecordingError
from ...recording import Recording
from ..field_facts import recorded_fields
from ..quality import Quality, quality_of
from .field_findings import field_findings
from .finding import Finding
from .finding_kinds import FindingKind
from .gyro_findings import (
    find_rate_axes,
    find_rate_degrees,
    find_rate_misfit,
    find_rate_scale,
)
from .pair_findings import (
    find_clock_steps,
    find_cut,
    find_different_rates,
    find_missing,
    find_no_overlap,
    find_one_foot,
    find_same_samples,
)
from .pressure_findings import pressure_findings
from .sample_findings import (
    LEAST_SAMPLES,
    find_not_finite,
    find_second_recording,
    find_too_few,
)
from .stream_findings import (
    find_bad_stamps,
    find_clipping,
    find_equal_stamps,
    find_gaps,
    find_jitter,
    find_late_standstill,
    find_low_rate,
    find_missing_samples,
    find_no_standstill,
    find_overlaid_samples,
    find_stuck_values,
)
from .unit_findings import find_force_unit, find_gravity, find_rate_unit

FootFindings = Callable[[str, Quality], Iterator[Finding]]
PairFindings = Callable[[Quality, Quality], Iterator[Finding]]

OF_SAMPLES: Sequence[FootFindings] = (find_not_finite, find_too_few, find_second_recording)
OF_UNITS: Sequence[FootFindings] = (
    find_force_unit,
    find_rate_unit,
    find_rate_degrees,
    find_gravity,
    find_rate_axes,
    find_rate_scale,
    find_rate_misfit,
)
OF_PAIR: Sequence[PairFindings] = (find_no_overlap, find_one_foot, find_different_rates)
OF_STREAM: Sequence[FootFindings] = (
    find_equal_stamps,
    find_stuck_values,
    find_no_standstill,
    find_late_standstill,
    find_gaps,
    find_missing_samples,
    find_bad_stamps,
    find_overlaid_samples,
    find_jitter,
    find_low_rate,
    find_clipping,
)


def require_usable(
    recording: Recording, *, allow_not_finite: bool = False
) -> tuple[ImuSeries, ImuSeries]:
    """Return the samples of both feet; raise as :func:`check_usable`, and when a foot has none."""
    findings = check_usable(recording, allow_not_finite=allow_not_finite)
    if not recording.left or not recording.right:
        missing = next(f for f in findings if f.kind is FindingKind.MISSING)
        raise RecordingError(
            f"there are no samples of the {missing.about} foot, and both feet are needed here; "
            f"{missing.remedy}"
        )
    return recording.left, recording.right


def check_usable(recording: Recording, *, allow_not_finite: bool = False) -> tuple[Finding, ...]:
    """Return the warnings about a recording that can be used.

    With ``allow_not_finite`` samples with nan or inf are left to be refused and counted.  Whether
    the samples give a start is left to the tracker, whose parameters decide.

    Raises
    ------
    RecordingError
        With the sentence of the first other error that :func:`findings_of` has.
    """
    decided_later = {FindingKind.NOT_FINITE} if allow_not_finite else set()
    findings = list(findings_of(recording))
    for finding in findings:
        if finding.is_error and finding.kind not in decided_later:
            raise RecordingError(finding.sentence)
    return tuple(finding for finding in findings if not finding.is_error)


def findings_of(
    recording: Recording, qualities: Mapping[str, Quality] | None = None
) -> Iterator[Finding]:
    """Yield every finding, the gravest first; ``qualities`` spares computing them again."""
    yield from find_missing(recording)
    yield from find_same_samples(recording)
    yield from find_cut(recording)
    yield from find_clock_steps(recording)
    if qualities is None:
        qualities = qualities_of(recording)
    usable = {foot: q for foot, q in qualities.items() if q.usable >= LEAST_SAMPLES}
    yield from _of_feet(qualities, OF_SAMPLES)
    yield from _of_feet(usable, OF_UNITS)
    if len(usable) == len(FEET):
        for find in OF_PAIR:
            yield from find(usable["left"], usable["right"])
    yield from _of_feet(usable, OF_STREAM)
    yield from pressure_findings(recording.pressure, usable)
    yield from field_findings(recorded_fields(recording))


def _of_feet(
    qualities: Mapping[str, Quality], functions: Sequence[FootFindings]
) -> Iterator[Finding]:
    """Yield what each function finds, foot by foot."""
    for foot, quality in qualities.items():
        for find in functions:
            yield from find(foot, quality)


def qualities_of(recording: Recording) -> dict[str, Quality]:
    """Return the facts of each foot that is there and has samples."""
    series = {foot: recording.imu(foot) for foot in FEET}
    return {foot: quality_of(s) for foot, s in series.items() if s is not None and len(s)}
