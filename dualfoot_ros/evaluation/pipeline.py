"""The whole evaluation of one recording: check, pair, track, and compare with what is known."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ..core import (
    FEET,
    METHODS,
    BiasPrior,
    EvaluationError,
    TrackerConfig,
    Trajectory,
    nested,
)
from ..inspection import (
    Finding,
    FindingKind,
    check_usable,
    coupled_findings,
    mend_clocks,
    tracker_findings,
    unconstrained_config,
    walk_findings,
)
from ..recording import Correction, Recording, Reference
from .frames.gauge import Options, Truth
from .lean_track import lean
from .notes import config_notes
from .track import PairedSamples, pair_samples, track_walk, truth_of
from .whole_evaluation import Evaluation, evaluate


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
    check_feet : look for missed stances, exchanged sensors and the like, which tracks the
        recording a second time
    priors : gyro biases that are known before the walk, by foot
    feet : "both", or the foot that is tracked alone, "left" or "right"
    all_covariances : keep those of velocity and attitude at every epoch; else only where the
        figures need them, which saves 140 MB an hour at 200 Hz
    """

    method: str | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    alignment: Options = field(default_factory=Options)
    reference: Reference | None = None
    calibration: Mapping[str, Correction] = field(default_factory=dict)
    allow_not_finite: bool = False
    check_feet: bool = True
    priors: Mapping[str, BiasPrior] = field(default_factory=dict)
    feet: str = "both"
    all_covariances: bool = True


def run(
    recording: Recording,
    config: TrackerConfig | str | Path | None = None,
    options: RunOptions | None = None,
) -> Evaluation:
    """Check, pair, track and evaluate a recording.

    Parameters
    ----------
    recording : of the feet; its truth and its reference are used where there are any
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
    recording = choose_feet(mend_clocks(recording), options.feet)
    findings = check_usable(recording, allow_not_finite=options.allow_not_finite)
    if options.feet != "both":
        findings = tuple(f for f in findings if f.kind is not FindingKind.MISSING)
    walk = _Walk.of(recording, chosen, options)
    del recording  # paired: where the caller has let go of it too, its memory is free
    return _run_walk(walk, chosen, options, findings)


def run_checked(
    recording: Recording,
    config: TrackerConfig,
    options: RunOptions,
    findings: Sequence[Finding] = (),
) -> Evaluation:
    """Pair, track and evaluate a recording that was found usable, with these ``findings``."""
    return _run_walk(_Walk.of(recording, config, options), config, options, findings)


@dataclass
class _Walk:
    """What is taken of a recording: its samples in pairs, and what is known of the walk.

    ``paired_s`` is the CPU time of pairing, s; ``on_both`` says that the feet are to be compared;
    ``notes`` say what is known and not used.
    """

    samples: PairedSamples | None
    truth: Truth | None
    reference: Reference | None
    on_both: bool
    paired_s: float
    notes: tuple[str, ...]

    @classmethod
    def of(cls, recording: Recording, config: TrackerConfig, options: RunOptions) -> _Walk:
        """Pair the samples of a recording, calibrated where ``options`` say so."""
        recording = _prepare(recording, options)
        begin = time.process_time()
        samples = pair_samples(recording)
        paired_s = time.process_time() - begin
        on_both = options.check_feet and _has_both_feet(recording, config)
        truth, notes = truth_of(recording), tuple(_notes_on_truth(recording))
        return cls(samples, truth, recording.reference, on_both, paired_s, notes)

    def take_samples(self) -> PairedSamples:
        """Return the samples, and keep them no longer."""
        samples, self.samples = self.samples, None
        assert samples is not None
        return samples


def _run_walk(
    walk: _Walk, config: TrackerConfig, options: RunOptions, findings: Sequence[Finding]
) -> Evaluation:
    """Track and evaluate a walk."""
    samples = walk.take_samples()
    alone = list(_unconstrained_findings(samples, config)) if walk.on_both else []
    begin = time.process_time()
    trajectory = track_walk(samples, config, options.priors)
    run_s = walk.paired_s + time.process_time() - begin
    del samples
    of_walk = [*tracker_findings(trajectory), *alone]
    if walk.on_both:
        of_walk += _walk_findings(config, trajectory)
    if not options.all_covariances:
        trajectory = lean(trajectory, walk.truth)
    evaluation = evaluate(
        trajectory, truth=walk.truth, reference=walk.reference, options=options.alignment
    )
    return replace(
        evaluation,
        findings=(*findings, *of_walk),
        notes=(
            *walk.notes,
            *evaluation.notes,
            *config_notes(config),
            *(f"warning: {each.sentence}" for each in (*findings, *of_walk)),
        ),
        run_s=run_s,
    )


def choose_feet(recording: Recording, feet: str) -> Recording:
    """Return the recording with the foot that is to be tracked alone, or with "both".

    Raises
    ------
    EvaluationError
        When ``feet`` is none of these, or that foot has no samples.
    """
    if feet == "both":
        return recording
    if feet not in FEET:
        raise EvaluationError(f"feet is '{feet}'; allowed is left, right or both")
    if not recording.imu(feet):
        raise EvaluationError(f"there are no samples of the {feet} foot, which is asked for")
    return recording.of_feet([feet])


def choose_config(config: TrackerConfig | str | Path | None, options: RunOptions) -> TrackerConfig:
    """Return the configuration that method and parameters of ``options`` make of ``config``.

    Raises
    ------
    ConfigError
        When a preset, a file or a parameter is not known or out of its range.
    """
    from ..settings import flat, load_config  # here: they bring the drivers

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


def _notes_on_truth(recording: Recording) -> Iterator[str]:
    """Yield a sentence when there is a truth of one foot, which gives no errors."""
    known = [foot for foot in FEET if getattr(recording, f"{foot}_truth") is not None]
    if len(known) == 1:
        yield f"no errors against the truth: they take both feet, here is the {known[0]} one only"


def _unconstrained_findings(samples: PairedSamples, config: TrackerConfig) -> Iterator[Finding]:
    """Yield the findings on tracks without constraints, where ``config`` is for others.

    They are made first, so that they are gone before those of ``config`` are there.
    """
    alone = unconstrained_config(config)
    if config != alone:
        yield from walk_findings(track_walk(samples, alone, covariances=False))


def _walk_findings(config: TrackerConfig, trajectory: Trajectory) -> Iterator[Finding]:
    """Yield the findings on the tracks themselves."""
    alone = unconstrained_config(config)
    if config == alone:
        yield from walk_findings(trajectory)
    if config.method != alone.method:
        yield from coupled_findings(trajectory)


def _has_both_feet(recording: Recording, config: TrackerConfig) -> bool:
    on_both = not METHODS[config.method].sensors_on_one_shoe
    return on_both and bool(recording.left) and bool(recording.right)
