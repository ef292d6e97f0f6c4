"""The whole evaluation of one recording: check, pair, track, and compare with what is known."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ..core import METHODS, TrackerConfig, Trajectory, nested
from ..inspection import Finding, FindingKind, check_usable, unconstrained_config, walk_findings
from ..recording import Correction, Recording, Reference
from ..settings import flat, load_config
from .evaluate import Evaluation, evaluate
from .frames.gauge import Options
from .track import track, truth_of

SAID = (FindingKind.CUT_OFF, FindingKind.JITTER)  # of the recording, and in no counter


@dataclass(frozen=True)
class RunOptions:
    """How :func:`run` treats a recording; the defaults are those of ``dualfoot evaluate``.

    Attributes
    ----------
    method : name of the method, in place of that of the configuration
    parameters : tracker parameters by dotted name that win over the configuration
    alignment : how the frame of the tracks is fixed to truth or markers
    reference : floor markers and the like, in place of those of the recording
    calibration : foot -> calibration of its sensor, applied to samples that were found usable
    allow_not_finite : leave out and count samples with nan or inf, instead of refusing them
    check_feet : look for exchanged sensors, which tracks the recording a second time
    """

    method: str | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    alignment: Options = field(default_factory=Options)
    reference: Reference | None = None
    calibration: Mapping[str, Correction] = field(default_factory=dict)
    allow_not_finite: bool = False
    check_feet: bool = True


def run(
    recording: Recording,
    config: TrackerConfig | str | Path | None = None,
    options: RunOptions | None = None,
) -> Evaluation:
    """Check, pair, track and evaluate a recording.

    Parameters
    ----------
    recording : of both feet; its truth and its reference are used where there are any
    config : of the tracker, or name of a preset ("liu2023"), or path of a parameter file
        (default: the defaults of the package)
    options : see :class:`RunOptions`

    Returns
    -------
    Evaluation
        The tracks and their figures.  ``findings`` are the warnings about the recording, ``notes``
        the sentences that ``dualfoot evaluate`` prints below its table.

    Raises
    ------
    RecordingError
        When the samples cannot be used; says why and what to do.
    ConfigError
        When a preset, a file or a parameter is not known or out of its range.
    DualFootError
        What pairing, tracker and alignment refuse, such as a recording without a standstill.
    """
    options = options or RunOptions()
    chosen = choose_config(config, options)
    findings = check_usable(recording, allow_not_finite=options.allow_not_finite)
    return run_checked(recording, chosen, options, findings)


def run_checked(
    recording: Recording,
    config: TrackerConfig,
    options: RunOptions,
    findings: Sequence[Finding] = (),
) -> Evaluation:
    """Pair, track and evaluate a recording that was found usable, with these ``findings``."""
    recording = _prepare(recording, options)
    begin = time.process_time()
    trajectory = track(recording, config)
    run_s = time.process_time() - begin
    evaluation = evaluate(
        trajectory,
        truth=truth_of(recording),
        reference=recording.reference,
        options=options.alignment,
    )
    said = [finding for finding in findings if finding.kind in SAID]
    of_walk = list(_walk_findings(recording, config, trajectory)) if options.check_feet else []
    said += of_walk
    return replace(
        evaluation,
        findings=(*findings, *of_walk),
        notes=(*evaluation.notes, *(f"warning: {finding.sentence}" for finding in said)),
        run_s=run_s,
    )


def choose_config(config: TrackerConfig | str | Path | None, options: RunOptions) -> TrackerConfig:
    """Return the configuration that method and parameters of ``options`` make of ``config``.

    Raises
    ------
    ConfigError
        When a preset, a file or a parameter is not known or out of its range.
    """
    overrides = flat(nested(options.parameters))
    if options.method is not None:
        overrides["method"] = options.method
    if not isinstance(config, TrackerConfig):
        return load_config(config, overrides)
    if not overrides:
        return config
    return TrackerConfig.from_mapping({**config.to_mapping(), **overrides})


def _prepare(recording: Recording, options: RunOptions) -> Recording:
    """Return the recording calibrated, with the reference of ``options``."""
    recording = recording.corrected(options.calibration)
    if options.reference is None:
        return recording
    return replace(recording, reference=options.reference)


def _walk_findings(
    recording: Recording, config: TrackerConfig, trajectory: Trajectory
) -> Iterator[Finding]:
    """Yield the findings that only tracks without constraints between the feet show."""
    if METHODS[config.method].sensors_on_one_shoe:
        return
    alone = unconstrained_config(config)
    yield from walk_findings(trajectory if config == alone else track(recording, alone))
