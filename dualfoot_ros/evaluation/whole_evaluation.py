"""Evaluation of one trajectory of both feet against truth, markers, or itself."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..core import FEET, EvaluationError, EventKind, FootTrajectory, IntArray, Trajectory
from ..inspection import Finding
from ..recording import Reference
from .frames.association import Footfalls
from .frames.gauge import (
    Markers,
    Options,
    Truth,
    apply_transforms,
    find_transforms,
    overlap,
    stood_on,
    to_markers,
)
from .frames.yaw_transform import Align, YawTransform
from .gait import Gait, strides_of, summarise
from .metrics.closure import Closure, closure
from .metrics.foot_passings import FeetReport, feet_report
from .metrics.markers import MarkerErrors, marker_errors
from .metrics.position_trust import TrustReport, trust_report
from .notes import field_notes, marker_notes, pressure_notes, refusal_notes
from .plain import plain
from .tracked_person import PersonTrack, person_track
from .truth_report import TruthReport, against_truth


@dataclass(frozen=True)
class Evaluation:
    """One evaluated trajectory, in the frame of its reference where it has one.

    Attributes
    ----------
    trajectory : aligned, and cut to the time of the truth
    tracked : the same before alignment, whole, in the tracker's own frame
    truth : at the stamps of the trajectory, or None
    markers : foot -> (K, 3) m, the floor markers it stood on; may be empty
    options, transforms : of the alignment (no transforms without a reference)
    aligned_to : "truth", "markers" or None
    closed_loop : the reference says that each foot ends where it started
    gait : gait parameters of the whole walk, which no alignment changes
    notes : sentences for the reader of the figures
    findings : warnings about the recording, where :func:`run` looked for them
    run_s : s, CPU time of pairing and tracking, where :func:`run` did them
    """

    trajectory: Trajectory
    tracked: Trajectory
    truth: Truth | None
    markers: Markers
    options: Options
    transforms: dict[str, YawTransform]
    aligned_to: str | None
    truth_report: TruthReport | None
    marker_report: dict[str, MarkerErrors]
    closure: Closure | None
    closed_loop: bool
    feet: FeetReport
    gait: Gait
    notes: tuple[str, ...]
    findings: tuple[Finding, ...] = ()
    run_s: float | None = None

    @cached_property
    def person(self) -> PersonTrack:
        """The person between the aligned feet; calculated once."""
        return person_track(self.trajectory)

    @property
    def feet_tracks(self) -> dict[str, FootTrajectory]:
        """Return both aligned feet by name."""
        return {"left": self.trajectory.left, "right": self.trajectory.right}

    @property
    def tracked_feet(self) -> tuple[str, ...]:
        """Names of the feet that had samples."""
        return tuple(foot for foot, track in self.feet_tracks.items() if track.present.any())

    @property
    def alignment_name(self) -> str:
        """Description of how the frame was fixed."""
        if self.aligned_to is None:
            return "none (no reference)"
        return self.options.words(self.aligned_to)

    def to_dict(self) -> dict[str, Any]:
        """Return all figures as plain values for JSON; None where a figure does not exist."""
        track = self.trajectory
        figures: dict[str, Any] = plain(
            {
                "method": track.method,
                "start_ns": track.start_ns,
                "duration_s": (int(track.left.stamp_ns[-1]) - int(track.left.stamp_ns[0])) * 1e-9,
                "epochs": len(track.left),
                "stances": {n: len(Footfalls.of(f)) for n, f in self.feet_tracks.items()},
                "distance_m": {n: f.distance_m for n, f in self.feet_tracks.items()},
                "alignment": self._alignment(),
                "truth": self.truth_report and asdict(self.truth_report),
                "markers": {n: asdict(m) for n, m in self.marker_report.items()} or None,
                "closed_loop": self.closed_loop,
                "closure": self.closure and asdict(self.closure),
                "feet": asdict(self.feet),
                "trust": asdict(self._trust()),
                "gait": self._gait(),
                "events": event_counts(track),
                "counters": dict(track.counters),
                "notes": list(self.notes),
            }
        )
        return figures

    def _trust(self) -> TrustReport:
        from ..settings import PersonConfig  # here: it brings the drivers

        return trust_report(self.tracked, PersonConfig().trust_limit)

    def _gait(self) -> dict[str, Any]:
        return {
            "strides": {foot: self.gait.count(foot) for foot in FEET},
            "steady_strides": {foot: self.gait.count(foot, steady=True) for foot in FEET},
            "parameters": {name: asdict(own) for name, own in self.gait.parameters.items()},
        }

    def _alignment(self) -> dict[str, Any]:
        aligned = self.aligned_to is not None
        length = self.options.length_m if self.options.align is Align.FIRST_STRIDES else None
        return {
            "method": self.options.align.value if aligned else None,
            "length_m": length if aligned else None,
            "pair": self.options.pair.value if aligned else None,
            "to": self.aligned_to,
            "words": self.alignment_name,
            **{foot: transform.to_dict() for foot, transform in self.transforms.items()},
        }


def evaluate(
    trajectory: Trajectory,
    *,
    truth: Truth | None = None,
    reference: Reference | None = None,
    options: Options | None = None,
) -> Evaluation:
    """Evaluate a trajectory against truth, floor markers, or only itself.

    Raises
    ------
    EvaluationError
        When the reference does not overlap the estimate or cannot fix its frame.
    """
    options = options or Options()
    markers: Markers = {} if reference is None else reference.markers
    length = None if reference is None else reference.length_m
    if len(trajectory.left) < 2:
        raise EvaluationError(f"the trajectory has {len(trajectory.left)} epochs; 2 are needed")
    tracked = trajectory
    if truth is not None:
        trajectory, truth = overlap(trajectory, truth)
    transforms, aligned_to = find_transforms(trajectory, truth, markers, options)
    moved = apply_transforms(trajectory, transforms)
    marker_report = _against_markers(trajectory, markers, options)
    return Evaluation(
        trajectory=moved,
        tracked=tracked,
        truth=truth,
        markers=markers,
        options=options,
        transforms=transforms,
        aligned_to=aligned_to,
        truth_report=None if truth is None else against_truth(moved, truth),
        marker_report=marker_report,
        closure=closure(trajectory.left, trajectory.right, length),
        closed_loop=reference is not None and reference.closed_loop,
        feet=_feet(moved, truth),
        gait=summarise(strides_of(tracked.left, tracked.right)),
        notes=(
            *refusal_notes(trajectory.counters),
            *pressure_notes(trajectory.counters),
            *field_notes(trajectory.counters, _field_was_used(trajectory)),
            *marker_notes(marker_report),
        ),
    )


def _field_was_used(trajectory: Trajectory) -> bool:
    aids = trajectory.of_kind(EventKind.AID)
    return any(e.accepted and e.detail.get("aid") == "magnetic_heading" for e in aids)


def event_counts(trajectory: Trajectory) -> dict[str, dict[str, int]]:
    """Return the numbers of applied and refused events by kind."""
    counts: dict[str, Counter[str]] = {kind.value: Counter() for kind in EventKind}
    for event in trajectory.events:
        counts[event.kind.value]["applied" if event.accepted else "refused"] += 1
    return {kind: dict(count) for kind, count in counts.items() if count}


def _against_markers(
    trajectory: Trajectory, markers: Markers, options: Options
) -> dict[str, MarkerErrors]:
    """Compare in a frame of the markers' own, so that truth may lie in another one."""
    transform = to_markers(trajectory, markers, options)
    reports = {}
    for foot, points in markers.items():
        stood = stood_on(trajectory, foot)
        aligned = stood if transform is None else transform.position(stood)
        reports[foot] = marker_errors(foot, aligned, points)
    return reports


def _feet(aligned: Trajectory, truth: Truth | None) -> FeetReport:
    known = None if truth is None else (truth[0].position, truth[1].position)
    return feet_report(aligned.left, aligned.right, constraint_epochs(aligned), known)


def constraint_epochs(trajectory: Trajectory, accepted: bool = True) -> IntArray:
    """Return the (K,) epochs of the constraint events that were (or were not) applied."""
    stamps = trajectory.left.stamp_ns
    events = [e for e in trajectory.of_kind(EventKind.CONSTRAINT) if e.accepted is accepted]
    at = np.array([e.stamp_ns for e in events], dtype=np.int64)
    at = at[(at >= stamps[0]) & (at <= stamps[-1])]
    return np.unique(np.searchsorted(stamps, at))
